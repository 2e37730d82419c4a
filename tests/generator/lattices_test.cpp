#include <limits>

#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/generator/lattices.hpp>

#include "mesh_facts.hpp"

namespace octetra::generator::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Checks that every facet with marker m lies in side m of the box.
void expect_facets_in_their_sides(const Mesh& mesh, const Point& high) {
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        for (const Point& p : corners_of(mesh, f)) {
            const std::array<double, 6> distance{p.x,          p.x - high.x, p.y,
                                                 p.y - high.y, p.z,          p.z - high.z};
            EXPECT_EQ(distance.at(static_cast<std::size_t>(mesh.facet_markers[f] - 1)), 0);
        }
    }
}

void expect_boundary_tagged_once(const Mesh& mesh) {
    EXPECT_EQ(tagged_facets(mesh), boundary_of(mesh));
    EXPECT_EQ(mesh.facets.size(), boundary_of(mesh).size());
    EXPECT_EQ(mesh.facet_markers.size(), mesh.facets.size());
    EXPECT_TRUE(facets_face_outwards(mesh));
}

TEST(Kuhn, CubeHasTheCountsOfTheClosedForms) {
    for (const std::size_t n : {1U, 2U, 3U, 4U}) {
        const Counts expected{.vertices = (n + 1) * (n + 1) * (n + 1),
                              .edges = 7 * n * n * n + 9 * n * n + 3 * n,
                              .faces = 12 * n * n * n + 6 * n * n,
                              .cells = 6 * n * n * n,
                              .boundary_faces = 12 * n * n};
        EXPECT_EQ(counts_of(kuhn(n, n, n)), expected) << n;
    }
}

TEST(Kuhn, BoxOf5By7By9HasThePublishedCountsBeforeItsUniformLevel) {
    const Mesh mesh = kuhn(5, 7, 9);
    EXPECT_EQ(mesh.points.size(), 480U);
    EXPECT_EQ(mesh.cells.size(), 15120U / 8);
    EXPECT_EQ(mesh.points.size() + edges_of(mesh).size(), 3135U);
}

TEST(Kuhn, CellsAreOrientedAndFillTheBoxExactly) {
    const Mesh mesh = kuhn(5, 7, 9, {5, 7, 9});
    EXPECT_TRUE(all_positively_oriented(mesh));
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        ASSERT_EQ(six_volumes(corners_of(mesh, c)), 1);
    }
    EXPECT_EQ(six_volumes(kuhn(4, 2, 8, {1, 2, 0.5})), 6);
    EXPECT_TRUE(all_positively_oriented(kuhn(3, 7, 11, {1e-30, 0.1, 1e30})));
}

TEST(Kuhn, VerticesAreNumberedXFastestAndComputedByOneProductAndOneQuotient) {
    const Mesh mesh = kuhn(3, 2, 4, {0.1, 0.7, 10});
    for (std::size_t k = 0; k <= 4; ++k) {
        for (std::size_t j = 0; j <= 2; ++j) {
            for (std::size_t i = 0; i <= 3; ++i) {
                const Point expected{(static_cast<double>(i) * 0.1) / 3,
                                     (static_cast<double>(j) * 0.7) / 2,
                                     (static_cast<double>(k) * 10) / 4};
                EXPECT_EQ((mesh.points[VertexIndex{(k * 3 + j) * 4 + i}]), expected);
            }
        }
    }
    EXPECT_EQ(mesh.index_base, 0U);
}

TEST(Kuhn, EveryBrickHasItsSixCellsRoundTheLowToHighDiagonal) {
    const Mesh mesh = kuhn(2, 3, 1);
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t s = 0; s < 6; ++s) {
                const CellVertices& cell = mesh.cells[CellIndex{6 * (j * 2 + i) + s}];
                EXPECT_EQ(cell[0], VertexIndex{j * 3 + i});
                EXPECT_EQ(cell[3], VertexIndex{(1 * 4 + j + 1) * 3 + i + 1});
            }
        }
    }
}

TEST(Kuhn, BoundaryIsTaggedOnceWithTheMarkersOfItsSides) {
    // (n * 0.1) / n is not 0.1 for every n; the sides must be found nevertheless.
    const Mesh mesh = kuhn(3, 6, 7, {0.1, 0.1, 0.1});
    expect_boundary_tagged_once(mesh);
    expect_facets_in_their_sides(mesh, mesh.points.back());
    const std::map<Marker, std::size_t> expected{{1, 84}, {2, 84}, {3, 42},
                                                 {4, 42}, {5, 36}, {6, 36}};
    EXPECT_EQ(facets_by_marker(mesh), expected);
}

