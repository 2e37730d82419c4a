#include "properties/histories/adapt_together.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/world.hpp"
#include "properties/histories/first_ranks.hpp"
#include "properties/histories/pasts.hpp"
#include "properties/histories/seen_numbers.hpp"
#include "support/refinement.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::properties {
namespace {

using distributed::Adaptation;
using distributed::AdaptiveMesh;
using distributed::Partition;
using distributed::PartitionMethod;
using distributed::StepOptions;

/// A byte for each cell of this rank.
using Marks = std::vector<std::uint8_t>;

/// What was marked for a refinement, of the cells before it.
struct Marked {
    Marks cells;
    Scheme scheme = Scheme::eight;
    std::vector<std::uint32_t> parents;  ///< of each cell after it, the one before
    Marks made;                          ///< the cells after it that were not there before
};

Marks marked_by(const Selection& selection, const AdaptiveMesh& mesh, const Pasts& pasts) {
    const std::vector<Marker> regions = mesh.regions();
    Marks marked(mesh.cells().size(), 0);
    for (std::size_t c = 0; c < marked.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points()[mesh.cells()[c][k].value()];
        const Marker region = regions.empty() ? 0 : regions[c];
        marked[c] = marks(selection, corners, region, GlobalCell{pasts[c].root}) ? 1 : 0;
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

/// A rank's part of the mesh that a history makes; nothing on ranks that have none of it.
class Part {
public:
    explicit Part(const Case& c) : case_(&c) {
        const auto& world = test::world();
        std::vector<CellVertices> input(c.mesh.cells.begin(), c.mesh.cells.end());
        world.broadcast(input);
        std::vector<int> cell_to_rank = c.cell_to_rank;
        for (int& rank : cell_to_rank) rank %= world.size();
        mesh_ =
            std::make_unique<AdaptiveMesh>(AdaptiveMesh::distribute(world, c.mesh, cell_to_rank));
        pasts_ = first_pasts(*mesh_, input);
    }

    [[nodiscard]] const AdaptiveMesh* mesh() const { return mesh_.get(); }
    [[nodiscard]] const std::string& fault() const { return fault_; }

    /// Did it change anything?
    bool make(const Step& step, std::uint64_t turn) {
        const auto last = std::exchange(last_, {});
        const auto taken_back = std::exchange(taken_back_, {});
        switch (step.action) {
            case Action::refine:
                return refine(marked_by(step.selection, *mesh_, pasts_), step.scheme,
                              turn % 3 == 0 ? &step.selection : nullptr, turn);
            case Action::coarsen:
                return coarsen(marked_by(step.selection, *mesh_, pasts_),
                               turn % 3 == 0 ? &step.selection : nullptr, turn)
                    .changed;
            case Action::take_back:
                return last ? take_back(*last, turn) : coarsen(none(), nullptr, turn).changed;
            default: break;
        }
        if (!taken_back) return refine(none(), Scheme::eight, nullptr, turn);
        return refine(taken_back->cells, taken_back->scheme, nullptr, turn);
    }

    /// Collective over all ranks.
    void reload(const std::filesystem::path& file, int ranks, std::uint64_t turn) {
        last_.reset();
        taken_back_.reset();
        if (mesh_) mesh_->save(file, fields_of(pasts_));
        (void)test::world().sum(0);  // those that have no part wait for the file
        mesh_.reset();
        const distributed::Communicator group = first_ranks(ranks);
        if (test::world().rank() >= std::min(ranks, test::world().size())) return;
        constexpr std::array methods{PartitionMethod::rcb, PartitionMethod::random,
                                     PartitionMethod::dual, PartitionMethod::lepp};
        const Partition partition{.method = methods[turn % 4], .seed = turn, .path = {}};
        std::vector<distributed::Field> fields;
        mesh_ = std::make_unique<AdaptiveMesh>(AdaptiveMesh::load(group, file, partition, &fields));
        pasts_ = pasts_of(fields);
    }

private:
    [[nodiscard]] Marks none() const { return Marks(mesh_->cells().size(), 0); }

    /// What an Adaptation tells must be of the cells that there are.
    void take(Pasts pasts) {
        pasts_ = std::move(pasts);
        if (pasts_.size() == mesh_->cells().size()) return;
        if (fault_.empty()) fault_ = "a step told of another number of cells than there are";
        pasts_.resize(mesh_->cells().size());
    }

    /// By the selection, where it is given; else by bytes or a list.
    bool refine(const Marks& marks, Scheme scheme, const Selection* selection, std::uint64_t turn) {
        const StepOptions options{.scheme = scheme,
                                  .synchronisation = case_->synchronisation,
                                  .max_cells = most_cells_of_a_history};
        const Adaptation step = selection != nullptr ? mesh_->refine(*selection, options)
                                : turn % 3 == 1      ? mesh_->refine(marks, options)
                                                     : mesh_->refine(listed(marks), options);
        Marked last{marks, scheme, step.cells.parents(), Marks(step.cells.count(), 0)};
        step.cells.for_each_new([&](std::size_t number, std::size_t, unsigned halvings) {
            if (halvings > 0) last.made[number] = 1;
        });
        take(refined(pasts_, step));
        last_ = std::move(last);
        return step.changed;
    }

    Adaptation coarsen(const Marks& may_go, const Selection* selection, std::uint64_t turn) {
        Adaptation step = selection != nullptr ? mesh_->coarsen(*selection)
                          : turn % 3 == 1      ? mesh_->coarsen(may_go)
                                               : mesh_->coarsen(listed(may_go));
        take(coarsened(pasts_, step, may_go, &fault_));
        return step;
    }

    bool take_back(const Marked& last, std::uint64_t turn) {
        const Adaptation step = coarsen(last.made, nullptr, turn);
        Marked marked{Marks(step.cells.count(), 0), last.scheme, {}, {}};
        for (std::size_t c = 0; c < last.parents.size(); ++c) {
            const std::size_t whole = step.changed ? step.cells.whole_of()[c] : c;
            if (last.cells[last.parents[c]] != 0) marked.cells[whole] = 1;
        }
        taken_back_ = std::move(marked);
        return step.changed;
    }

    const Case* case_;
    std::unique_ptr<AdaptiveMesh> mesh_;
    Pasts pasts_;
    std::string fault_;
    std::optional<Marked> last_;        ///< if the step before refined
    std::optional<Marked> taken_back_;  ///< if the step before took that back
};

/// Collective. On the first rank, what some rank says.
std::string of_any(const std::string& words) {
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
        } else if (part.mesh() != nullptr) {
            try {
                stage.changed = part.make(c.steps[k], turn);
            } catch (const InputError& error) {
                stage.refusal = error.what();
            }
        }
        if (part.mesh() != nullptr) {
            stage.mesh = part.mesh()->collect();
            const std::string fault = fault_of_seen_numbers(*part.mesh(), stage.mesh);
            if (adapted.fault_of_numbers.empty()) adapted.fault_of_numbers = fault;
        }
        adapted.stages.push_back(std::move(stage));
    }
    adapted.fault_of_pasts = of_any(part.fault());
    return adapted;
}

}  // namespace octetra::properties
