#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

/// Cells that know what is behind their faces, kept up to date as stars are bisected.
namespace octetra::rivals {

inline constexpr std::uint32_t no_waiter = 0xffffffff;

struct LinkedCell {
    CellVertices vertices;
    std::array<CellIndex, 4> neighbours;     ///< behind the face opposite each vertex; or none
    CellIndex root;                          ///< the cell of the input that it descends from
    std::uint32_t first_waiter = no_waiter;  ///< see WantedEdges
    std::uint8_t longest = 0;                ///< edge, a place in cell_edges
    bool longest_is_wanted = false;
};

/// One of the cells around an edge ab, by positions in it.
struct StarCell {
    CellIndex cell;
    std::uint8_t a = 0;
    std::uint8_t b = 0;
    std::uint8_t next = 0;      ///< behind the face opposite this one is the next of the star
    std::uint8_t previous = 0;  ///< and the previous one behind this
};

/// The cells around an edge, each behind a face of the one before: a ring, or from boundary to
/// boundary.
struct Star {
    std::vector<StarCell> cells;
    bool is_ring = false;
};

struct CellGraph {
    IndexVector<VertexIndex, Point> points;
    IndexVector<CellIndex, LinkedCell> cells;
    /// The cell that follows each in the order of results; none() after the last.
    IndexVector<CellIndex, CellIndex> next;

    /// Throws InputError where faces do not tell how cells meet.
    explicit CellGraph(const Mesh& mesh);

    [[nodiscard]] Corners corners(CellIndex c) const {
        const auto& [p, q, r, s] = cells[c].vertices;
        return {points[p], points[q], points[r], points[s]};
    }
    [[nodiscard]] EdgeVertices longest_edge_of(CellIndex c) const {
        const auto& [i, j] = cell_edges[cells[c].longest];
        return {cells[c].vertices[i], cells[c].vertices[j]};
    }
    /// The cells around the longest edge of a cell. The star's memory is used again.
    void find_star(CellIndex c, Star& star) const;
    /// Halves all cells of a star at a vertex between a and b. The first half of star.cells[i] has
    /// its number, the other one is appended, as number i of those that are new; what belongs to
    /// longest edges is to be set of both, and the waiters are the first one's.
    void bisect(const Star& star, VertexIndex midpoint);

private:
    void walk(Star& star) const;
    void halve(const StarCell& at, VertexIndex midpoint);
    void join_halves(const StarCell& at, CellIndex second, std::uint8_t side,
                     const StarCell& beside, CellIndex second_beside);
};

}  // namespace octetra::rivals
