#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::distributed {

/// What parts are to be equal in, as METIS counts it: a weight of at least 1 for each cell.
class CellWeights {
public:
    /// 1 for each cell.
    CellWeights() = default;

    /// In proportion to these, where such sums fit 32 bits; 1 for each cell if there are none.
    explicit CellWeights(const std::vector<float>& weights) : of_cell_(weights.size()) {
        constexpr double most = 1e9;  // in all, but for those that come to less than 1
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const double scale = std::min(1.0, most / sum);
        std::ranges::transform(weights, of_cell_.begin(), [&](float weight) {
            return std::max(1, static_cast<std::int32_t>(std::lround(weight * scale)));
        });
    }

    [[nodiscard]] std::int32_t of(CellIndex c) const {
        return of_cell_.empty() ? 1 : of_cell_[c.value()];
    }
    [[nodiscard]] std::int64_t of_all(auto&& cells) const {
        if (of_cell_.empty()) return static_cast<std::int64_t>(cells.size());
        std::int64_t sum = 0;
        for (const CellIndex c : cells) sum += of(c);
        return sum;
    }
    /// Of a mesh with so many cells.
    [[nodiscard]] std::int64_t sum(std::size_t cell_count) const {
        if (of_cell_.empty()) return static_cast<std::int64_t>(cell_count);
        return std::accumulate(of_cell_.begin(), of_cell_.end(), std::int64_t{0});
    }

private:
    std::vector<std::int32_t> of_cell_;
};

}  // namespace octetra::distributed
