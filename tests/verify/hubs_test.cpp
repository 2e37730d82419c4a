#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "exact/predicates.hpp"
#include "hubs/axial_view.hpp"
#include "mesh/checks.hpp"
#include "support/meshes.hpp"
#include "verify/hub_meshes.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// Many cells around one edge or at one vertex, whose boxes all intersect pairwise.
namespace octetra::verify {
namespace {

using test::codes_of;
using test::Hub;

class HubTest : public testing::TestWithParam<Hub> {};

double n_log_n(const Mesh& mesh) {
    const auto n = static_cast<double>(mesh.cells.size());
    return n * std::log2(n);
}

/// The total work of the verifier for a valid mesh.
double effort_of_validity(const Mesh& mesh) {
    const Verdict verdict = verify_mesh(mesh);
    EXPECT_EQ(codes_of(verdict), "");
    return static_cast<double>(verdict.search_tests + verdict.arithmetic.filtered +
                               verdict.arithmetic.exact);
}

/// Eight times as many cells take slightly more than eight times the work, and not 64 times.
void expect_n_log_n(const Mesh& small, const Mesh& large, double most) {
    const double effort = effort_of_validity(large);
    EXPECT_LT(effort / effort_of_validity(small), 1.5 * n_log_n(large) / n_log_n(small));
    EXPECT_LT(effort, most * n_log_n(large));
}

TEST_P(HubTest, IsSearchedInProportionToItsCellsAndTheirLogarithm) {
    expect_n_log_n(GetParam().make(2000), GetParam().make(16000), 100);
}

/// For slender cells of all lengths and directions the work grows faster: eight times as many cells
/// take less than 8^1.5 = 22.6 times the work.
void expect_far_less_than_the_square(const Mesh& small, const Mesh& large) {
    const double effort = effort_of_validity(large);
    EXPECT_LT(effort / effort_of_validity(small), 22.6);
    EXPECT_LT(effort, 200 * n_log_n(large));
}

/// After refinement most cells are not at the hub, and many are slender as seen from it.
TEST_P(HubTest, RefinedIsSearchedInFarLessThanTheSquareOfItsCells) {
    const auto refined = [&](std::size_t cells) {
        return reference::refine(GetParam().make(cells), {.all = true}, Scheme::eight, 1).mesh;
    };
    expect_far_less_than_the_square(refined(1000), refined(8000));
}

/// The other corners have all angles about the axis, and all directions at each angle: directions
/// alone would leave about the square root of all edges for each face.
TEST(RoughHub, IsSearchedInProportionToItsCellsAndTheirLogarithm) {
    using test::rough_cells_around_edge;
    expect_n_log_n(rough_cells_around_edge(2000), rough_cells_around_edge(16000), 100);
}

/// After refinement the axis has inner vertices, from which the more distant ones are seen along
/// the axis.
TEST(RoughHub, RefinedAtRandomIsSearchedInProportionToItsCellsAndTheirLogarithm) {
    const auto refined = [](std::size_t cells) {
        return reference::refine(test::rough_cells_around_edge(cells),
                                 {.random = RandomShare{.fraction = 0.1}}, Scheme::eight, 2)
            .mesh;
    };
    expect_n_log_n(refined(500), refined(4000), 100);
}

TEST_P(HubTest, AndItsRefinementAreValidByAnyNumberOfProcesses) {
    const Mesh coarse = GetParam().make(OCTETRA_SANITIZED ? 160 : 400);
    EXPECT_EQ(codes_of(test::verified_by_all(coarse)), "");
    const Mesh fine = reference::refine(coarse, {.all = true}, Scheme::eight, 1).mesh;
    EXPECT_EQ(codes_of(test::verified_by_all(coarse, fine)), "");
    EXPECT_EQ(codes_of(test::verified_by_all(fine)), "");
}

/// A face of a cell without volume may be a line, which CGAL's predicates reject by assertion.
void drop_flat_cells(Mesh& mesh) {
    std::vector<CellVertices> kept;
    Arithmetic arithmetic;
    for (const auto& [a, b, c, d] : mesh.cells) {
        const auto& p = mesh.points;
        if (exact::orientation(p[a], p[b], p[c], p[d], arithmetic) != 0) {
            kept.push_back({a, b, c, d});
        }
    }
    mesh.cells = {};
    for (const CellVertices& cell : kept) mesh.cells.push_back(cell);
}

/// The geometric violations found if vertices with this many edges are treated as hubs. The mesh
/// may be invalid: hanging vertices and intersections are defined all the same.
std::vector<Violation> found_in_space(const Mesh& mesh, std::uint32_t many) {
    Findings findings(std::numeric_limits<std::size_t>::max());
    JudgedMesh judged = judged_whole(mesh, Which::fine);
    judged.many = many;
    (void)check_well_formed(judged, findings);
    (void)check_orientation(judged, findings);
    (void)check_hanging(judged, findings);
    (void)check_boundary_crossings(judged, findings);
    return findings.finish().violations;
}

void expect_same_with_hubs(const Mesh& mesh, std::string_view what) {
    const auto without = found_in_space(mesh, std::numeric_limits<std::uint32_t>::max());
    for (const std::uint32_t many : {0U, 4U, 7U}) {
        const auto with = found_in_space(mesh, many);
        ASSERT_EQ(with.size(), without.size()) << what << ", hubs of more than " << many;
        for (std::size_t i = 0; i < with.size(); ++i) {
            EXPECT_EQ(with[i].code, without[i].code) << what;
            EXPECT_EQ(with[i].entities, without[i].entities) << what;
            EXPECT_EQ(with[i].found, without[i].found) << what;
        }
    }
}

/// Moves a vertex: slightly, far, to another vertex, to the middle of two or three others, or along
/// a line through two.
void move_at_random(Mesh& mesh, std::mt19937_64& random) {
    const auto any = [&] { return VertexIndex{random() % mesh.points.size()}; };
    const auto number = [&](double size) {
        return (static_cast<double>(random() % 4097) - 2048) / 2048 * size;
    };
    Point& p = mesh.points[any()];
    const Point q = mesh.points[any()];
    const Point r = mesh.points[any()];
    const Point s = mesh.points[any()];
    switch (random() % 6) {
        case 0: p = {p.x + number(0.25), p.y + number(0.25), p.z + number(0.25)}; break;
        case 1: p = {number(2), number(2), number(2)}; break;
        case 2: p = q; break;
        case 3: p = midpoint(q, r); break;
        case 4: p = midpoint(midpoint(q, r), s); break;
        default: p = {2 * q.x - r.x, 2 * q.y - r.y, 2 * q.z - r.z}; break;
    }
}

TEST(Hubs, DoNotAffectTheFindings) {
    std::mt19937_64 random(815);
    int broken = 0;
    for (std::size_t round = 0; round < (OCTETRA_SANITIZED ? 200U : 2000U); ++round) {
        const Hub& hub = test::hubs[round % test::hubs.size()];
        Mesh mesh = round % 3 == 0 ? test::kuhn(2, 1, 1) : hub.make(8 + random() % 24);
        if (round % 4 == 1) {  // so that the edge of a hub has inner vertices
            mesh =
                reference::refine(mesh, {.random = RandomShare{0.1, round}}, Scheme::two, 1).mesh;
        }
        for (std::size_t moves = random() % 4; moves > 0; --moves) move_at_random(mesh, random);
        drop_flat_cells(mesh);
        ASSERT_NO_FATAL_FAILURE(expect_same_with_hubs(mesh, fmt::format("round {}", round)));
        if (!verify_mesh(mesh).valid()) ++broken;
    }
    EXPECT_GT(broken, OCTETRA_SANITIZED ? 100 : 1000);
}

Direction direction_of(Vector v) {
    const double length = std::sqrt(dot(v, v));
    return {times(v, 1 / length), few_roundings};
}

/// Rays in all directions, some of them, and some of the common directions, nearly parallel or
/// antiparallel to the axis.
TEST(AxialView, MeetsWhateverHasADirectionInCommon) {
    std::mt19937_64 random(2718);
    std::uniform_real_distribution<double> number(-1, 1);
    std::size_t apart = 0;
    for (int round = 0; round < 100'000; ++round) {
        const auto any = [&] {
            return direction_of({number(random), number(random), number(random)}).unit;
        };
        const Vector axis = any();
        const auto ray = [&] {
            Vector v = any();
            if (random() % 3 == 0) {
                const double away = std::ldexp(1, -static_cast<int>(random() % 56));
                for (std::size_t k = 0; k < 3; ++k) v[k] = axis[k] + away * v[k];
                if (random() % 2 == 0) v = times(v, -1);
            }
            return direction_of(v);
        };
        const auto combined = [&](const Direction& r, const Direction& s) {
            const double share = std::abs(number(random));
            Vector sum{};
            for (std::size_t k = 0; k < 3; ++k) {
                sum[k] = share * r.unit[k] + (1 - share) * s.unit[k];
            }
            return direction_of(sum);
        };
        /// A direction such that s lies between r and it.
        const auto beyond = [&](const Direction& r, const Direction& s) {
            const double share = std::abs(number(random));
            Vector difference{};
            for (std::size_t k = 0; k < 3; ++k) difference[k] = s.unit[k] - share * r.unit[k];
            return direction_of(difference);
        };
        const AxialView view(axis);
        const std::array entity{ray(), ray()};
        const Bounds bounds = view.bounds_of_entity(entity);
        // On a side of the cone, or inside: `middle` is between two rays, and the common direction
        // between `middle` and the third.
        const Direction common = combined(entity[0], entity[1]);
        const Direction first = ray();
        ASSERT_TRUE(view.wanted(std::array{first, ray(), common}).meets(bounds)) << round;
        const Direction middle = beyond(first, common);
        const Bounds common_alone = view.bounds_of_entity(std::array{common});
        ASSERT_TRUE(view.wanted(std::array{first, middle}).meets(common_alone)) << round;
        const Direction second = ray();
        const Direction third = beyond(second, middle);
        ASSERT_TRUE(view.wanted(std::array{first, second, third}).meets(bounds)) << round;
        if (!view.wanted(std::array{ray(), ray(), ray()}).meets(bounds)) ++apart;
    }
    EXPECT_GT(apart, 1000U);
}

/// Arbitrary cells, large and small, with few or many common vertices: intersections with a hub
/// occur in all directions.
TEST(Hubs, DoNotAffectTheFindingsAmongArbitraryCells) {
    std::mt19937_64 random(4711);
    std::size_t found = 0;
    for (int round = 0; round < (OCTETRA_SANITIZED ? 300 : 3000); ++round) {
        std::vector<Point> points;
        const auto coordinate = [&] { return static_cast<double>(random() % 9) - 4; };
        for (int k = 0; k < 10; ++k) {
            const double x = coordinate();
            const double y = coordinate();
            points.push_back({x, y, coordinate()});
        }
        std::vector<std::array<std::size_t, 4>> cells;
        for (int k = 0; k < 6; ++k) {
            std::array<std::size_t, 4> cell{};
            for (std::size_t& v : cell) v = random() % points.size();
            if (random() % 2 == 0) cell[0] = 0;
            if (random() % 2 == 0) cell[1] = 1;
            cells.push_back(cell);
        }
        Mesh mesh = test::mesh_of(points, cells);
        drop_flat_cells(mesh);
        ASSERT_NO_FATAL_FAILURE(expect_same_with_hubs(mesh, fmt::format("round {}", round)));
        found += found_in_space(mesh, 0).size();
    }
    EXPECT_GT(found, OCTETRA_SANITIZED ? 2'000U : 20'000U);
}

/// A cell at one end of the edge is found best along the edge: the faces at its corner cover more
/// of the sphere than of the circle round the edge. The other end lies on one of these faces.
TEST(Hubs, ShowAnEndOfAnEdgeOnACellThatHasTheOtherEnd) {
    Mesh mesh = test::mesh_of(
        {{0, 0, 0},
         {1, -1, 0},
         {5, -1, 2},
         {1, -5, -2},
         {-9, 11, -1},  // the edge, the cell's others
         {1, 1, 1},
         {1, 1, -1},
         {0, 0, -1},
         {-1, -1, -1},
         {-1, -1, 1}},  // round the edge
        {{0, 2, 3, 4}, {0, 1, 5, 6}, {0, 1, 6, 7}, {0, 1, 7, 8}, {0, 1, 8, 9}, {0, 1, 9, 5}});
    expect_same_with_hubs(mesh, "an end on a face");
    const auto found = found_in_space(mesh, 4);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Violation& violation) {
        return violation.code == Code::hanging_vertex && violation.found == "on a face of the cell";
    }));
}

TEST(Hubs, DoNotAffectTheFindingsAtAnyScale) {
    std::mt19937_64 random(99);
    for (std::size_t round = 0; round < (OCTETRA_SANITIZED ? 20U : 200U); ++round) {
        Mesh mesh = test::hubs[round % test::hubs.size()].make(24);
        move_at_random(mesh, random);
        drop_flat_cells(mesh);
        const auto expected = found_in_space(mesh, 4);
        for (const int exponent : {-1040, -540, 600, 1020}) {
            Mesh scaled = mesh;
            for (Point& p : scaled.points) {
                p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                     std::ldexp(p.z, exponent)};
            }
            ASSERT_NO_FATAL_FAILURE(expect_same_with_hubs(scaled, fmt::format("round {}", round)));
            if (exponent > -1040) {  // below, bits are lost
                EXPECT_EQ(found_in_space(scaled, 4).size(), expected.size());
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Hubs, HubTest, testing::ValuesIn(test::hubs),
                         [](const auto& hub) { return hub.param.name; });

}  // namespace
}  // namespace octetra::verify
