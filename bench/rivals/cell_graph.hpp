#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
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

/// The end with the lower number first.
[[nodiscard]] inline EdgeVertices ascending(EdgeVertices edge) {
    if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
    return edge;
}

/// Of an edge, whichever of its ends is first.
[[nodiscard]] inline std::uint64_t edge_key(const EdgeVertices& edge) {
    const auto [low, high] = ascending(edge);
    return std::uint64_t{low.value()} << 32U | high.value();
}

/// One of the cells around an edge ab, by positions in it.
struct StarCell {
    CellIndex cell;
    std::uint8_t a = 0;
    std::uint8_t b = 0;
    std::uint8_t next = 0;      ///< behind the face opposite this one is the next of the star
    std::uint8_t previous = 0;  ///< and the previous one behind this
    bool joins_previous = false;
};

/// The cells around an edge, row after row, each cell behind a face of the one before: a ring, or
/// rows from boundary to boundary, of which there are several where the cells around an edge have
/// others between them, of another rank, or nothing.
struct Star {
    std::vector<StarCell> cells;
    bool is_ring = false;
};

struct CellGraph {
    IndexVector<VertexIndex, Point> points;
    IndexVector<CellIndex, LinkedCell> cells;
    /// The cell that follows each in the order of results; none() after the last.
    IndexVector<CellIndex, CellIndex> next;
    /// A cell of each row around an edge that has several, and around those that are to be found
    /// by their ends; by edge_key().
    std::unordered_map<std::uint64_t, std::vector<CellIndex>> rows;

    /// Throws InputError where three cells have a face in common.
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
    /// The same for an edge whose rows are known.
    void find_star(const EdgeVertices& edge, Star& star) const;
    /// Makes the row of a cell around one of its edges known, unless it is.
    void add_row(const EdgeVertices& edge, CellIndex c);
    /// Halves all cells of a star at a vertex between a and b. The first half of star.cells[i] has
    /// its number, the other one is appended, as number i of those that are new; what belongs to
    /// longest edges is to be set of both, and the waiters are the first one's.
    void bisect(const Star& star, VertexIndex midpoint);

private:
    void find_several_rows();
    void append_row(const StarCell& first, Star& star) const;
    void append_other_rows(Star& star) const;
    void walk(Star& star) const;
    [[nodiscard]] StarCell place(CellIndex c, const EdgeVertices& edge) const;
    [[nodiscard]] EdgeVertices edge_of(const StarCell& at) const {
        return {cells[at.cell].vertices[at.a], cells[at.cell].vertices[at.b]};
    }
    void put_into_row(const EdgeVertices& edge, CellIndex old, CellIndex now);
    void halve_rows(const Star& star, const EdgeVertices& edge, VertexIndex midpoint);
    void halve(const StarCell& at, VertexIndex midpoint);
    void join_halves(const StarCell& at, CellIndex second, std::uint8_t side,
                     const StarCell& beside, CellIndex second_beside);
};

}  // namespace octetra::rivals
