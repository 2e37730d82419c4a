#include "properties/histories/adapt_together.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/world.hpp"
#include "properties/draw.hpp"
#include "properties/histories/ancestries.hpp"
#include "properties/histories/first_ranks.hpp"
#include "properties/histories/reported_numbers.hpp"
#include "properties/histories/reported_sharers.hpp"
#include "properties/histories/rewriting.hpp"
#include "support/refinement.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::properties {
namespace {

using distributed::Adaptation;
using distributed::AdaptiveMesh;
using distributed::EvenStep;
using distributed::Migration;
using distributed::Partition;
using distributed::PartitionMethod;
using distributed::StepOptions;

/// A byte for each cell of this rank.
using Marks = std::vector<std::uint8_t>;

/// The cells marked for a refinement, in the numbering before it.
struct Marked {
    Marks cells;
    Scheme scheme = Scheme::eight;
    std::vector<std::uint32_t> parents;  ///< for each cell after it, the cell before
    Marks made;                          ///< the cells that the refinement made
};

Marks marked_by(const Selection& selection, const AdaptiveMesh& mesh,
                const Ancestries& ancestries) {
    const std::vector<Marker> regions = mesh.regions();
    Marks marked(mesh.cells().size(), 0);
    for (std::size_t c = 0; c < marked.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points()[mesh.cells()[c][k].value()];
        const Marker region = regions.empty() ? 0 : regions[c];
        marked[c] = marks(selection, corners, region, GlobalCell{ancestries[c].root}) ? 1 : 0;
    }
    return marked;
}

std::vector<CellIndex> listed(const Marks& marks) {
    std::vector<CellIndex> cells;
    for (std::size_t c = marks.size(); c-- > 0;) {
        if (marks[c] != 0) cells.emplace_back(c);
    }
    return cells;
}

/// All edges of these cells.
std::vector<EdgeVertices> edges_of(const AdaptiveMesh& mesh, const Marks& marks) {
    std::vector<EdgeVertices> edges;
    for (std::size_t c = 0; c < marks.size(); ++c) {
        if (marks[c] == 0) continue;
        const CellVertices& cell = mesh.cells()[c];
        for (const auto& [i, j] : cell_edges) edges.push_back({cell[i], cell[j]});
    }
    return edges;
}

/// Maps each root of this process to a rank that depends only on the turn and the root: among all
/// ranks, or among the first few.
std::vector<int> drawn_ranks(const AdaptiveMesh& mesh, std::uint64_t turn) {
    const auto ranks = static_cast<std::size_t>(mesh.processes().size());
    const std::size_t used = 1 + Draw(turn).below(ranks);
    std::vector<int> rank_of_root;
    for (const std::uint64_t root : mesh.roots()) {
        rank_of_root.push_back(static_cast<int>(Draw(turn ^ (root << 20U)).below(used)));
    }
    return rank_of_root;
}

/// A rank's part of the mesh of a history; nothing on ranks without a part.
class Part {
public:
    explicit Part(const Case& c) : case_(&c) {
        const auto& world = test::world();
        std::vector<CellVertices> input(c.mesh.cells.begin(), c.mesh.cells.end());
        world.broadcast(input);
        std::vector<int> cell_to_rank = c.cell_to_rank;
        for (int& rank : cell_to_rank) rank %= world.size();
        begin(AdaptiveMesh::distribute(world, c.mesh, cell_to_rank), input);
    }

    [[nodiscard]] const AdaptiveMesh* mesh() const { return mesh_.get(); }
    [[nodiscard]] const CarriedValues& values() const { return values_; }
    [[nodiscard]] const std::string& fault() const { return fault_; }

    /// Returns whether the step changed the mesh.
    bool make(const Step& step, std::uint64_t turn) {
        const auto last = std::exchange(last_, {});
        const auto taken_back = std::exchange(taken_back_, {});
        switch (step.action) {
            case Action::refine:
                return refine(marked_by(step.selection, *mesh_, ancestries_), step.scheme,
                              turn % 3 == 0 ? &step.selection : nullptr, turn);
            case Action::coarsen:
                return coarsen(marked_by(step.selection, *mesh_, ancestries_),
                               turn % 3 == 0 ? &step.selection : nullptr, turn)
                    .changed;
            case Action::take_back:
                return last ? take_back(*last, turn) : coarsen(none(), nullptr, turn).changed;
            case Action::rebalance:
                take(mesh_->rebalance({.most_over_mean = turn % 2 == 0 ? 1.02 : 1.3}));
                return false;
            case Action::scatter: take(mesh_->migrate(drawn_ranks(*mesh_, turn))); return false;
            default: break;
        }
        if (!taken_back) return refine(none(), Scheme::eight, nullptr, turn);
        return refine(taken_back->cells, taken_back->scheme, nullptr, turn);
    }

