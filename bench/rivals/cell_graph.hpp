#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

/// Cells with their face neighbours, updated as stars are bisected.
namespace octetra::rivals {

inline constexpr std::uint32_t no_waiter = 0xffffffff;

struct LinkedCell {
    CellVertices vertices;
    std::array<CellIndex, 4> neighbours;     ///< behind the face opposite each vertex; may be none
    CellIndex root;                          ///< the cell of the input from which it descends
    std::uint32_t first_waiter = no_waiter;  ///< see WantedEdges
    std::uint8_t longest = 0;                ///< an index in cell_edges
    bool longest_is_wanted = false;
};

/// Returns the edge with its lower vertex first.
[[nodiscard]] inline EdgeVertices ascending(EdgeVertices edge) {
    if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
    return edge;
}

/// A key of the edge, independent of the order of its ends.
[[nodiscard]] inline std::uint64_t edge_key(const EdgeVertices& edge) {
    const auto [low, high] = ascending(edge);
    return std::uint64_t{low.value()} << 32U | high.value();
}

/// One of the cells around an edge ab, by positions in it.
struct StarCell {
    CellIndex cell;
    std::uint8_t a = 0;
    std::uint8_t b = 0;
    std::uint8_t next = 0;      ///< the next cell of the star is behind the face opposite this
    std::uint8_t previous = 0;  ///< and the previous one behind the face opposite this
    bool joins_previous = false;
};

/// The cells around an edge in rows, in which each cell is behind a face of the previous one: a
/// ring, or rows from boundary to boundary. There are several rows where cells of another rank, or
/// gaps, lie between the cells around the edge.
struct Star {
    std::vector<StarCell> cells;
    bool is_ring = false;
};

struct CellGraph {
    IndexVector<VertexIndex, Point> points;
    IndexVector<CellIndex, LinkedCell> cells;
    /// The successor of each cell in the order of results; none() after the last.
    IndexVector<CellIndex, CellIndex> next;
    /// A cell of each row around edges that have several rows, and around edges that must be found
    /// by their ends; indexed by edge_key().
    std::unordered_map<std::uint64_t, std::vector<CellIndex>> rows;

    /// Throws InputError if a face has three cells.
    explicit CellGraph(const Mesh& mesh);

    [[nodiscard]] Corners corners(CellIndex c) const {
        const auto& [p, q, r, s] = cells[c].vertices;
        return {points[p], points[q], points[r], points[s]};
    }
    [[nodiscard]] EdgeVertices longest_edge_of(CellIndex c) const {
        const auto& [i, j] = cell_edges[cells[c].longest];
        return {cells[c].vertices[i], cells[c].vertices[j]};
    }
    /// Finds the cells around the longest edge of a cell. Reuses the memory of `star`.
    void find_star(CellIndex c, Star& star) const;
    /// The same for an edge whose rows are known.
    void find_star(const EdgeVertices& edge, Star& star) const;
    /// Adds the row of a cell around one of its edges unless it is known.
    void add_row(const EdgeVertices& edge, CellIndex c);
    /// Halves all cells of a star at a vertex between a and b. The first half of star.cells[i]
    /// keeps its index and the waiters; the second half is appended as the i-th new cell. The
    /// caller sets the data on longest edges of both.
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
                     const StarCell& beside, CellIndex second_neighbour);
};

}  // namespace octetra::rivals
