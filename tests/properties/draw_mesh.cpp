#include "properties/draw_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <octetra/core/orientation.hpp>
#include <octetra/verify/verify.hpp>

#include "distributed/marked_mesh.hpp"
#include "properties/shapes.hpp"
#include "properties/submesh.hpp"

namespace octetra::properties {
namespace {

void move_points(Mesh& mesh, const std::function<Point(const Point&)>& to) {
    for (Point& p : mesh.points) p = to(p);
}

/// Keeps a few random cells or a fraction of all, which leaves holes, and components that meet at
/// vertices and edges.
Mesh some_cells(const Mesh& mesh, Draw& draw) {
    std::vector<char> keep(mesh.cells.size(), 0);
    if (draw.chance(0.5)) {
        const double share = draw.unit();
        for (char& k : keep) k = draw.chance(share) ? 1 : 0;
    }
    for (int i = draw.between(1, 5); i > 0; --i) keep[draw.below(keep.size())] = 1;
    return submesh(mesh, keep);
}

/// Places the second mesh to the right of the first, so that the rightmost vertex of the first is
/// the leftmost one of the second.
Mesh joined_at_a_vertex(const Mesh& left, const Mesh& right) {
    const auto last = std::ranges::max_element(left.points, std::less<>{});
    const auto first = std::ranges::min_element(right.points, std::less<>{});
    const VertexIndex joint{static_cast<std::size_t>(last - left.points.begin())};
    const VertexIndex gone{static_cast<std::size_t>(first - right.points.begin())};
    Mesh both;
    both.points = left.points;
    both.cells = left.cells;
    IndexVector<VertexIndex, VertexIndex> number;
    for (VertexIndex v{0}; v < right.points.end_index(); ++v) {
        const Point& p = right.points[v];
        if (v == gone) {
            number.append(joint);
        } else {
            number.append(both.points.append(
                {p.x - first->x + last->x, p.y - first->y + last->y, p.z - first->z + last->z}));
        }
    }
    for (CellVertices cell : right.cells) {
        for (VertexIndex& v : cell) v = number[v];
        both.cells.append(cell);
    }
    return both;
}

double power_of_ten(Draw& draw, int low, int high) {
    return std::pow(10.0, low + (high - low) * draw.unit());
}

/// Stretches by up to 10^6 along one axis.
void stretch(Mesh& mesh, Draw& draw) {
    const double factor = power_of_ten(draw, 0, 6);
    const std::size_t axis = draw.below(3);
    move_points(mesh, [&](const Point& p) {
        return Point{axis == 0 ? p.x * factor : p.x, axis == 1 ? p.y * factor : p.y,
                     axis == 2 ? p.z * factor : p.z};
    });
}

/// Moves so far along one axis that the spacing of floating-point numbers is close to the size of
/// cells: after a level or two midpoints cannot be represented, and cells may be flat.
void move_to_the_last_bits(Mesh& mesh, Draw& draw) {
    const int digits = draw.between(0, 10);
    const double away = std::ldexp(1.0, 52 - digits);
    const std::size_t axis = draw.below(3);
    move_points(mesh, [&](const Point& p) {
        return Point{axis == 0 ? p.x + away : p.x, axis == 1 ? p.y + away : p.y,
                     axis == 2 ? p.z + away : p.z};
    });
}

/// Moves away from the origin, so that midpoints are rounded.
void move_away(Mesh& mesh, Draw& draw) {
    const double x = power_of_ten(draw, 2, 12);
    const double y = draw.chance(0.5) ? power_of_ten(draw, 2, 12) : 0;
    move_points(mesh, [&](const Point& p) { return Point{p.x + x, p.y + y, p.z}; });
}

/// Scales to tiny or huge sizes; volumes stay in the range of double.
void magnify(Mesh& mesh, Draw& draw) {
    const double factor = power_of_ten(draw, -90, 90);
    move_points(mesh, [&](const Point& p) {
        return Point{p.x * factor, p.y * factor, p.z * factor};
    });
}

void turn(Mesh& mesh, Draw& draw) {
    const double c = 2 * draw.unit() - 1;
    const double s = std::sqrt(1 - c * c);
    move_points(mesh, [&](const Point& p) {
        return Point{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    });
}

bool is_valid(const Mesh& mesh) {
    for (const auto& [i, j, k, l] : mesh.cells) {
        const auto& p = mesh.points;
        if (orientation(p[i], p[j], p[k], p[l]) <= 0) return false;
    }
    return verify::verify_mesh(mesh).valid();
}

/// Removes duplicates, because their markers could conflict.
template <class I, std::size_t N>
void list_once(IndexVector<I, std::array<VertexIndex, N>>& list, IndexVector<I, Marker>& markers) {
    std::set<std::array<VertexIndex, N>> listed;
    I kept{0};
    for (I i{0}; i < list.end_index(); ++i) {
        auto sorted = list[i];
        std::ranges::sort(sorted);
        if (!listed.insert(sorted).second) continue;
        list[kept] = list[i];
        markers[kept] = markers[i];
        ++kept;
    }
    list.resize(kept.value());
    markers.resize(kept.value());
}

Mesh with_marks(Mesh mesh, Draw& draw) {
    if (draw.chance(0.3)) {
        mesh.facets.clear();
        mesh.facet_markers.clear();
        mesh.regions.clear();
        mesh = test::marked(mesh, draw.any());
        list_once(mesh.facets, mesh.facet_markers);
        list_once(mesh.edges, mesh.edge_markers);
        return mesh;
    }
    if (draw.chance(0.3) && mesh.facets.empty()) test::list_boundary(mesh);
    mesh.index_base = static_cast<std::uint32_t>(draw.below(2));
    return mesh;
}

using Change = void (*)(Mesh&, Draw&);

/// Applies the change with this probability, and keeps it if the mesh stays valid.
void attempt(Mesh& mesh, Draw& draw, double probability, Change change) {
    if (!draw.chance(probability)) return;
    Mesh changed = mesh;
    change(changed, draw);
    if (is_valid(changed)) mesh = std::move(changed);
}

void put_on_a_grid(Mesh& mesh, Draw& /*draw*/) {
    const auto rounded = [](double x) { return std::round(x * 0x1p16) * 0x1p-16; };
    move_points(mesh, [&](const Point& p) {
        return Point{rounded(p.x), rounded(p.y), rounded(p.z)};
    });
}

NamedMesh draw_components(Draw& draw, int size) {
    NamedMesh drawn = draw_shape(draw, size);
    if (draw.chance(0.1)) {
        const NamedMesh other = draw_shape(draw, size / 2);
        Mesh both = joined_at_a_vertex(drawn.mesh, other.mesh);
        if (is_valid(both)) drawn = {drawn.kind + " + " + other.kind, std::move(both)};
    }
    if (draw.chance(0.4)) drawn.mesh = some_cells(drawn.mesh, draw);
    return drawn;
}

}  // namespace

NamedMesh draw_mesh(Draw& draw, int size) {
    NamedMesh drawn = draw_components(draw, size);
    while (!is_valid(drawn.mesh)) drawn = draw_components(draw, size);
    attempt(drawn.mesh, draw, 0.2, turn);
    attempt(drawn.mesh, draw, 0.2, stretch);
    attempt(drawn.mesh, draw, 0.15, move_away);
    attempt(drawn.mesh, draw, 0.4, move_to_the_last_bits);
    attempt(drawn.mesh, draw, 0.15, magnify);
    drawn.mesh = with_marks(std::move(drawn.mesh), draw);
    return drawn;
}

NamedMesh draw_exact_mesh(Draw& draw, int size) {
    while (true) {
        NamedMesh drawn = draw_components(draw, size);
        put_on_a_grid(drawn.mesh, draw);
        if (!is_valid(drawn.mesh)) continue;
        drawn.mesh = with_marks(std::move(drawn.mesh), draw);
        return drawn;
    }
}

}  // namespace octetra::properties