    /// Collective over all ranks.
    void reload(const std::filesystem::path& file, int ranks, std::uint64_t turn) {
        last_.reset();
        taken_back_.reset();
        if (mesh_) {
            std::vector<distributed::Field> fields = fields_of(ancestries_);
            for (auto& field : fields_of(values_)) fields.push_back(std::move(field));
            mesh_->save(file, fields);
        }
        (void)test::world().sum(0);  // ranks without a part wait for the file
        mesh_.reset();
        const distributed::Communicator group = first_ranks(ranks);
        if (test::world().rank() >= std::min(ranks, test::world().size())) return;
        std::vector<distributed::Field> fields;
        mesh_ = std::make_unique<AdaptiveMesh>(
            AdaptiveMesh::load(group, file, drawn_partition(turn), &fields));
        ancestries_ = ancestries_of(fields);
        values_ = values_of(fields);
    }

    /// Writes the mesh, and continues with the mesh that is read from the file.
    void rewrite(const std::filesystem::path& folder, const Format& format, std::uint64_t turn) {
        last_.reset();
        taken_back_.reset();
        const auto file = folder / ("rewritten" + format.extension);
        (void)mesh_->write(file, {}, format.options);
        const Mesh read = read_mesh(file);
        begin(AdaptiveMesh::read(mesh_->processes(), file, drawn_partition(turn)),
              {read.cells.begin(), read.cells.end()});
    }

private:
    /// Starts with a mesh to which no step has been applied.
    void begin(AdaptiveMesh mesh, const std::vector<CellVertices>& input) {
        mesh_ = std::make_unique<AdaptiveMesh>(std::move(mesh));
        ancestries_ = initial_ancestries(*mesh_, input);
        values_ = first_values(*mesh_, ancestries_);
    }

    static Partition drawn_partition(std::uint64_t turn) {
        constexpr std::array methods{PartitionMethod::rcb, PartitionMethod::random,
                                     PartitionMethod::dual, PartitionMethod::lepp};
        return {.method = methods[turn % 4], .seed = turn, .path = {}};
    }

    [[nodiscard]] Marks none() const { return Marks(mesh_->cells().size(), 0); }

    /// Checks that the values of an Adaptation match the present cells.
    void take(Ancestries ancestries, CarriedValues values) {
        ancestries_ = std::move(ancestries);
        values_ = std::move(values);
        if (ancestries_.size() == mesh_->cells().size()) return;
        if (fault_.empty()) fault_ = "a step told of another number of cells than there are";
        ancestries_.resize(mesh_->cells().size());
    }

    void take(const Migration& move) {
        take(moved(ancestries_, move), moved(std::move(values_), move));
    }

    /// Refines by the selection, if there is one; else by bytes, a list or, where it is equivalent,
    /// edges.
    Adaptation refined_by(const Marks& marks, const StepOptions& options,
                          const Selection* selection, std::uint64_t turn) {
        if (selection != nullptr) return mesh_->refine(*selection, options);
        if (turn % 5 == 0 && options.closure == Closure::longest_edge &&
            options.scheme == Scheme::eight) {
            return mesh_->refine_edges(edges_of(*mesh_, marks), options);
        }
        if (turn % 3 == 1) return mesh_->refine(marks, options);
        return mesh_->refine(listed(marks), options);
    }

