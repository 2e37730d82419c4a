#include "properties/gluing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/meshes.hpp"

namespace octetra::properties {
namespace {

using Cell = std::array<std::size_t, 4>;  // numbers of points
using Face = std::array<std::size_t, 3>;

constexpr double unit_length = 0x1p20;

/// Cells being glued together. A point is rounded only when no other is to be computed from it.
struct World {
    std::vector<Point> points;
    std::vector<Cell> cells;
    /// The length class of each edge, 3 to 33, for either order of its ends: lengths increase with
    /// it.
    std::array<std::array<int, 12>, 12> steps{};
};

// ---- lengths ------------------------------------------------------------------------------------

void set_steps(World& world, std::size_t a, std::size_t b, int steps) {
    world.steps[a][b] = world.steps[b][a] = steps;
}

/// Lengths differ from the unit by at most an eighth, and from one another by more than rounding
/// the ends to whole numbers changes.
double length(const World& world, std::size_t a, std::size_t b) {
    return unit_length * (1 + world.steps[a][b] / 280.0);
}

constexpr int top = 32;

/// Assigns 28, 24, ... 8, which leaves room for three edges of another cell between them.
void order_edges_of_first_cell(World& world, const Order& order) {
    int steps = top;
    for (const std::size_t e : order) {
        set_steps(world, cell_edges[e][0], cell_edges[e][1], steps -= 4);
    }
}

/// Assigns lengths to the edges of a cell that have none, each a step below the previous one, from
/// `highest` down. (These are compared only with the edges of their own cell.)
void order_edges(World& world, const Cell& cell, const Order& order, int highest) {
    int steps = highest;
    for (const std::size_t e : order) {
        const std::size_t a = cell[cell_edges[e][0]];
        const std::size_t b = cell[cell_edges[e][1]];
        if (world.steps[a][b] == 0) set_steps(world, a, b, steps - 1);
        steps = world.steps[a][b];
    }
}

/// The same for a cell at the edge 01, whose longer edges are placed above this edge.
void order_edges_at_edge(World& world, const Cell& cell, const Order& order) {
    const auto place = static_cast<int>(std::ranges::find(order, 0U) - order.begin());
    order_edges(world, cell, order, world.steps[0][1] + place + 1);
}

/// Names the corners so that the edges first-second, first-third, second-third descend.
Face with_descending_edges(const World& world, Face face) {
    const auto& [a, b, c] = face;
    std::ranges::sort(face);
    while (world.steps[a][b] < world.steps[a][c] || world.steps[a][c] < world.steps[b][c]) {
        std::ranges::next_permutation(face);
    }
    return face;
}

// ---- places -------------------------------------------------------------------------------------

Point plus(const Point& p, double t, const Point& v) {
    return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}
Point minus(const Point& p, const Point& q) { return plus(p, -1, q); }
double dot(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
Point cross(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
Point unit(const Point& v) { return plus({}, 1 / std::sqrt(dot(v, v)), v); }

/// The point with this number, from its distances to the vertices a, at the origin, and b, on the x
/// axis; it lies in the half plane at this angle to the one with z = 0 and y > 0.
Point point_about_axis(const World& world, std::size_t a, std::size_t b, std::size_t number,
                       double angle) {
    const double ab = length(world, a, b);
    const double from_a = length(world, a, number);
    const double from_b = length(world, b, number);
    const double x = (ab * ab + from_a * from_a - from_b * from_b) / (2 * ab);
    const double from_axis = std::sqrt(from_a * from_a - x * x);
    return {x, from_axis * std::cos(angle), from_axis * std::sin(angle)};
}

/// The point with this number, from its distances to the given corners of a face, on the side from
/// which they appear anticlockwise.
Point point_above_face(const World& world, const Face& face, const std::array<Point, 3>& corners,
                       std::size_t number) {
    const Point& origin = corners[0];
    const Point to_second = minus(corners[1], origin);
    const Point to_third = minus(corners[2], origin);
    const Point normal = unit(cross(to_second, to_third));
    const Point along = unit(to_second);
    const Point across = cross(normal, along);

    const auto squared = [&](std::size_t corner) {
        const double l = length(world, face[corner], number);
        return l * l;
    };
    const double x = (squared(0) - squared(1) + dot(to_second, to_second)) /  //
                     (2 * dot(to_second, along));
    const double y = (squared(0) - squared(2) + dot(to_third, to_third) -  //
                      2 * x * dot(to_third, along)) /
                     (2 * dot(to_third, across));
    const double z = std::sqrt(squared(0) - x * x - y * y);
    return plus(plus(plus(origin, x, along), y, across), z, normal);
}

Point point_above_face(const World& world, const Face& face, std::size_t number) {
    const auto& points = world.points;
    return point_above_face(world, face, {points[face[0]], points[face[1]], points[face[2]]},
                            number);
}

/// Places the first corner at the origin, the second on the x axis, and the third at z = 0. No
/// point has z < 0; only the first has x <= 0.
std::array<Point, 4> placed_alone(const World& world, const Cell& cell) {
    const auto& [a, b, c, d] = cell;
    const Point second{length(world, a, b), 0, 0};
    const Point third = point_about_axis(world, a, b, c, 0);
    return {Point{}, second, third,
            point_above_face(world, {a, b, c}, {Point{}, second, third}, d)};
}

// ---- gluing -------------------------------------------------------------------------------------

void add_first(World& world, const Cell& cell, const Order& order) {
    order_edges_of_first_cell(world, order);
    for (const Point& p : placed_alone(world, cell)) world.points.push_back(p);
}

/// Placed above the other cells, or below them.
void add_apart(World& world, const Cell& cell, const Order& order) {
    order_edges(world, cell, order, top);
    const double height = (world.cells.size() == 1 ? 2.5 : -2.5) * unit_length;
    for (const Point& p : placed_alone(world, cell)) {
        world.points.push_back(plus(p, height, {0, 0, 1}));
    }
}

/// The second cell has x < 0 where the first has x > 0; the third has z < 0.
void add_at_vertex(World& world, const Cell& cell, const Order& order) {
    order_edges(world, cell, order, top);
    const bool is_second = world.cells.size() == 1;
    const std::array<Point, 4> corners = placed_alone(world, cell);
    for (std::size_t i = 1; i < 4; ++i) {
        const auto& [x, y, z] = corners[i];
        world.points.push_back(is_second ? Point{-x, -y, z} : Point{y, -z, -x});
    }
}

/// Rotated by a third of a turn from the previous cell. (The angle between two faces at an edge is
/// about 70 degrees.)
void add_at_edge(World& world, const Cell& cell, const Order& order) {
    order_edges_at_edge(world, cell, order);
    const double angle = static_cast<double>(world.cells.size()) * 2 * std::numbers::pi / 3;
    world.points.push_back(point_about_axis(world, 0, 1, cell[2], angle));
    world.points.push_back(point_above_face(world, {0, 1, cell[2]}, cell[3]));
}

void add_at_face(World& world, Cell& cell, const Order& order) {
    const Face face{cell[0], cell[1], cell[2]};
    std::ranges::copy(with_descending_edges(world, face), cell.begin());
    order_edges(world, cell, order, top);
    world.points.push_back(point_above_face(world, face, cell[3]));
}

void add(World& world, Cell cell, const Order& order) {
    const auto shared =
        std::ranges::count_if(cell, [&](std::size_t v) { return v < world.points.size(); });
    if (world.cells.empty()) {
        add_first(world, cell, order);
    } else if (shared == 0) {
        add_apart(world, cell, order);
    } else if (shared == 1) {
        add_at_vertex(world, cell, order);
    } else if (shared == 2) {
        add_at_edge(world, cell, order);
    } else {
        add_at_face(world, cell, order);
    }
    world.cells.push_back(cell);
}

}  // namespace

Mesh glued(const Complex& complex, const std::vector<Order>& orders) {
    World world;
    for (std::size_t c = 0; c < complex.size(); ++c) add(world, complex[c], orders[c]);
    for (Point& p : world.points) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    return test::mesh_of(world.points, world.cells);
}

}  // namespace octetra::properties
