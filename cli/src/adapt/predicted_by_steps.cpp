#include "adapt/predicted_by_steps.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace octetra::cli {

std::vector<float> predicted_by_steps(const distributed::CellsToWeigh& cells,
                                      const Script& script) {
    constexpr float most = 1e9F;  // also of a single step
    std::vector<float> product;
    for (const ScriptStep& step : script.steps) {
        const auto* refine = std::get_if<RefineStep>(&step.step);
        if (refine == nullptr) continue;
        std::vector<float> predicted = distributed::predicted_cells(
            cells, refine->selection, refine->scheme, refine->typed.levels);
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
