#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "mesh/judged_mesh.hpp"
#include "refinement/bisected_edges.hpp"
#include "refinement/lines.hpp"

namespace octetra::verify {

/// A part of a coarse cell.
struct Piece {
    CellVertices vertices;
    std::array<std::int8_t, 4> face_of_parent{0, 1, 2, 3};
    std::uint8_t depth = 0;
};

/// A piece that is a fine cell.
struct Leaf {
    CellIndex cell;
    Piece piece;
};

/// Divides coarse cells, one at a time.
///
/// A piece that is not a fine cell was either bisected at one of its edges, a b, in which case the
/// midpoint m has lines to the other two corners, or divided into eight at all six. Usually one
/// case applies; if several do, they are tried, longest edge first, until one leads to fine cells
/// everywhere.
class CellDivider {
public:
    CellDivider(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines);

    /// Finds the fine cells that tile a coarse cell. Returns false if there is no division.
    bool divide_cell(const CellVertices& vertices);

    [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
    [[nodiscard]] const std::vector<Split>& splits() const { return splits_; }
    /// Returns the piece that could not be divided in the attempt that found the most fine cells.
    [[nodiscard]] const CellVertices& undivided() const { return undivided_; }

private:
    /// An edge of a piece, and the vertex that may have bisected it.
    struct Choice {
        std::size_t edge = 0;
        VertexIndex midpoint;
    };

    bool divide(const Piece& piece);
    /// Tries a division; discards its results if it fails.
    bool attempt(const auto& pieces);
    bool bisect(const Piece& piece);
    /// Moves the longest of choices[n ...] to position n.
    void take_longest_first(const Piece& piece, std::array<Choice, 6>& choices, std::size_t n,
                            std::size_t count) const;
    bool cut_into_eight(const Piece& piece);

    const JudgedMesh* fine_;
    CellFinder cells_;  ///< of the fine mesh
    Lines* lines_;
    std::vector<Leaf> leaves_;
    std::vector<Split> splits_;
    /// Pieces known to be indivisible, with ascending vertices. A correct mesh has few: only where
    /// edges are so short that midpoints are rounded to other vertices.
    std::set<CellVertices> indivisible_;
    std::int64_t budget_ = 0;  ///< remaining number of pieces to divide: bounds the search
    CellVertices undivided_;
    std::size_t undivided_leaves_ = 0;
};

}  // namespace octetra::verify
