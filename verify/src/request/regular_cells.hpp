#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "lookup/edge_table.hpp"
#include "refinement/bisected_edges.hpp"
#include "refinement/lines.hpp"
#include "request/requested_refinement.hpp"

namespace octetra::verify {

/// The regular cells between a coarse mesh and a fine one, as docs/shapes.md defines them, and the
/// set of bisected edges of regular cells that creates them. All vertices are those of the fine
/// mesh.
///
/// Rules (2) and (3) are applied to a cell when it is created, and again when an edge is added to
/// the set that the cell has, or that lies on the cell's edge or face.
class RegularCells {
public:
    using CellNumber = std::uint32_t;  ///< a position in the list of cells
    static constexpr CellNumber none = std::numeric_limits<std::uint32_t>::max();

    RegularCells(const std::vector<DescendantCell>& roots,
                 const IndexVector<VertexIndex, Point>& points, Lines& lines);

    // Each adds to the set: an edge, or the six of a cell.
    void add(const EdgeVertices& edge) { add(number_of(edge)); }
    void add_edges_of(CellNumber c);
    /// Applies rules (2) and (3) until they add nothing.
    void close();
    /// Returns whether the rules must be applied again.
    [[nodiscard]] bool is_open() const { return !unexamined_.empty(); }
    /// Returns the edges that were added since the last call.
    [[nodiscard]] std::vector<EdgeVertices> take_added() { return std::exchange(added_, {}); }

    /// Calls visit(edge) for each edge of a regular cell that is in the set, but has no midpoint in
    /// the fine mesh. The children of its cells are unknown.
    void for_each_without_midpoint(auto&& visit) const {
        for (const EdgeNumber e : without_midpoint_) {
            if (edges_[e].first_cell != none) visit(edges_[e].ends);
        }
    }
    /// Calls visit(edge) for each edge of a regular cell that is not in the set.
    void for_each_whole_edge(auto&& visit) const {
        for (const Edge& edge : edges_) {
            if (!edge.is_bisected && edge.first_cell != none) visit(edge.ends);
        }
    }
    /// Calls visit(cell, c, is_transition) for each cell of the mesh, where c is the cell itself,
    /// or the parent of a transition cell. Precondition: all edges in the set have midpoints.
    void for_each_cell(auto&& visit) const {
        for (CellNumber c = 0; c < cells_.size(); ++c) {
            if (cells_[c].first_child != none) continue;
            const BisectedEdges bisected = bisected_edges(c);
            const CellIndex root = cells_[c].root;
            bisected.for_each_piece(cells_[c].vertices, [&](const CellVertices& piece) {
                visit(DescendantCell{piece, root}, c, bisected.size() > 0);
            });
        }
    }
    /// Returns the child of a cell with these vertices, in any order, or `none`.
    [[nodiscard]] CellNumber child_of(CellNumber c, const CellVertices& vertices) const;

private:
    using EdgeNumber = std::uint32_t;  ///< a position in the list of edges

    struct Edge {
        EdgeVertices ends;                           ///< ascending
        VertexIndex midpoint = VertexIndex::none();  ///< only of an edge in the set
        CellNumber first_cell = none;                ///< the last one created that has this edge
        /// The edge that this one is a half of; of an edge in a face of the cells of the previous
        /// generation, the longest of that face. `none` if there is none, or it is unknown yet.
        EdgeNumber above = none;
        bool is_bisected = false;  ///< whether it is in the set
    };
    struct Cell {
        CellVertices vertices;
        CellIndex root;
        std::array<EdgeNumber, 6> edges{};
        std::array<CellNumber, 6> next_cell{};  ///< the next one that has the edge, or `none`
        CellNumber first_child = none;          ///< of eight
        bool waits = false;                     ///< whether it is among the unexamined cells
    };

    EdgeNumber number_of(const EdgeVertices& edge);
    void add(EdgeNumber e);
    void append(const CellVertices& vertices, CellIndex root);
    void create_children(CellNumber c);
    void link_to_parent(const Cell& child, const Cell& parent);
    void apply_rules(CellNumber c);
    void examine(CellNumber c);
    void examine_cells_with(EdgeNumber e);

    [[nodiscard]] bool is_longer(EdgeNumber e, EdgeNumber f) const;
    [[nodiscard]] EdgeNumber longest_of(const std::array<EdgeNumber, 3>& face) const;
    [[nodiscard]] bool is_bisected(VertexIndex a, VertexIndex b) const;
    [[nodiscard]] bool has_bisected_piece(const std::array<EdgeNumber, 3>& face) const;
    [[nodiscard]] BisectedEdges bisected_edges(CellNumber c) const;

    const IndexVector<VertexIndex, Point>& points_;
    Lines& lines_;
    std::vector<Cell> cells_;
    std::vector<Edge> edges_;
    EdgeTable numbers_{16};  ///< of edges
    std::vector<CellNumber> unexamined_;
    std::vector<EdgeVertices> added_;
    std::vector<EdgeNumber> without_midpoint_;
};

}  // namespace octetra::verify
