#include "properties/glued_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/meshes.hpp"

namespace octetra::properties {
namespace {

using Order = std::array<std::size_t, 6>;  // edges of a cell as in cell_edges, longest first
using Face = std::array<std::size_t, 3>;   // numbers of points

constexpr double unit_length = 0x1p20;

/// Cells being glued together. Points are not rounded as long as others are to be found from them.
struct World {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 4>> cells;
    /// How long an edge is, 1 to 27: the order is that of lengths. For either order of its ends.
    std::array<std::array<int, 6>, 6> steps{};
};

// ---- lengths
// ---------------------------------------------------------------------------------------

void set_steps(World& world, std::size_t a, std::size_t b, int steps) {
    world.steps[a][b] = world.steps[b][a] = steps;
}

/// Within a tenth of the unit, and so far apart that rounding the ends to whole numbers leaves the
/// order.
double length(const World& world, std::size_t a, std::size_t b) {
    return unit_length * (1 + world.steps[a][b] / 280.0);
}

/// The first cell's edges are at 24, 20, ... 4; between them is room for three of a cell that is
/// glued to it, and these are not compared with any but the edges of their own cell.
void order_edges(World& world, const std::array<std::size_t, 4>& cell, const Order& order) {
    int steps = 28;
    for (const std::size_t e : order) {
        const std::size_t a = cell[cell_edges[e][0]];
        const std::size_t b = cell[cell_edges[e][1]];
        if (world.cells.empty()) set_steps(world, a, b, steps - 4);
        if (world.steps[a][b] == 0) set_steps(world, a, b, steps - 1);
        steps = world.steps[a][b];
    }
}

/// The corners named so that the edges descend: first to second, first to third, second to third.
Face with_descending_edges(const World& world, Face face) {
    const auto& [a, b, c] = face;
    std::ranges::sort(face);
    while (world.steps[a][b] < world.steps[a][c] || world.steps[a][c] < world.steps[b][c]) {
        std::ranges::next_permutation(face);
    }
    return face;
}

// ---- places
// ----------------------------------------------------------------------------------------

Point plus(const Point& p, double t, const Point& v) {
    return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}
Point minus(const Point& p, const Point& q) { return plus(p, -1, q); }
double dot(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
Point cross(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
Point unit(const Point& v) { return plus({}, 1 / std::sqrt(dot(v, v)), v); }

/// The corners 0, 1 and 2 of the first cell, in the plane z = 0.
void place_base(World& world) {
    const double l01 = length(world, 0, 1);
    const double l02 = length(world, 0, 2);
    const double l12 = length(world, 1, 2);
    const double x = (l01 * l01 + l02 * l02 - l12 * l12) / (2 * l01);
    world.points = {{0, 0, 0}, {l01, 0, 0}, {x, std::sqrt(l02 * l02 - x * x), 0}};
}

/// The next point, at its distances from the corners of a face; on the side that the corners go
/// round anticlockwise, seen from there.
void place_over(World& world, const Face& face) {
    const Point& origin = world.points[face[0]];
    const Point to_second = minus(world.points[face[1]], origin);
    const Point to_third = minus(world.points[face[2]], origin);
    const Point normal = unit(cross(to_second, to_third));
    const Point along = unit(to_second);
    const Point across = cross(normal, along);

    const std::size_t next = world.points.size();
    const auto squared = [&](std::size_t corner) {
        const double l = length(world, face[corner], next);
        return l * l;
    };
    const double x = (squared(0) - squared(1) + dot(to_second, to_second)) /  //
                     (2 * dot(to_second, along));
    const double y = (squared(0) - squared(2) + dot(to_third, to_third) -  //
                      2 * x * dot(to_third, along)) /
                     (2 * dot(to_third, across));
    const double z = std::sqrt(squared(0) - x * x - y * y);
    world.points.push_back(plus(plus(plus(origin, x, along), y, across), z, normal));
}

// ---- gluing
// ----------------------------------------------------------------------------------------

World first_cell(const Order& order) {
    World world;
    order_edges(world, {0, 1, 2, 3}, order);
    world.cells.push_back({0, 1, 2, 3});
    place_base(world);
    place_over(world, {0, 1, 2});
    return world;
}

/// Glues a cell to this face of the first cell, which goes round anticlockwise as seen from
/// outside. The order is one in which the edges of the face 012 descend.
void glue(World& world, const Face& face, const Order& order) {
    const auto [a, b, c] = with_descending_edges(world, face);
    const std::array<std::size_t, 4> cell{a, b, c, world.points.size()};
    order_edges(world, cell, order);
    world.cells.push_back(cell);
    place_over(world, face);
}

Mesh mesh_of(World world) {
    for (Point& p : world.points) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    return test::mesh_of(world.points, world.cells);
}

/// All orders that this is true of.
template <class Predicate>
std::vector<Order> orders(Predicate&& is_wanted) {
    std::vector<Order> result;
    Order order{0, 1, 2, 3, 4, 5};
    do {
        std::array<std::size_t, 6> place{};
        for (std::size_t i = 0; i < 6; ++i) place[order[i]] = i;
        if (is_wanted(place)) result.push_back(order);
    } while (std::ranges::next_permutation(order).found);
    return result;
}

/// Edges are 01 02 03 12 13 23.
using PlaceOfEdge = std::array<std::size_t, 6>;

const std::vector<Order>& orders_of_one() {
    static const auto result = orders([](const PlaceOfEdge&) { return true; });
    return result;
}

/// Those in which the edges of the face 012 descend.
const std::vector<Order>& orders_at_a_face() {
    static const auto result =
        orders([](const PlaceOfEdge& at) { return at[0] < at[1] && at[1] < at[3]; });
    return result;
}

/// Those in which 02 is the longest of the edges 02, 03, 12 and 13: exchanging the ends of 01, or
/// the faces there, makes it any of the four.
const std::vector<Order>& orders_between_two_faces() {
    static const auto result = orders(
        [](const PlaceOfEdge& at) { return at[1] < at[2] && at[1] < at[3] && at[1] < at[4]; });
    return result;
}

}  // namespace

Mesh one_cell_in_order(std::size_t number) {
    return mesh_of(first_cell(orders_of_one().at(number)));
}

Mesh two_cells_in_order(std::size_t number) {
    const auto& orders = orders_at_a_face();
    World world = first_cell(orders.at(number / orders.size()));
    glue(world, {0, 2, 1}, orders[number % orders.size()]);
    return mesh_of(std::move(world));
}

Mesh three_cells_in_order(std::size_t number) {
    const auto& sides = orders_at_a_face();
    const std::size_t pairs = sides.size() * sides.size();
    World world = first_cell(orders_between_two_faces().at(number / pairs));
    glue(world, {0, 2, 1}, sides[number / sides.size() % sides.size()]);
    glue(world, {0, 1, 3}, sides[number % sides.size()]);
    return mesh_of(std::move(world));
}

}  // namespace octetra::properties
