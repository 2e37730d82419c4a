#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>

#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// Numbers are names only: renumbering the input renumbers the result and changes nothing else.
namespace octetra::reference {
namespace {

template <class Vector>
void permute(Vector& values, const std::vector<std::size_t>& new_to_old) {
    Vector permuted;
    for (const std::size_t old : new_to_old) {
        permuted.push_back(
            static_cast<const std::vector<typename Vector::value_type>&>(values)[old]);
    }
    if (!values.empty()) values = permuted;
}

std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& random) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    return order;
}

Mesh renumbered(Mesh mesh, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto vertex_order = shuffled(mesh.points.size(), random);
    IndexVector<VertexIndex, VertexIndex> new_number(vertex_order.size());
    for (std::size_t i = 0; i < vertex_order.size(); ++i) {
        new_number[VertexIndex{vertex_order[i]}] = VertexIndex{i};
    }
    permute(mesh.points, vertex_order);
    permute(mesh.point_markers, vertex_order);
    const auto rename = [&](auto& list) {
        for (auto& vertices : list) {
            for (VertexIndex& v : vertices) v = new_number[v];
        }
    };
    rename(mesh.cells);
    rename(mesh.facets);
    rename(mesh.edges);

    const auto cell_order = shuffled(mesh.cells.size(), random);
    permute(mesh.cells, cell_order);
    permute(mesh.regions, cell_order);
    for (CellVertices& cell : mesh.cells) {  // an even permutation of the corners
        std::rotate(cell.begin() + 1, cell.begin() + 1 + static_cast<int>(random() % 3),
                    cell.end());
        if (random() % 2 == 0) {
            std::swap(cell[0], cell[1]);
            std::swap(cell[2], cell[3]);
        }
    }
    const auto facet_order = shuffled(mesh.facets.size(), random);
    permute(mesh.facets, facet_order);
    permute(mesh.facet_markers, facet_order);
    for (FacetVertices& facet : mesh.facets) std::ranges::shuffle(facet, random);
    for (EdgeVertices& edge : mesh.edges) std::ranges::shuffle(edge, random);
    return mesh;
}

Mesh marked(Mesh mesh) {
    test::list_boundary(mesh);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() % 4));
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); c = CellIndex{c.value() + 7U}) {
        mesh.edges.append({mesh.cells[c][0], mesh.cells[c][2]});
        mesh.edge_markers.append(static_cast<Marker>(c.value()));
    }
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        mesh.point_markers.append(static_cast<Marker>(v.value() % 3));
    }
    return mesh;
}

std::vector<std::pair<Point, Marker>> marked_points(const Mesh& mesh) {
    std::vector<std::pair<Point, Marker>> points;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        points.emplace_back(mesh.points[v], mesh.point_markers[v]);
    }
    std::ranges::sort(points, std::less<>{});
    return points;
}

void expect_same_geometry(const Mesh& a, const Mesh& b) {
    EXPECT_TRUE(test::geometry(a) == test::geometry(b));
    EXPECT_TRUE(test::geometry(a, a.facets, a.facet_markers) ==
                test::geometry(b, b.facets, b.facet_markers));
    EXPECT_TRUE(test::geometry(a, a.edges, a.edge_markers) ==
                test::geometry(b, b.edges, b.edge_markers));
    EXPECT_TRUE(marked_points(a) == marked_points(b));
}

class Invariance : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Invariance, UnderRenumberingOfVerticesCellsAndCorners) {
    const std::uint64_t seed = GetParam();
    const std::vector<Selection> selections{
        {.all = true},
        {.spheres = {{{1, 1.5, 1}, 0.9}}},
        {.boxes = {{{0.5, 0, 0}, {1.5, 1, 3}}}},
        {.regions = {2}},
        {.random = RandomShare{0.1, seed}},
        {.max_volume = 0.17},
    };
    for (const Mesh& mesh :
         {marked(test::kuhn(3, 3, 3)), marked(test::shaken_kuhn(3, 0.3, seed))}) {
        for (const Selection& selection : selections) {
            for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
                expect_same_geometry(refine(mesh, selection, scheme, 2).mesh,
                                     refine(renumbered(mesh, seed), selection, scheme, 2).mesh);
            }
        }
    }
}

TEST_P(Invariance, UnderScalingByAPowerOfTwoAndExactTranslation) {
    const Mesh mesh = marked(test::shaken_kuhn(3, 0.3, GetParam()));
    const auto transformed = [](Mesh m, double scale, const Point& shift) {
        for (Point& p : m.points) {
            p = {p.x * scale + shift.x, p.y * scale + shift.y, p.z * scale + shift.z};
        }
        return m;
    };
    const Point shift{1024, -2048, 512};
    const Selection some{.regions = {1}};
    const Mesh before = refine(mesh, some, Scheme::eight, 2).mesh;
    const Mesh after = refine(transformed(mesh, 0.25, shift), some, Scheme::eight, 2).mesh;
    EXPECT_EQ(after, transformed(before, 0.25, shift));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Invariance, testing::Range<std::uint64_t>(1, 5));

}  // namespace
}  // namespace octetra::reference