TEST(Kuhn, RefusesWhatItCannotMake) {
    EXPECT_THROW((void)kuhn(0, 1, 1), InputError);
    EXPECT_THROW((void)kuhn(1, 0, 1), InputError);
    EXPECT_THROW((void)kuhn(1, 1, 0), InputError);
    for (const double bad : {0.0, -1.0, infinity, not_a_number, 1e31, 1e-31}) {
        EXPECT_THROW((void)kuhn(1, 1, 1, {bad, 1, 1}), InputError) << bad;
        EXPECT_THROW((void)kuhn(1, 1, 1, {1, bad, 1}), InputError) << bad;
        EXPECT_THROW((void)kuhn(1, 1, 1, {1, 1, bad}), InputError) << bad;
    }
}

TEST(Kuhn, RefusesCountsThat32BitsCannotNumber) {
    EXPECT_THROW((void)kuhn(1000, 1000, 1000), InputError);
    EXPECT_THROW((void)kuhn(1, 1, std::uint64_t{1} << 30U), InputError);
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    EXPECT_THROW((void)kuhn(most, most, most), InputError);
    EXPECT_THROW((void)kuhn(std::uint64_t{1} << 32U, std::uint64_t{1} << 32U, 1), InputError);
}

TEST(Bcc, HasTheCountsOfTheClosedForms) {
    for (const std::size_t n : {1U, 2U, 3U}) {
        const Counts expected{.vertices = (n + 1) * (n + 1) * (n + 1) + n * n * n + 6 * n * n,
                              .edges = 14 * n * n * n + 33 * n * n + 3 * n,
                              .faces = 24 * n * n * n + 36 * n * n,
                              .cells = 12 * n * n * n + 12 * n * n,
                              .boundary_faces = 24 * n * n};
        EXPECT_EQ(counts_of(bcc(n)), expected) << n;
        EXPECT_EQ(euler_characteristic(bcc(n)), 1);
    }
}

TEST(Bcc, CellsAreOrientedAndFillTheCubeExactly) {
    EXPECT_EQ(six_volumes(bcc(3, 6)), 6 * 216);
    EXPECT_TRUE(all_positively_oriented(bcc(3, 6)));
    EXPECT_TRUE(all_positively_oriented(bcc(5, 0.1)));
}

TEST(Bcc, InnerCellsHaveSommervillesShapeAndBoundaryCellsAreTheirHalves) {
    const std::size_t n = 3;
    const Mesh mesh = bcc(n, 2 * static_cast<double>(n));
    std::size_t whole = 0;
    std::size_t half = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto corners = corners_of(mesh, c);
        std::multiset<double> lengths;
        for (const auto& [i, j] : cell_edges) {
            lengths.insert(squared_length({corners.at(i), corners.at(j)}));
        }
        whole += lengths == std::multiset<double>{3, 3, 3, 3, 4, 4} ? 1U : 0U;
        half += lengths == std::multiset<double>{1, 2, 2, 3, 3, 4} ? 1U : 0U;
    }
    EXPECT_EQ(whole, 12 * n * n * (n - 1));
    EXPECT_EQ(half, 24 * n * n);
}

TEST(Bcc, BoundaryIsTaggedOnceWithTheMarkersOfItsSides) {
    const Mesh mesh = bcc(3, 0.1);
    expect_boundary_tagged_once(mesh);
    const double high = mesh.points[VertexIndex{4 * 4 * 4 - 1}].x;
    expect_facets_in_their_sides(mesh, {high, high, high});
    for (const auto& [marker, count] : facets_by_marker(mesh)) EXPECT_EQ(count, 36U) << marker;
}

TEST(Bcc, RefusesWhatItCannotMake) {
    EXPECT_THROW((void)bcc(0), InputError);
    EXPECT_THROW((void)bcc(1000), InputError);
    EXPECT_THROW((void)bcc(std::numeric_limits<std::uint64_t>::max()), InputError);
    for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
        EXPECT_THROW((void)bcc(1, bad), InputError) << bad;
    }
}

TEST(Regular, HasSixEqualEdgesAndFourMarkedFacets) {
    const Mesh mesh = regular(0.5);
    ASSERT_EQ(mesh.cells.size(), 1U);
    EXPECT_TRUE(all_positively_oriented(mesh));
    const auto corners = corners_of(mesh, CellIndex{0});
    for (const auto& [i, j] : cell_edges) {
        EXPECT_EQ(squared_length({corners.at(i), corners.at(j)}), 2);
    }
    expect_boundary_tagged_once(mesh);
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        EXPECT_EQ(std::ranges::count(mesh.facets[f], VertexIndex{f.value()}), 0);
        EXPECT_EQ(mesh.facet_markers[f], static_cast<Marker>(f.value()) + 1);
    }
    EXPECT_THROW((void)regular(-1), InputError);
    EXPECT_THROW((void)regular(not_a_number), InputError);
}

TEST(Lattices, RefusalsStateWhatIsAllowed) {
    try {
        (void)kuhn(0, 1, 1);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "the number of bricks along x should be from 1 to 4294967293, not 0");
    }
}

}  // namespace
}  // namespace octetra::generator::test