    bool refine(Marks marks, Scheme scheme, const Selection* selection, std::uint64_t turn) {
        const StepOptions options{.scheme = scheme,
                                  .closure = case_->closure,
                                  .synchronisation = case_->synchronisation,
                                  .max_cells = max_history_cells};
        Adaptation step;
        if (turn % 7 == 0) {
            constexpr distributed::BalanceOptions balance{.most_over_mean = 1.1};
            EvenStep even = selection != nullptr
                                ? mesh_->refine_evenly(*selection, balance, options)
                                : mesh_->refine_evenly(marks, balance, options);
            marks = even.move.cells(std::move(marks));
            ancestries_ = moved(ancestries_, even.move);
            values_ = moved(std::move(values_), even.move);
            step = std::move(even.step);
        } else {
            step = refined_by(marks, options, selection, turn);
        }
        Marked last{std::move(marks), scheme, step.cells.parents(), Marks(step.cells.count(), 0)};
        step.cells.for_each_new([&](std::size_t number, std::size_t, unsigned halvings) {
            if (halvings > 0) last.made[number] = 1;
        });
        take(refined(ancestries_, step, case_->closure), after_step(std::move(values_), step));
        last_ = std::move(last);
        return step.changed;
    }

    Adaptation coarsen(const Marks& may_coarsen, const Selection* selection, std::uint64_t turn) {
        Adaptation step = selection != nullptr ? mesh_->coarsen(*selection)
                          : turn % 3 == 1      ? mesh_->coarsen(may_coarsen)
                                               : mesh_->coarsen(listed(may_coarsen));
        take(coarsened(ancestries_, step, may_coarsen, &fault_),
             after_step(std::move(values_), step));
        return step;
    }

    bool take_back(const Marked& last, std::uint64_t turn) {
        const Adaptation step = coarsen(last.made, nullptr, turn);
        Marked marked{Marks(step.cells.count(), 0), last.scheme, {}, {}};
        for (std::size_t c = 0; c < last.parents.size(); ++c) {
            const std::size_t whole = step.changed ? step.cells.coarse_of()[c] : c;
            if (last.cells[last.parents[c]] != 0) marked.cells[whole] = 1;
        }
        taken_back_ = std::move(marked);
        return step.changed;
    }

    const Case* case_;
    std::unique_ptr<AdaptiveMesh> mesh_;
    Ancestries ancestries_;
    CarriedValues values_;
    std::string fault_;
    std::optional<Marked> last_;        ///< if the previous step refined
    std::optional<Marked> taken_back_;  ///< if the previous step took that back
};

/// Collective among the mesh's processes. Adds the first rank's observations of the mesh after a
/// step.
void observe(const Part& part, bool at_sharers_too, Stage& stage, Adapted& adapted) {
    const AdaptiveMesh& mesh = *part.mesh();
    stage.mesh = mesh.collect();
    const auto note = [](std::string& first, const std::string& fault) {
        if (first.empty()) first = fault;
    };
    note(adapted.fault_of_numbers, fault_of_reported_numbers(mesh, stage.mesh));
    if (at_sharers_too) note(adapted.fault_of_sharers, fault_of_reported_sharers(mesh));
    adapted.values.push_back(gather_values(part.values(), mesh, stage.mesh));
}

/// Collective. On the first rank, a message that some rank has, or an empty string.
std::string any_message(const std::string& words) {
    for (const auto& said : test::world().gather(std::vector<char>(words.begin(), words.end()))) {
        if (!said.empty()) return {said.begin(), said.end()};
    }
    return {};
}

}  // namespace

Adapted adapt_together(const Case& c, const std::filesystem::path& folder) {
    Part part(c);
    Adapted adapted;
    for (std::size_t k = 0; k < c.steps.size(); ++k) {
        const std::uint64_t turn = c.seed + k;
        Stage stage;
        if (c.steps[k].action == Action::reload) {
            const auto file = folder / "state.octetra";
            part.reload(file, c.steps[k].ranks, turn);
            if (test::world().is_first()) adapted.checkpoint = test::content_of(file);
        } else if (c.steps[k].action == Action::rewrite) {
            if (part.mesh() != nullptr) part.rewrite(folder, format_named(c.steps[k].format), turn);
        } else if (part.mesh() != nullptr) {
            try {
                stage.changed = part.make(c.steps[k], turn);
            } catch (const InputError& error) {
                stage.refusal = error.what();
            }
        }
        // Sharers are checked only sometimes: this takes longer than the step.
        if (part.mesh() != nullptr) observe(part, turn % 4 == 0, stage, adapted);
        adapted.stages.push_back(std::move(stage));
    }
    adapted.fault_of_ancestries = any_message(part.fault());
    return adapted;
}

}  // namespace octetra::properties
