#include <algorithm>
#include <map>
#include <set>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/reference/history.hpp>

#include "bisect.hpp"

namespace octetra::reference {
namespace {

/// Returns the edges of a cell, facet or edge, the lower end of each first.
template <std::size_t N>
std::vector<EdgeVertices> edges_of(const std::array<VertexIndex, N>& vertices) {
    std::vector<EdgeVertices> edges;
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = i + 1; j < N; ++j) {
            const auto& [low, high] = std::minmax(vertices[i], vertices[j]);
            edges.push_back({low, high});
        }
    }
    return edges;
}

std::array<FacetVertices, 4> faces_of(const CellVertices& cell) {
    std::array<FacetVertices, 4> faces;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = 0; i < 3; ++i) faces[k][i] = cell[cell_faces[k][i]];
    }
    return faces;
}

/// The regular cells of a mesh, which its input and the set B of bisected edges define. Midpoints
/// get numbers when they are first needed, so that a number does not imply a position in the
/// canonical order.
class RegularCells {
public:
    explicit RegularCells(const History& history) : input_(history.input) {
        const Refinement present = replay(history).back();
        points_ = present.mesh.points;
        VertexIndex next = present.maps.first_midpoint;
        for (const EdgeVertices& edge : present.maps.midpoint_to_edge) {
            midpoints_[edge] = next;
            bisected_.insert(edge);
            ++next;
        }
    }

    /// Implements rule (1).
    void add(const CellMarks& marked) {
        std::vector<CellVertices> refined;
        CellIndex next{0};
        for_each_cell([&](const CellVertices& cell, const CellVertices& regular) {
            const CellIndex c = next;
            ++next;
            if (marked[c] == 0) return;
            refined.push_back(regular);
            for (const CellVertices& child : children_of(regular)) {
                if (std::ranges::is_permutation(child, cell)) refined.push_back(child);
            }
        });
        for (const CellVertices& cell : refined) bisect_all(cell);
    }

    /// Implements rules (2) and (3).
    void close() {
        for (std::size_t before = 0; before < bisected_.size();) {
            before = bisected_.size();
            for (const CellVertices& root : input_.cells) close(root);
        }
    }

    [[nodiscard]] History history() {
        History steps{input_, {}};
        std::map<VertexIndex, VertexIndex> number;  // in the canonical order
        VertexIndex next{0};
        for (; next < input_.points.end_index(); ++next) number[next] = next;
        std::vector<CellVertices> cells(input_.cells.begin(), input_.cells.end());
        while (true) {
            std::map<EdgeVertices, VertexIndex> step;  // with the midpoint of each edge
            std::vector<CellVertices> children;
            for (const CellVertices& cell : cells) {
                for (const EdgeVertices& edge : edges_of(cell)) {
                    const auto& [low, high] = std::minmax(number[edge[0]], number[edge[1]]);
                    if (is_bisected(edge)) step[{low, high}] = midpoint_of(edge);
                }
                if (!has_children(cell)) continue;
                for (const CellVertices& child : children_of(cell)) children.push_back(child);
            }
            if (step.empty()) return steps;
            steps.steps.emplace_back();
            for (const auto& [edge, midpoint] : step) {
                steps.steps.back().push_back(edge);
                number[midpoint] = next;
                ++next;
            }
            cells = children;
        }
    }

private:
    [[nodiscard]] bool is_bisected(const EdgeVertices& edge) const {
        return bisected_.contains(edge);
    }
    [[nodiscard]] bool has_children(const CellVertices& cell) const {
        return std::ranges::all_of(edges_of(cell), [&](auto& edge) { return is_bisected(edge); });
    }
    void bisect_all(const CellVertices& cell) {
        for (const EdgeVertices& edge : edges_of(cell)) bisected_.insert(edge);
    }

    VertexIndex midpoint_of(const EdgeVertices& edge) {
        const auto [place, is_new] = midpoints_.try_emplace(edge, points_.end_index());
        if (is_new) points_.append(midpoint(points_[edge[0]], points_[edge[1]]));
        return place->second;
    }
    [[nodiscard]] bool is_longer(const EdgeVertices& e, const EdgeVertices& f) const {
        return longer({points_[e[0]], points_[e[1]]}, {points_[f[0]], points_[f[1]]});
    }

    /// Returns the pieces into which these edges bisect a cell or face.
    template <std::size_t N>
    std::vector<std::array<VertexIndex, N>> pieces_of(const std::array<VertexIndex, N>& whole,
                                                      const std::vector<EdgeVertices>& edges) {
        std::vector<BisectedEdge> longest_first;
        for (const EdgeVertices& edge : edges) longest_first.push_back({edge, midpoint_of(edge)});
        std::ranges::sort(longest_first, [&](const BisectedEdge& e, const BisectedEdge& f) {
            return is_longer(e.ends, f.ends);
        });
        std::vector<std::array<VertexIndex, N>> pieces;
        bisect(whole, longest_first, pieces);
        return pieces;
    }
    std::vector<CellVertices> children_of(const CellVertices& cell) {
        return pieces_of(cell, edges_of(cell));
    }

    /// Closes a regular cell and its regular descendants.
    void close(const CellVertices& cell) {
        for (const FacetVertices& face : faces_of(cell)) {
            const auto edges = edges_of(face);
            if (std::ranges::none_of(edges, [&](auto& e) { return is_bisected(e); })) continue;
            bisected_.insert(*std::ranges::min_element(
                edges, [&](auto& e, auto& f) { return is_longer(e, f); }));
            for (const FacetVertices& triangle : pieces_of(face, edges)) {
                for (const EdgeVertices& edge : edges_of(triangle)) {
                    if (is_bisected(edge)) bisect_all(cell);
                }
            }
        }
        if (!has_children(cell)) return;
        for (const CellVertices& child : children_of(cell)) close(child);
    }

    /// Calls f(cell, regular) for each cell of the mesh in canonical order; `regular` is the cell
    /// itself or the parent of a transition cell.
    void for_each_cell(auto&& f) {
        for (const CellVertices& root : input_.cells) for_each_cell(root, f);
    }
    void for_each_cell(const CellVertices& regular, auto&& f) {
        std::vector<EdgeVertices> edges = edges_of(regular);
        std::erase_if(edges, [&](auto& edge) { return !is_bisected(edge); });
        for (const CellVertices& piece : pieces_of(regular, edges)) {
            if (edges.size() == 6) {
                for_each_cell(piece, f);
            } else {
                f(piece, regular);
            }
        }
    }

    Mesh input_;
    IndexVector<VertexIndex, Point> points_;
    std::map<EdgeVertices, VertexIndex> midpoints_;  ///< also of edges that are not bisected
    std::set<EdgeVertices> bisected_;                ///< B
};

}  // namespace

History refined_regularly(const History& history, const CellMarks& marked) {
    const StandardArithmetic standard;
    RegularCells cells(history);
    cells.add(marked);
    cells.close();
    return cells.history();
}

Refinement refine_regularly(const Mesh& mesh, const Selection& selection, int levels,
                            std::size_t max_cells) {
    const StandardArithmetic standard;
    History history{mesh, {}};
    Refinement result = unrefined(mesh);
    for (int level = 1; level <= levels; ++level) {
        history = refined_regularly(history, marked_cells(result, selection));
        result = replay(history, max_cells).back();
    }
    return result;
}

}  // namespace octetra::reference
