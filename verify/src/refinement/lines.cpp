#include "refinement/lines.hpp"

namespace octetra::verify {
namespace {

constexpr std::uint32_t no_midpoint = EdgeTable::absent - 1;

}  // namespace

Lines::Lines(const JudgedMesh& fine, const PointLookup& places)
    : fine_(&fine),
      places_(&places),
      midpoints_(fine.mesh.points.size()),
      halves_(fine.mesh.points.size(), 0) {}

VertexIndex Lines::midpoint(VertexIndex a, VertexIndex b) {
    const Point& p = fine_->mesh.points[a];
    const Point& q = fine_->mesh.points[b];
    const Point half = octetra::midpoint(p, q);
    if (half == p || half == q) return VertexIndex::none();  // otherwise infinite recursion
    if (places_->find(half, [](VertexIndex) { return true; }).is_none()) return VertexIndex::none();

    const std::uint32_t known = midpoints_.find(a, b);
    if (known == no_midpoint) return VertexIndex::none();
    if (known != EdgeTable::absent) return VertexIndex{known};
    const VertexIndex m =
        places_->find(half, [&](VertexIndex v) { return is_line(a, v) && is_line(v, b); });
    if (!m.is_none()) halves_[m.value()] = 1;
    midpoints_.at(a, b) = m.is_none() ? no_midpoint : m.value();
    return m;
}

}  // namespace octetra::verify
