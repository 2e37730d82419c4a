#include "properties/small_worlds.hpp"

#include <algorithm>

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
