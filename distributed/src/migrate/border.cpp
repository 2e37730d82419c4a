#include "migrate/border.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "history/vertex_levels.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {
namespace {

/// The midpoints of edges that may be shared, by edge: edges whose ends are vertices of shared
/// input edges, or midpoints between such vertices.
class BorderMidpoints {
    using Entry = std::pair<EdgeVertices, VertexIndex>;

public:
    BorderMidpoints(const DistributedMesh& mesh, const std::vector<Interface>& of_input) {
        IndexVector<VertexIndex, std::uint8_t> is_border;
        is_border.assign(mesh.points.size(), 0);
        for (const Interface& interface : of_input) {
            for (const auto& edge : interface.edges) {
                for (const VertexIndex v : edge) is_border[v] = 1;
            }
        }
        VertexIndex midpoint{mesh.input_vertices.size()};
        for (const EdgeVertices& edge : mesh.midpoint_to_edge) {
            if (is_border[edge[0]] != 0 && is_border[edge[1]] != 0) {
                is_border[midpoint] = 1;
                midpoints_.push_back({edge, midpoint});
            }
            ++midpoint;
        }
        std::ranges::sort(midpoints_);
        begin_.assign(mesh.points.size() + 1, 0);
        for (const auto& [edge, m] : midpoints_) ++begin_[edge[0].value() + 1U];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    }

    /// Returns the midpoint, or none() if the edge is not bisected.
    [[nodiscard]] VertexIndex of(VertexIndex a, VertexIndex b) const {
        const auto [low, high] = std::minmax(a, b);
        const auto end = midpoints_.begin() + begin_[low.value() + 1U];
        const auto found =
            std::lower_bound(midpoints_.begin() + begin_[low.value()], end, high,
                             [](const Entry& entry, VertexIndex v) { return entry.first[1] < v; });
        if (found != end && found->first[1] == high) return found->second;
        return VertexIndex::none();
    }

private:
    std::vector<Entry> midpoints_;      ///< sorted by edge
    std::vector<std::uint32_t> begin_;  ///< offset of the midpoints of edges with this lower end
};

/// Traverses the descendants of shared edges and faces of the input.
class Descent {
public:
    Descent(const DistributedMesh& mesh, const BorderMidpoints& midpoints, BorderWith& border)
        : mesh_(&mesh), levels_(mesh), midpoints_(&midpoints), border_(&border) {}

    void edge(VertexIndex a, VertexIndex b) {
        const VertexIndex midpoint = midpoints_->of(a, b);
        if (midpoint.is_none()) {
            border_->interface.edges.push_back({std::min(a, b), std::max(a, b)});
            return;
        }
        border_->midpoints.push_back(midpoint);
        edge(a, midpoint);
        edge(midpoint, b);
    }

    void face(const FacetVertices& vertices) {
        std::array<VertexIndex, 3> midpoints = midpoints_of(vertices);
        const VertexIndex first = *std::ranges::min_element(midpoints);
        if (first.is_none()) {
            border_->interface.faces.push_back(vertices);
            return;
        }
        // The first level that bisects the face may leave some of its edges to its children.
        const VertexIndex end = levels_.end(levels_.of(first));
        for (VertexIndex& m : midpoints) m = m < end ? m : VertexIndex::none();
        const BisectedTriangle bisected = bisect_triangle(vertices, midpoints, mesh_->points);
        for (std::size_t k = 0; k < bisected.inner_edge_count; ++k) {
            edge(bisected.inner_edges[k][0], bisected.inner_edges[k][1]);
        }
        for (std::size_t k = 0; k < bisected.piece_count; ++k) face(bisected.pieces[k]);
    }

private:
    [[nodiscard]] std::array<VertexIndex, 3> midpoints_of(const FacetVertices& face) const {
        std::array<VertexIndex, 3> midpoints;
        for (std::size_t e = 0; e < 3; ++e) {
            const auto [i, j] = triangle_edges[e];
            midpoints[e] = midpoints_->of(face[i], face[j]);
        }
        return midpoints;
    }

    const DistributedMesh* mesh_;
    VertexLevels levels_;
    const BorderMidpoints* midpoints_;
    BorderWith* border_;
};

}  // namespace

std::vector<BorderWith> border_after_steps(const DistributedMesh& mesh,
                                           const std::vector<Interface>& of_input) {
    const BorderMidpoints midpoints(mesh, of_input);
    std::vector<BorderWith> borders;
    for (const Interface& interface : of_input) {
        BorderWith& border = borders.emplace_back();
        border.interface.rank = interface.rank;
        Descent descent(mesh, midpoints, border);
        for (const auto& [a, b] : interface.edges) descent.edge(a, b);
        for (const FacetVertices& face : interface.faces) descent.face(face);
        std::ranges::sort(border.interface.edges);
        std::ranges::sort(border.interface.faces);
        std::ranges::sort(border.midpoints);
    }
    return borders;
}

}  // namespace octetra::distributed
