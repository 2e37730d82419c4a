#include "hubs/hubs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lookup/edge_table.hpp"

namespace octetra::verify {
namespace {

/// An entity as seen from an apex, through its vertices other than those of the apex.
struct View {
    double room = 0;   ///< approximate fraction of all directions in its box, times 4 pi
    double width = 0;  ///< approximate width across the line of sight
};

double longest_side(const Bounds& box) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.high[k] - box.low[k]);
    return longest;
}

double largest_difference(const Point& p, const Point& q) {
    return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

View view_from(const Apex& apex, std::span<const VertexIndex> entity,
               const IndexVector<VertexIndex, Point>& points) {
    const Viewpoint viewpoint = viewpoint_of(apex, points);
    std::array<Direction, 4> directions;
    std::size_t count = 0;
    double distance = 0;
    for (const VertexIndex v : entity) {
        if (apex.has(v)) continue;
        directions[count++] = viewpoint.towards(points[v]);
        distance = std::max(distance, largest_difference(points[v], points[apex.a]));
    }
    const Bounds box = bounds_of_directions({directions.data(), count});
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) sides[k] = box.high[k] - box.low[k];
    std::sort(sides.begin(), sides.end());
    // Relative to the circumference 2 pi, or to the area 4 pi of the sphere.
    return {apex.is_edge() ? 2 * sides[2] : sides[1] * sides[2], sides[2] * distance};
}

/// The minimum ratio of length to width for an entity without a hub to be assigned to a nearby one.
constexpr double slender = 8;

/// The distance from a hub, in edges, up to which slender entities are searched: these result from
/// refinement of cells at a hub, and every level doubles the distance.
constexpr int reach = 8;

}  // namespace

Viewpoint viewpoint_of(const Apex& apex, const IndexVector<VertexIndex, Point>& points) {
    return apex.is_edge() ? Viewpoint(points[apex.a], points[apex.b]) : Viewpoint(points[apex.a]);
}

Hubs::Hubs(const JudgedMesh& judged)
    : points_(&judged.mesh.points), many_(judged.many), degree_(judged.mesh.points.size(), 0) {
    judged.edges.for_each([&](const EdgeVertices& edge) {
        for (const VertexIndex v : edge) ++degree_[v.value()];
    });
    hubs_ = static_cast<std::size_t>(std::count_if(degree_.begin(), degree_.end(),
                                                   [this](std::uint32_t n) { return n > many_; }));
    if (none()) return;
    find_axes(judged);
    find_near_hubs(judged);
}

void Hubs::find_axes(const JudgedMesh& judged) {
    EdgeTable cells_around(16);
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (!judged.is_sound(c)) continue;
        const CellVertices& cell = judged.mesh.cells[c];
        for (const auto& [i, k] : cell_edges) {
            if (!is_hub(cell[i]) || !is_hub(cell[k])) continue;
            std::uint32_t& cells = cells_around.at(cell[i], cell[k]);
            cells = cells == EdgeTable::absent ? 1 : cells + 1;
            if (cells != many_ + 1) continue;
            const Apex edge{std::min(cell[i], cell[k]), std::max(cell[i], cell[k])};
            axes_.push_back({edge.a, edge});
            axes_.push_back({edge.b, edge});
        }
    }
    std::sort(axes_.begin(), axes_.end(), [](const Axis& s, const Axis& t) {
        return s.hub != t.hub ? s.hub < t.hub : s.edge < t.edge;
    });
}

