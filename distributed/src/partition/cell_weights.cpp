#include "partition/cell_weights.hpp"

#include <algorithm>
#include <cmath>

#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

/// Returns the weight of a part if no cell may weigh more than a part.
double max_part_weight(const std::vector<float>& weights, int parts) {
    double most = std::accumulate(weights.begin(), weights.end(), 0.0) / parts;
    for (std::ptrdiff_t heavy_before = 0;;) {
        std::ptrdiff_t heavy = 0;
        double others = 0;
        for (const float weight : weights) {
            if (weight > most) {
                ++heavy;
            } else {
                others += weight;
            }
        }
        if (heavy == heavy_before) return most;
        // Each heavy cell is a part; by their weight, there are fewer of them than parts.
        most = others / static_cast<double>(parts - heavy);
        heavy_before = heavy;
    }
}

}  // namespace

void check_weights(std::size_t cells, std::span<const float> weights) {
    const auto is_weight = [](float weight) { return weight > 0 && std::isfinite(weight); };
    if (weights.size() == cells && std::ranges::all_of(weights, is_weight)) return;
    throw InputError("a partition takes one weight for each cell, positive and finite");
}

CellWeights::CellWeights(const std::vector<float>& weights, int parts) : of_cell_(weights.size()) {
    const double most = max_part_weight(weights, parts);
    const auto limited = [&](float weight) { return std::min(double{weight}, most); };
    double sum = 0;
    for (const float weight : weights) sum += limited(weight);
    // Less than a third of 2^31; rounding weights below 1 up to 1 adds at most 1 for each cell.
    const double scale = (7e8 - static_cast<double>(weights.size())) / sum;
    std::ranges::transform(weights, of_cell_.begin(), [&](float weight) {
        return std::max(1, static_cast<std::int32_t>(std::lround(limited(weight) * scale)));
    });
}

}  // namespace octetra::distributed
