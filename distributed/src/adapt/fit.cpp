#include <octetra/distributed/fit.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/step_options.hpp"
#include "numbering/lowest_fault.hpp"

namespace octetra::distributed {
namespace {

bool is_size(double size) { return size > 0; }

/// Collective, within a transaction. Throws InputError for the invalid size of the cell with the
/// lowest number of all.
void check_sizes(const AdaptiveMesh& mesh, std::span<const double> sizes) {
    if (sizes.size() != mesh.cells().size()) {
        throw InputError(
            fmt::format("{} target sizes for {} cells", sizes.size(), mesh.cells().size()));
    }
    const auto fault =
        lowest_fault(mesh.processes(), sizes, is_size, [&] { return mesh.cell_numbers(); });
    if (!fault) return;
    throw InputError(fmt::format("the target size of cell {} is {}, not a number above 0",
                                 fault->number + mesh.index_base(), fault->value));
}

/// Collective. Returns the longest edge of each cell of this process.
std::vector<double> longest_edges_of(const AdaptiveMesh& mesh) {
    return mesh.cell_values(Expression("longest"));
}

/// Collective.
std::uint64_t cell_count_of(const AdaptiveMesh& mesh) {
    return mesh.processes().sum(mesh.cells().size());
}

/// Returns a byte for each cell: whether its longest edge and its target size satisfy a condition.
std::vector<std::uint8_t> marks_if(std::span<const double> longest, std::span<const double> sizes,
                                   auto&& condition) {
    std::vector<std::uint8_t> marks(sizes.size());
    std::ranges::transform(longest, sizes, marks.begin(),
                           [&](double l, double h) { return condition(l, h) ? 1 : 0; });
    return marks;
}

bool is_too_long(double longest, double size) { return longest > size; }
bool is_too_short(double longest, double size) { return 2 * longest < size; }
bool may_be_merged(double longest, double size) { return 2 * longest <= size; }

}  // namespace

struct Fit::State {
    AdaptiveMesh* mesh;
    FitOptions options;
    int refined = 0;
    int coarsened = 0;
    int refined_in_sequence = 0;
    /// The number of cells before the last step that coarsened, if there was one.
    std::optional<std::uint64_t> cells_before;

    /// Collective, within a transaction. Throws InputError for invalid or different options.
    void check_options() const;
    /// Collective. Refines the marked cells, of which some process has one. Returns nothing if that
    /// would exceed the levels in a sequence.
    std::optional<EvenStep> refine(std::span<const std::uint8_t> marks);
    /// Collective. Merges marked cells. Returns nothing if that changes nothing.
    std::optional<EvenStep> coarsen(std::span<const std::uint8_t> marks);
};

void Fit::State::check_options() const {
    if (options.levels < 0) throw InputError("FitOptions::levels must not be negative");
    if (options.step.is_last) throw InputError("FitOptions::step must not be the last step");
    if (options.balance && options.balance->may_forget_history) {
        throw InputError("a fit may have to coarsen, and cannot forget the history");
    }
    const Communicator& processes = mesh->processes();
    check_same(processes, options.step);
    processes.check_same("levels", std::to_string(options.levels));
    processes.check_same("balance", options.balance ? "given" : "absent");
    if (options.balance) check_same(processes, *options.balance);
}

std::optional<EvenStep> Fit::State::refine(std::span<const std::uint8_t> marks) {
    if (refined_in_sequence == options.levels) return std::nullopt;
    EvenStep done = options.balance ? mesh->refine_evenly(marks, *options.balance, options.step)
                                    : EvenStep{Migration{}, mesh->refine(marks, options.step)};
    ++refined;
    ++refined_in_sequence;
    return done;
}

std::optional<EvenStep> Fit::State::coarsen(std::span<const std::uint8_t> marks) {
    if (coarsened == options.levels) return std::nullopt;
    const std::uint64_t cells = cell_count_of(*mesh);
    if (cells_before && cells >= *cells_before) return std::nullopt;
    EvenStep done{Migration{}, mesh->coarsen(marks)};
    if (!done.step.changed) return std::nullopt;
    ++coarsened;
    refined_in_sequence = 0;
    cells_before = cells;
    return done;
}

Fit::Fit(AdaptiveMesh& mesh, const FitOptions& options)
    : state_(std::make_unique<State>(State{&mesh, options})) {}
Fit::~Fit() = default;
Fit::Fit(Fit&&) noexcept = default;
Fit& Fit::operator=(Fit&&) noexcept = default;

std::optional<EvenStep> Fit::next(std::span<const double> sizes) {
    const AdaptiveMesh& mesh = *state_->mesh;
    std::vector<std::uint8_t> too_long;
    std::vector<std::uint8_t> mergeable;
    bool is_any_too_long = false;
    mesh.processes().transaction([&] {
        const Phase phase(mesh.processes(), "select");
        state_->check_options();
        check_sizes(mesh, sizes);
        const std::vector<double> longest = longest_edges_of(mesh);
        too_long = marks_if(longest, sizes, is_too_long);
        mergeable = marks_if(longest, sizes, may_be_merged);
        const bool is_any_here = std::ranges::find(too_long, 1) != too_long.end();
        is_any_too_long = mesh.processes().max(is_any_here ? 1 : 0) == 1;
    });
    if (is_any_too_long) {
        if (auto step = state_->refine(too_long)) return step;
    }
    return state_->coarsen(mergeable);
}

MisfitCells Fit::misfit_cells(std::span<const double> sizes) const {
    const AdaptiveMesh& mesh = *state_->mesh;
    const Communicator& processes = mesh.processes();
    return processes.transaction([&] {
        check_sizes(mesh, sizes);
        const std::vector<double> longest = longest_edges_of(mesh);
        std::vector<std::uint32_t> descendants(mesh.roots().size());
        const std::vector<std::uint32_t> roots = mesh.root_of_cells();
        for (const std::uint32_t root : roots) ++descendants[root];
        MisfitCells here;
        for (std::size_t c = 0; c < sizes.size(); ++c) {
            if (is_too_long(longest[c], sizes[c])) ++here.too_long;
            if (!is_too_short(longest[c], sizes[c])) continue;
            ++here.too_short;
            if (descendants[roots[c]] == 1) ++here.too_short_roots;
        }
        return MisfitCells{processes.sum(here.too_long), processes.sum(here.too_short),
                           processes.sum(here.too_short_roots)};
    });
}

int Fit::refined() const { return state_->refined; }
int Fit::coarsened() const { return state_->coarsened; }

}  // namespace octetra::distributed
