#include "adapt/predicted_by_steps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octetra::cli {
namespace {

/// Collective. Returns the number of levels that a step is likely to have: with --target-cells,
/// those of a refinement of all cells.
int likely_levels(const distributed::CellsToWeigh& cells, const RefinementOptions& typed) {
    if (!typed.target_cells) return typed.levels;
    const std::uint64_t count = std::max<std::uint64_t>(cells.processes.sum(cells.count()), 1);
    int levels = 1;
    std::uint64_t made = count * 8;
    for (; levels < typed.levels && made < *typed.target_cells; made *= 8) ++levels;
    return levels;
}

}  // namespace

std::vector<float> predicted_by_steps(const distributed::CellsToWeigh& cells,
                                      const Script& script) {
    constexpr float most = 1e9F;  // also of a single step
    std::vector<float> product;
    for (const ScriptStep& step : script.steps) {
        const auto* refine = std::get_if<RefineStep>(&step.step);
        if (refine == nullptr) continue;
        std::vector<float> predicted = distributed::predicted_cells(
            cells, refine->selection, refine->scheme, likely_levels(cells, refine->typed));
        if (product.empty()) {
            product = std::move(predicted);
        } else {
            for (std::size_t c = 0; c < predicted.size(); ++c) {
                product[c] = std::min(most, product[c] * predicted[c]);
            }
        }
    }
    return product;
}

}  // namespace octetra::cli
