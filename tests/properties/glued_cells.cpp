#include "properties/glued_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "properties/order_classes.hpp"
#include "support/meshes.hpp"

namespace octetra::properties {
namespace {

using Face = std::array<std::size_t, 3>;  // numbers of points

constexpr double unit_length = 0x1p20;

/// Cells being glued together. Points are not rounded as long as others are to be found from them.
struct World {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 4>> cells;
    /// How long an edge is, 3 to 33: the order is that of lengths. For either order of its ends.
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

/// Gives lengths to the edges of a cell that have none, each a step below the one before, from
/// `top` down. (These are not compared with any but the edges of their own cell.)
void order_edges(World& world, const std::array<std::size_t, 4>& cell, const Order& order,
                 int top) {
    int steps = top;
    for (const std::size_t e : order) {
        const std::size_t a = cell[cell_edges[e][0]];
        const std::size_t b = cell[cell_edges[e][1]];
        if (world.steps[a][b] == 0) set_steps(world, a, b, steps - 1);
        steps = world.steps[a][b];
    }
}

/// The first cell's edges are at 28, 24, ... 8: between them is room for three of another cell.
constexpr int top_of_first_cell = 32;

void order_edges_of_first_cell(World& world, const Order& order) {
    int steps = top_of_first_cell;
    for (const std::size_t e : order) {
        set_steps(world, cell_edges[e][0], cell_edges[e][1], steps -= 4);
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

/// The next point, at its distances from the points 0 and 1, in the plane z = 0; `side` is 1 or -1,
/// the sign of y.
void place_beside(World& world, double side) {
    const std::size_t next = world.points.size();
    const double l01 = length(world, 0, 1);
    const double l0 = length(world, 0, next);
    const double l1 = length(world, 1, next);
    const double x = (l01 * l01 + l0 * l0 - l1 * l1) / (2 * l01);
    world.points.push_back({x, side * std::sqrt(l0 * l0 - x * x), 0});
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
    order_edges_of_first_cell(world, order);
    world.cells.push_back({0, 1, 2, 3});
    world.points = {{0, 0, 0}, {length(world, 0, 1), 0, 0}};
    place_beside(world, 1);
    place_over(world, {0, 1, 2});
    return world;
}

/// Glues a cell to this face of the first cell, which goes round anticlockwise as seen from
/// outside. The order is one in which the edges of the face 012 descend.
void glue(World& world, const Face& face, const Order& order) {
    const auto [a, b, c] = with_descending_edges(world, face);
    const std::array<std::size_t, 4> cell{a, b, c, world.points.size()};
    order_edges(world, cell, order, top_of_first_cell);
    world.cells.push_back(cell);
    place_over(world, face);
}

/// Glues a cell to the edge 01 of the first cell, on the other side of it.
void glue_to_edge(World& world, const Order& order) {
    const auto place = static_cast<int>(std::ranges::find(order, 0U) - order.begin());
    order_edges(world, {0, 1, 4, 5}, order, world.steps[0][1] + place + 1);
    world.cells.push_back({0, 1, 4, 5});
    place_beside(world, -1);
    place_over(world, {0, 1, 4});
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

/// Those in which 02 is longer than 03: exchanging the corners 2 and 3 makes it the other way
/// round.
const std::vector<Order>& orders_at_an_edge() {
    static const auto result = orders([](const PlaceOfEdge& at) { return at[1] < at[2]; });
    return result;
}

/// Those in which 02 is the longest of the edges 02, 03, 12 and 13: exchanging the corners 0 and 1,
/// or 2 and 3, makes it any of the four.
const std::vector<Order>& orders_with_a_marked_edge() {
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

Mesh two_cells_at_an_edge_in_order(std::size_t number) {
    const auto& others = orders_at_an_edge();
    World world = first_cell(orders_with_a_marked_edge().at(number / others.size()));
    glue_to_edge(world, others[number % others.size()]);
    return mesh_of(std::move(world));
}

Mesh three_cells_in_order(std::size_t number) {
    const auto& sides = orders_at_a_face();
    const std::size_t pairs = sides.size() * sides.size();
    World world = first_cell(orders_with_a_marked_edge().at(number / pairs));
    glue(world, {0, 2, 1}, sides[number / sides.size() % sides.size()]);
    glue(world, {0, 1, 3}, sides[number % sides.size()]);
    return mesh_of(std::move(world));
}

}  // namespace octetra::properties
