#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "mesh/judged_mesh.hpp"
#include "refinement/lines.hpp"

namespace octetra::verify {

/// Part of a coarse cell.
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

/// A vertex put between two others.
struct Split {
    EdgeVertices edge;
    VertexIndex midpoint;
};

/// Divides one coarse cell after the other.
///
/// A piece that is no fine cell was bisected at one of its edges, a b, and then the midpoint m has
/// lines to the other two corners; or it was cut into eight at all six. Mostly one way fits; where
/// several do, they are tried, longest edge first, until one leads to fine cells all over.
class CellDivider {
public:
    CellDivider(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines);

    /// Finds the fine cells that fill a coarse cell. False if there is no way.
    bool divide_cell(const CellVertices& vertices);

    [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
    [[nodiscard]] const std::vector<Split>& splits() const { return splits_; }
    /// A piece that could not be divided, when the most others could.
    [[nodiscard]] const CellVertices& stuck() const { return stuck_; }

private:
    /// An edge of a piece, and the vertex that may have bisected it.
    struct Choice {
        std::size_t edge = 0;
        VertexIndex midpoint;
    };

    bool divide(const Piece& piece);
    /// Tries a way of dividing; takes back what it has found if it leads nowhere.
    bool attempt(const auto& pieces);
    bool bisect(const Piece& piece);
    /// Puts the longest of choices[n ...] at n.
    void take_longest_first(const Piece& piece, std::array<Choice, 6>& choices, std::size_t n,
                            std::size_t count) const;
    bool cut_into_eight(const Piece& piece);

    const JudgedMesh* fine_;
    Lines* lines_;
    std::vector<Leaf> leaves_;
    std::vector<Split> splits_;
    /// Pieces that cannot be divided, their vertices ascending. A mesh that is right has few: only
    /// where edges are so short that midpoints are rounded to other vertices.
    std::set<CellVertices> hopeless_;
    std::int64_t budget_ = 0;  ///< how many more pieces may be divided: a wrong mesh has many ways
    CellVertices stuck_;
    std::size_t stuck_leaves_ = 0;
};

}  // namespace octetra::verify
