#include "properties/small_worlds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <octetra/core/edge_order.hpp>
#include <octetra/verify/verify.hpp>

#include "properties/draw.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

namespace octetra::properties {
namespace {

using Complex = std::vector<std::array<std::size_t, 4>>;

/// Three cells that share so many vertices: all three, and each pair beside these.
Complex three_cells(std::size_t all, std::size_t ab, std::size_t ac, std::size_t bc) {
    std::array<std::vector<std::size_t>, 3> cells;
    std::size_t next = 0;
    const auto add = [&](std::size_t count, std::initializer_list<std::size_t> to) {
        for (; count > 0; --count, ++next) {
            for (const std::size_t cell : to) cells[cell].push_back(next);
        }
    };
    add(all, {0, 1, 2});
    add(ab, {0, 1});
    add(ac, {0, 2});
    add(bc, {1, 2});
    Complex complex;
    for (std::size_t c = 0; c < 3; ++c) {
        add(4 - cells[c].size(), {c});
        complex.push_back({cells[c][0], cells[c][1], cells[c][2], cells[c][3]});
    }
    return complex;
}

Complex two_cells(std::size_t shared) {
    Complex complex = three_cells(0, shared, 0, 0);
    complex.pop_back();
    return complex;
}

// ---- cells by the lengths of their edges
// -----------------------------------------------------------

using Order = std::array<std::size_t, 6>;  // edges of a cell, longest first
using Lengths = std::array<double, 6>;     // of the edges 01 02 03 12 13 23

constexpr double unit_length = 0x1p20;

/// Lengths within a tenth of the unit that stand in this order, so far apart that rounding the
/// corners to whole numbers leaves it. Those of the face 012 do not depend on the others.
Lengths lengths_in(const Order& order) {
    constexpr std::array<bool, 6> is_in_face{true, true, false, true, false, false};
    Lengths lengths{};
    double step = 16;  // the face's edges are at 12, 8 and 4, and up to three others between
    for (const std::size_t e : order) {
        step = is_in_face[e] ? std::ceil(step / 4) * 4 - 4 : step - 1;
        lengths[e] = unit_length * (1 + step / 160);
    }
    return lengths;
}

Point whole(const Point& p) { return {std::round(p.x), std::round(p.y), std::round(p.z)}; }

/// The corners 0, 1 and 2, in the plane z = 0.
std::array<Point, 3> face_with(const Lengths& l) {
    const double x = (l[0] * l[0] + l[1] * l[1] - l[3] * l[3]) / (2 * l[0]);
    return {Point{0, 0, 0}, Point{l[0], 0, 0}, Point{x, std::sqrt(l[1] * l[1] - x * x), 0}};
}

/// The fourth corner, on the side of positive z.
Point apex_over(const std::array<Point, 3>& face, const Lengths& l) {
    const double x = (l[2] * l[2] + l[0] * l[0] - l[4] * l[4]) / (2 * l[0]);
    const double along = face[2].x * face[2].x + face[2].y * face[2].y;
    const double y = (l[2] * l[2] - l[5] * l[5] + along - 2 * face[2].x * x) / (2 * face[2].y);
    return {x, y, std::sqrt(l[2] * l[2] - x * x - y * y)};
}

/// All orders of the six edges; those alone, if asked, in which the face's descend: 01, 02, 12.
std::vector<Order> orders(bool face_descends) {
    std::vector<Order> result;
    Order order{0, 1, 2, 3, 4, 5};
    do {
        const auto at = [&](std::size_t e) { return std::ranges::find(order, e); };
        if (!face_descends || (at(0) < at(1) && at(1) < at(3))) result.push_back(order);
    } while (std::ranges::next_permutation(order).found);
    return result;
}

}  // namespace

std::vector<Complex> all_small_complexes() {
    std::vector<Complex> complexes{{{0, 1, 2, 3}}};
    for (std::size_t shared = 0; shared <= 3; ++shared) complexes.push_back(two_cells(shared));
    for (std::size_t all = 0; all <= 2; ++all) {  // 3: all at one face
        for (std::size_t ab = 0; all + ab <= 3; ++ab) {
            for (std::size_t ac = 0; ac <= ab && all + ab + ac <= 4; ++ac) {
                for (std::size_t bc = 0; bc <= ac; ++bc) {
                    complexes.push_back(three_cells(all, ab, ac, bc));
                }
            }
        }
    }
    return complexes;
}

Mesh some_geometry(const Complex& complex, std::uint64_t seed) {
    Draw draw(seed);
    std::size_t vertices = 0;
    for (const auto& cell : complex) vertices = std::max(vertices, std::ranges::max(cell) + 1);
    while (true) {
        std::vector<Point> points;
        const auto coordinate = [&] { return static_cast<double>(draw.below(1U << 20U)); };
        for (std::size_t v = 0; v < vertices; ++v) {
            points.push_back({coordinate(), coordinate(), coordinate()});
        }
        Mesh mesh = test::mesh_of(points, complex);
        if (!test::has_ties(mesh) && verify::verify_mesh(mesh).valid()) return mesh;
    }
}

std::vector<Mesh> one_cell_in_every_order() {
    std::vector<Mesh> worlds;
    for (const Order& order : orders(false)) {
        const Lengths lengths = lengths_in(order);
        const auto face = face_with(lengths);
        worlds.push_back(test::one_cell(
            {whole(face[0]), whole(face[1]), whole(face[2]), whole(apex_over(face, lengths))}));
    }
    return worlds;
}

std::vector<Mesh> two_cells_in_every_order() {
    std::vector<Mesh> worlds;
    for (const Order& upper : orders(true)) {
        for (const Order& lower : orders(true)) {
            const auto face = face_with(lengths_in(upper));
            Point below = apex_over(face, lengths_in(lower));
            below.z = -below.z;
            worlds.push_back(
                test::mesh_of({whole(face[0]), whole(face[1]), whole(face[2]),
                               whole(apex_over(face, lengths_in(upper))), whole(below)},
                              {{0, 1, 2, 3}, {0, 1, 2, 4}}));
        }
    }
    return worlds;
}

Mesh side_by_side(const std::vector<Mesh>& worlds, double distance) {
    Mesh all;
    double x = 0;
    for (const Mesh& world : worlds) {
        const std::size_t first = all.points.size();
        for (const Point& p : world.points) all.points.append({p.x + x, p.y, p.z});
        for (CellVertices cell : world.cells) {
            for (VertexIndex& v : cell) v = VertexIndex{first + v.value()};
            all.cells.append(cell);
        }
        x += distance;
    }
    return all;
}

std::array<std::size_t, 6> order_of(const Mesh& mesh, CellIndex cell) {
    const Corners corners = test::corners_of(mesh, cell);
    const auto segment = [&](std::size_t e) {
        return Segment{corners[cell_edges[e][0]], corners[cell_edges[e][1]]};
    };
    std::array<std::size_t, 6> order{0, 1, 2, 3, 4, 5};
    std::ranges::sort(order,
                      [&](std::size_t e, std::size_t f) { return longer(segment(e), segment(f)); });
    return order;
}

}  // namespace octetra::properties
