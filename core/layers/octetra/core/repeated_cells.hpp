#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra {

/// A cell of a mesh, and an earlier one with which it is in conflict.
struct CellPair {
    CellIndex cell = CellIndex::none();  ///< none: there is no such pair
    CellIndex earlier = CellIndex::none();
};

/// Finds a cell with the same vertices as an earlier one. It keeps three bits of each cell in a bit
/// field; cells whose bits were all set before are suspects: all repeated ones, and two or three of
/// a thousand others. Only suspects are compared in the end. Memory: 2 bytes per cell.
class RepeatedCells {
public:
    explicit RepeatedCells(std::uint64_t cell_count);

    /// Adds the next cell.
    void add(const CellVertices& cell) {
        if (pending_count_ == ahead) look_up();
        PendingLookup& place = pending_[pending_count_++];
        place = of(cell);
        __builtin_prefetch(&seen_[place.word]);
    }

    /// To be called after the last add(), with the same cells. Returns the first cell with the same
    /// vertices as an earlier one, and the first of these. Vertex numbers must be less than
    /// `vertex_count`.
    [[nodiscard]] CellPair find(const IndexVector<CellIndex, CellVertices>& cells,
                                std::size_t vertex_count);

private:
    static constexpr std::uint32_t ahead = 32;

    /// Three bits of a word, which represent a cell. They are looked up some cells later, when the
    /// prefetched word has arrived.
    struct PendingLookup {
        std::uint64_t word = 0;
        std::uint64_t bits = 0;
    };

    [[nodiscard]] PendingLookup of(const CellVertices& cell) const {
        // The product does not depend on the order of the factors; all are odd, so none loses
        // information.
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
        std::uint64_t product = 1;
        for (const VertexIndex v : cell) product *= odd + 2 * std::uint64_t{v.value()};
        const auto bit = [=](int shift) { return std::uint64_t{1} << (product >> shift & 63U); };
        return {(product >> 32U) * word_count_ >> 32U, bit(20) | bit(26) | bit(32)};
    }

    void look_up();

    std::uint32_t count_ = 0;  ///< number of cells that were looked up
    std::uint32_t pending_count_ = 0;
    std::array<PendingLookup, ahead> pending_;
    std::uint64_t word_count_;
    std::vector<std::uint64_t> seen_;
    std::vector<CellIndex> suspects_;
};

}  // namespace octetra
