#include "refinement/lines.hpp"

namespace octetra::verify {
namespace {

constexpr std::uint32_t no_midpoint = EdgeTable::absent - 1;

}  // namespace

Lines::Lines(const JudgedMesh& fine, const PointLookup& places)
    : mesh_(&fine.mesh),
      places_(&places),
      whole_(2 * fine.mesh.cells.size()),
      midpoints_(2 * fine.mesh.cells.size()),
      halves_(fine.mesh.points.size(), 0) {
    fine.edges.for_each([&](const EdgeVertices& edge) { whole_.at(edge[0], edge[1]) = 1; });
}

VertexIndex Lines::midpoint(VertexIndex a, VertexIndex b) {
    const std::uint32_t known = midpoints_.find(a, b);
    if (known == no_midpoint) return VertexIndex::none();
    if (known != EdgeTable::absent) return VertexIndex{known};

    const Point& p = mesh_->points[a];
    const Point& q = mesh_->points[b];
    const Point half = octetra::midpoint(p, q);
    VertexIndex m = VertexIndex::none();
    if (half != p && half != q) {  // otherwise infinite recursion
        m = places_->find(half, [&](VertexIndex v) { return is_line(a, v) && is_line(v, b); });
    }
    if (!m.is_none()) halves_[m.value()] = 1;
    midpoints_.at(a, b) = m.is_none() ? no_midpoint : m.value();
    return m;
}

}  // namespace octetra::verify
