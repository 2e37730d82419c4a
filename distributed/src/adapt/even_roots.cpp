#include "adapt/even_roots.hpp"

#include <numeric>
#include <utility>

#include "migrate/even_parts.hpp"

namespace octetra::distributed {
namespace {

struct WeighedParts {
    std::optional<EvenParts> parts;
    std::uint64_t sum = 0;  ///< sum over all processes
};

/// Collective.
WeighedParts weighed_parts(const DistributedMesh& mesh,
                           const std::function<std::vector<std::uint64_t>()>& weigh,
                           double most_over_mean) {
    const std::vector<std::uint64_t> weights = weigh();
    auto parts = even_parts(mesh, weights, most_over_mean);
    return {std::move(parts), mesh.processes.sum(std::reduce(weights.begin(), weights.end()))};
}

/// Collective. Returns whether any root has more than one cell.
bool has_heavy_roots(const DistributedMesh& mesh) {
    const bool here = mesh.cells.size() > mesh.cell_ancestors.roots.size();
    return mesh.processes.max(here ? 1 : 0) == 1;
}

}  // namespace

std::optional<std::vector<int>> even_parts_or_roots(
    DistributedMesh& mesh, const std::function<std::vector<std::uint64_t>()>& weigh,
    const BalanceOptions& balance, std::unique_ptr<CellsAsRoots>& roots,
    const CanonicalNumbers* known) {
    WeighedParts of_roots = weighed_parts(mesh, weigh, balance.most_over_mean);
    const double mean = static_cast<double>(of_roots.sum) / mesh.processes.size();
    const bool are_even = of_roots.parts && static_cast<double>(of_roots.parts->most) <=
                                                balance.most_over_mean * mean;
    if (!are_even && balance.may_forget_history && has_heavy_roots(mesh)) {
        auto cells = std::make_unique<CellsAsRoots>();
        cells->begin(mesh, known);
        WeighedParts of_cells = weighed_parts(mesh, weigh, balance.most_over_mean);
        if (of_cells.parts && (!of_roots.parts || of_cells.parts->most < of_roots.parts->most)) {
            roots = std::move(cells);
            return std::move(of_cells.parts->rank_of_root);
        }
    }
    if (!of_roots.parts) return std::nullopt;
    return std::move(of_roots.parts->rank_of_root);
}

}  // namespace octetra::distributed
