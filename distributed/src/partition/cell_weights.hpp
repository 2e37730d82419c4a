#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::distributed {

/// Throws InputError unless there is a weight for each cell, positive and finite.
void check_weights(std::size_t cells, std::span<const float> weights);

/// The weights that METIS balances: at least 1 for each cell, with a sum so small that METIS, which
/// multiplies it by three in 32 bits, does not overflow.
class CellWeights {
public:
    /// A weight of 1 for each cell.
    CellWeights() = default;

    /// In proportion to the given weights, which must be positive and finite; but no cell weighs
    /// more than a part should, as METIS does not fill a part beside such a cell.
    CellWeights(const std::vector<float>& weights, int parts);

    [[nodiscard]] std::int32_t of(CellIndex c) const {
        return of_cell_.empty() ? 1 : of_cell_[c.value()];
    }
    [[nodiscard]] std::int64_t of_all(auto&& cells) const {
        if (of_cell_.empty()) return static_cast<std::int64_t>(cells.size());
        std::int64_t sum = 0;
        for (const CellIndex c : cells) sum += of(c);
        return sum;
    }
    /// The sum for a mesh with this many cells.
    [[nodiscard]] std::int64_t sum(std::size_t cell_count) const {
        if (of_cell_.empty()) return static_cast<std::int64_t>(cell_count);
        return std::accumulate(of_cell_.begin(), of_cell_.end(), std::int64_t{0});
    }

private:
    std::vector<std::int32_t> of_cell_;
};

}  // namespace octetra::distributed
