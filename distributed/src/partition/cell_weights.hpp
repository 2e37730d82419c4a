#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::distributed {

/// Throws InputError unless there is a weight for each cell, positive and finite.
void check_weights(std::size_t cells, std::span<const float> weights);

/// What parts are to be equal in, as METIS counts it: a weight of at least 1 for each cell, and in
/// all so little that METIS, which multiplies it by three in 32 bits, does not overflow.
class CellWeights {
public:
    /// 1 for each cell.
    CellWeights() = default;

    /// In proportion to these, which are positive and finite; but no cell weighs more than a part
    /// is to weigh, as METIS fills no part with what is left beside such a cell.
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
    /// Of a mesh with so many cells.
    [[nodiscard]] std::int64_t sum(std::size_t cell_count) const {
        if (of_cell_.empty()) return static_cast<std::int64_t>(cell_count);
        return std::accumulate(of_cell_.begin(), of_cell_.end(), std::int64_t{0});
    }

private:
    std::vector<std::int32_t> of_cell_;
};

}  // namespace octetra::distributed