/// Propagates from neighbour to neighbour, so that nearer hubs are found first.
void Hubs::find_near_hubs(const JudgedMesh& judged) {
    NearHubs nothing;
    nothing.fill(VertexIndex::none());
    near_.assign(degree_.size(), nothing);
    for (VertexIndex v{0}; v < judged.mesh.points.end_index(); ++v) {
        if (is_hub(v)) near_[v.value()][0] = v;
    }
    for (int distance = 1; distance <= reach; ++distance) {
        const std::vector<NearHubs> before = near_;
        bool changed = false;
        const auto add_near_hub = [&](VertexIndex from, VertexIndex to) {
            for (const VertexIndex hub : before[from.value()]) {
                if (hub.is_none()) return;
                NearHubs& known = near_[to.value()];
                const auto place = std::find_if(known.begin(), known.end(), [&](VertexIndex h) {
                    return h.is_none() || h == hub;
                });
                if (place == known.end() || *place == hub) continue;
                *place = hub;
                changed = true;
            }
        };
        judged.edges.for_each([&](const EdgeVertices& edge) {
            add_near_hub(edge[0], edge[1]);
            add_near_hub(edge[1], edge[0]);
        });
        if (!changed) return;
    }
}

std::vector<Hubs::Axis>::const_iterator Hubs::first_axis_at(VertexIndex hub) const {
    return std::lower_bound(axes_.begin(), axes_.end(), hub,
                            [](const Axis& s, VertexIndex v) { return s.hub < v; });
}

/// Calls visit(apex) for a hub, and for the edges at it that are hubs.
void Hubs::for_each_view(VertexIndex hub, bool from_edges, auto&& visit) const {
    visit(Apex{hub, VertexIndex::none()});
    if (!from_edges) return;
    for (auto axis = first_axis_at(hub); axis != axes_.end() && axis->hub == hub; ++axis)
        visit(axis->edge);
}

std::optional<Vector> Hubs::axis_at(const Apex& apex) const {
    Apex edge = apex;
    if (!apex.is_edge()) {
        const auto axis = first_axis_at(apex.a);
        if (axis == axes_.end() || axis->hub != apex.a) return std::nullopt;
        edge = axis->edge;
    }
    const Direction direction = Viewpoint((*points_)[edge.a]).towards((*points_)[edge.b]);
    if (!direction.is_known()) return std::nullopt;
    return direction.unit;
}

Apex Hubs::apex_of(std::span<const VertexIndex> entity) const {
    if (none()) return {};
    const Apex apex = apex_at(entity);
    return apex.is_none() ? apex_near(entity) : apex;
}

/// Returns the apex, among the hubs that the entity contains and the edges at them, from which it
/// occupies the least room. For an edge, which is a point as seen from both ends, returns the end
/// with the most edges.
Apex Hubs::apex_at(std::span<const VertexIndex> entity) const {
    Apex best;
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t most = 0;
    for (const VertexIndex v : entity) {
        if (!is_hub(v)) continue;
        if (entity.size() == 2) {
            if (degree_[v.value()] > most) best = {v, VertexIndex::none()};
            most = std::max(most, degree_[v.value()]);
            continue;
        }
        for_each_view(v, true, [&](const Apex& apex) {
            const double room = view_from(apex, entity, *points_).room;
            if (room < least || best.is_none()) best = apex;
            least = std::min(least, room);
        });
    }
    return best;
}

/// Returns the apex, among the hubs nearby and the edges at them, from which the entity occupies
/// the least room, if it is slender from there.
Apex Hubs::apex_near(std::span<const VertexIndex> entity) const {
    Apex best;
    double least = std::numeric_limits<double>::infinity();
    Bounds box;
    for (const VertexIndex v : entity) box.take((*points_)[v]);
    const double length = longest_side(box);
    std::array<VertexIndex, 4 * NearHubs{}.size()> met;  // neighbours mostly share nearby hubs
    std::size_t met_count = 0;
    for (const VertexIndex v : entity) {
        for (const VertexIndex hub : near_[v.value()]) {
            if (hub.is_none()) break;
            const auto end = met.begin() + static_cast<std::ptrdiff_t>(met_count);
            if (std::find(met.begin(), end, hub) != end) continue;
            met[met_count++] = hub;
            for_each_view(hub, entity.size() > 2, [&](const Apex& apex) {
                const View view = view_from(apex, entity, *points_);
                if (!(slender * view.width < length) || view.room >= least) return;
                best = apex;
                least = view.room;
            });
        }
    }
    return best;
}

}  // namespace octetra::verify
