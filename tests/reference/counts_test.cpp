#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/reference/refine.hpp>

#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// Counts of whole meshes, compared with closed forms, identities and published figures.
namespace octetra::reference {
namespace {

const Selection everything{.all = true};

TEST(Counts, OfUniformLevelsFollowTheClosedForms) {
    Mesh mesh = test::perturbed_kuhn(2, 0.2, 1);
    const auto number = [](std::size_t n) { return static_cast<double>(n); };
    const double T = number(mesh.cells.size());
    const double V = number(mesh.points.size());
    const double E = number(test::cells_at_edges(mesh).size());
    const auto coarse = test::count_faces(mesh);
    const double Fb = number(coarse.boundary_faces);
    const double d = E - 7 * T / 6 - 3 * Fb / 4;
    const double X = V - E + number(coarse.faces) - T;
    double two = 1;
    for (int k = 0; k <= 3; ++k, two *= 2) {
        const Mesh fine = refine(mesh, everything, Scheme::eight, k).mesh;
        const double four = two * two;
        const double eight = four * two;
        const auto census = test::count_faces(fine);
        EXPECT_EQ(census.faults, 0U);
        EXPECT_EQ(number(fine.cells.size()), eight * T);
        EXPECT_EQ(number(census.faces), 2 * T * eight + Fb / 2 * four);
        EXPECT_EQ(number(census.boundary_faces), Fb * four);
        EXPECT_EQ(number(test::cells_at_edges(fine).size()),
                  7 * T / 6 * eight + 3 * Fb / 4 * four + d * two);
        EXPECT_EQ(number(fine.points.size()), T / 6 * eight + Fb / 4 * four + d * two + X);
    }
}

TEST(Counts, OfAKuhnCubeAreThoseOfTheFinerKuhnCube) {
    for (const std::size_t n : {1U, 2U, 3U}) {
        const Mesh fine = refine(test::kuhn(n, n, n), everything, Scheme::eight, 1).mesh;
        const std::size_t m = 2 * n;
        const auto census = test::count_faces(fine);
        EXPECT_EQ(fine.points.size(), (m + 1) * (m + 1) * (m + 1));
        EXPECT_EQ(fine.cells.size(), 6 * m * m * m);
        EXPECT_EQ(census.faces, 12 * m * m * m + 6 * m * m);
        EXPECT_EQ(census.boundary_faces, 12 * m * m);
        EXPECT_EQ(test::cells_at_edges(fine).size(), 7 * m * m * m + 9 * m * m + 3 * m);
    }
}

TEST(Counts, OfThe5By7By9BoxAreThePublishedOnes) {
    const Mesh fine = refine(test::kuhn(5, 7, 9), everything, Scheme::eight, 1).mesh;
    EXPECT_EQ(fine.points.size(), 3135U);
    EXPECT_EQ(fine.cells.size(), 15120U);
}

TEST(Counts, OfASphereInTheKuhnCubeAreThoseThatOtherProgramsFind) {
    const Mesh cube = test::kuhn(8, 8, 8, 0.125);
    const Selection sphere{.spheres = {{{0.5, 0.5, 0.5}, 0.25}}};
    const std::array<std::size_t, 3> cells{6624, 25968, 143016};
    for (int levels = 1; levels <= 3; ++levels) {
        const Mesh fine = refine(cube, sphere, Scheme::eight, levels).mesh;
        EXPECT_EQ(fine.cells.size(), cells[static_cast<std::size_t>(levels - 1)]);
        EXPECT_EQ(test::count_faces(fine).faults, 0U);
        if (levels == 3) {
            EXPECT_EQ(fine.points.size(), 24497U);
        }
    }
}

TEST(Counts, OfOneLevelFollowFromTheSelectedEdges) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            const Mesh mesh = test::perturbed_kuhn(4, 0.3, seed);
            const Selection some{.random = RandomShare{0.05, seed}};
            const Refinement fine = refine(mesh, some, scheme, 1);
            const auto& bisected = fine.maps.midpoint_to_edge;
            const auto is_bisected = [&](VertexIndex a, VertexIndex b) {
                return std::ranges::binary_search(bisected,
                                                  EdgeVertices{std::min(a, b), std::max(a, b)});
            };
            auto cells_at = test::cells_at_edges(mesh);
            std::size_t expected = mesh.cells.size();
            for (const EdgeVertices& edge : bisected) expected += cells_at.at(edge);
            for (const CellVertices& cell : mesh.cells) {
                std::size_t longest = 0;
                const auto segment = [&](std::size_t e) {
                    return Segment{mesh.points[cell[cell_edges[e][0]]],
                                   mesh.points[cell[cell_edges[e][1]]]};
                };
                for (std::size_t e = 1; e < 6; ++e) {
                    if (longer(segment(e), segment(longest))) longest = e;
                }
                const auto& [i, j] = cell_edges[longest];
                const auto& [k, l] = cell_edges[5 - longest];
                if (is_bisected(cell[i], cell[j]) && is_bisected(cell[k], cell[l])) ++expected;
            }
            EXPECT_GT(bisected.size(), 0U);
            EXPECT_EQ(fine.mesh.cells.size(), expected);
            EXPECT_EQ(fine.mesh.points.size(), mesh.points.size() + bisected.size());
            const auto census = test::count_faces(fine.mesh);
            EXPECT_EQ(census.faults, 0U);
        }
    }
}

TEST(Counts, ApproachTheLimitsOfUniformRefinement) {
    const Mesh fine =
        refine(test::one_cell(test::tie_free_corners), everything, Scheme::eight, 6).mesh;
    const double cells = static_cast<double>(fine.cells.size());
    const double edges = static_cast<double>(test::cells_at_edges(fine).size());
    const double vertices = static_cast<double>(fine.points.size());
    EXPECT_EQ(fine.cells.size(), 262144U);
    EXPECT_NEAR(6 * cells / edges, 36.0 / 7, 0.3);
    EXPECT_NEAR(4 * cells / vertices, 24, 2.5);
    EXPECT_NEAR(2 * edges / vertices, 14, 1);
}

TEST(Numbering, ContinuesTheIndexBaseOfTheInput) {
    Mesh mesh = test::one_cell(test::tie_free_corners);
    mesh.index_base = 1;
    const Refinement fine = refine(mesh, everything, Scheme::eight, 2);
    EXPECT_EQ(fine.mesh.index_base, 1U);
}

TEST(Counts, StayAsTheyAreWhereNothingIsMarked) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.2, 1);
    EXPECT_EQ(refine(mesh, {}, Scheme::eight, 3).mesh, mesh);
    EXPECT_EQ(refine(mesh, everything, Scheme::eight, 0).mesh, mesh);
    EXPECT_EQ(refine(Mesh{}, everything, Scheme::eight, 2).mesh, Mesh{});
}

}  // namespace
}  // namespace octetra::reference
