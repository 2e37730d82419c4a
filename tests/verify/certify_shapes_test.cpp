#include <octetra/verify/certify_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>

#include "shapes/integers.hpp"
#include "shapes/patterns.hpp"
#include "shapes/shape_set.hpp"
#include "support/meshes.hpp"
#include "verify/port_of_shapes.hpp"
#include "verify/thread_group.hpp"

/// The certificate of shapes, against closed forms, the literature, and a slow definition.
namespace octetra::verify {
namespace {

using Corners = std::array<Point, 4>;

using test::kuhn_corners;
using test::regular_corners;
using test::tie_free_corners;

CellCertificate certificate_of(Corners corners) {
    if (orientation(corners[0], corners[1], corners[2], corners[3]) < 0) {
        std::swap(corners[2], corners[3]);
    }
    return certify_cell(corners);
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Returns the least angle reported for the cell's set, as far as rounding outward allows.
void expect_bounds(const ShapeBounds& found, const test::Angles& exact) {
    constexpr double error = relative_error_of_bounds;
    EXPECT_LE(found.min_dihedral, exact.min_dihedral * (1 + 1e-15));
    EXPECT_GE(found.min_dihedral, exact.min_dihedral * (1 - error));
    EXPECT_GE(found.max_dihedral, exact.max_dihedral * (1 - 1e-15));
    EXPECT_LE(found.max_dihedral, exact.max_dihedral * (1 + error));
    EXPECT_LE(found.min_eta, exact.min_eta * (1 + 1e-15));
    EXPECT_GE(found.min_eta, exact.min_eta * (1 - error));
    EXPECT_NEAR(found.min_solid, exact.min_solid, 1e-8);
    EXPECT_LE(found.min_solid, exact.min_solid + 1e-15);
}

std::set<std::set<std::uint8_t>> point_sets(const auto& pieces) {
    std::set<std::set<std::uint8_t>> sets;
    for (const shapes::Piece& piece : pieces)
        sets.insert({piece.points.begin(), piece.points.end()});
    return sets;
}

TEST(ShapePatterns, AreDeterminedByTheLongestEdgesOfFaces) {
    shapes::LongestFirst order{0, 1, 2, 3, 4, 5};
    std::set<shapes::FaceKey> keys;
    do {
        const shapes::FaceKey key = shapes::face_key(order);
        keys.insert(key);
        const shapes::Pattern own = shapes::make_pattern(order);
        ASSERT_NE(shapes::pattern_of(key), nullptr);
        const shapes::Pattern& common = *shapes::pattern_of(key);
        EXPECT_EQ(point_sets(own.children), point_sets(common.children));
        EXPECT_EQ(point_sets(own.transition_cells), point_sets(common.transition_cells));
        for (const shapes::Piece& child : own.children) EXPECT_EQ(child.depth, 3);
    } while (std::ranges::next_permutation(order).found);
    EXPECT_EQ(keys.size(), 51U);  // the tetrahedron's types, in all positions
}

TEST(Certificate, OfKnownShapesIsThatOfTheLiterature) {
    const CellCertificate of_kuhn = certificate_of(kuhn_corners);
    EXPECT_TRUE(of_kuhn.is_closed);
    EXPECT_EQ(of_kuhn.shapes, 1U);
    EXPECT_EQ(of_kuhn.generations, 1U);
    EXPECT_NEAR(of_kuhn.bounds.min_dihedral, 45, 1e-8);
    EXPECT_LE(of_kuhn.bounds.min_dihedral, 45);
    EXPECT_EQ(certificate_of(test::sommerville_corners).shapes, 2U);
    EXPECT_EQ(certificate_of(test::cube_corner).shapes, 4U);
    const CellCertificate untied = certificate_of(tie_free_corners);
    EXPECT_EQ(untied.shapes, 40U);
    EXPECT_EQ(untied.generations, 4U);  // new shapes up to the third
    EXPECT_FALSE(untied.has_ties);
}

/// Padron, Plaza and Suarez (doi 10.3390/math11214456): a regular tetrahedron has two further
/// classes, and eta is at least 2/3 of its own, if opposite edges are taken as the longest ones.
/// Slight perturbations decide so; the order of edges by coordinates does not.
TEST(Certificate, OfTheRegularTetrahedronDependsOnTies) {
    const CellCertificate perturbed = certificate_of(test::type_o_corners);
    EXPECT_EQ(perturbed.shapes, 13U);
    EXPECT_GT(perturbed.bounds.min_eta, 2.0 / 3 * 0.99);

    using Lengths = std::array<std::int64_t, 6>;
    const Lengths first{1, 1, 1, 1, 1, 1};
    const auto choices =
        [](const Lengths& lengths) {  // of longest edges of faces, and their shapes
            std::set<std::set<Lengths>> sets;
            shapes::LongestFirst order{0, 1, 2, 3, 4, 5};
            do {
                if (!std::ranges::is_sorted(order, std::greater<>(),
                                            [&](auto e) { return lengths[e]; })) {
                    continue;
                }
                const auto all = shapes::all_lengths(lengths);
                std::set<Lengths> found;
                for (const shapes::Piece& child : shapes::make_pattern(order).children) {
                    Lengths l{};
                    for (std::size_t e = 0; e < 6; ++e) l[e] = all[child.lengths[e]];
                    found.insert(shapes::up_to_congruence(l));
                }
                sets.insert(found);
            } while (std::ranges::next_permutation(order).found);
            return sets;
        };
    // In units of equal volume, these are the squared lengths of the paper's classes.
    const Lengths second = shapes::up_to_congruence(Lengths{1, 1, 1, 1, 2, 3});
    const Lengths third = shapes::up_to_congruence(Lengths{1, 1, 1, 1, 1, 2});
    EXPECT_TRUE(choices(first).contains({second}));
    EXPECT_TRUE(choices(second).contains({second, third}));
    EXPECT_TRUE(choices(third).contains({second, third}));
    const auto sum = [](const Lengths& l) { return std::reduce(l.begin(), l.end()); };
    EXPECT_EQ(2 * sum(second), 3 * sum(first));  // eta is the inverse of the sum
    EXPECT_LT(sum(third), sum(second));

    const CellCertificate tied = certificate_of(regular_corners);
    EXPECT_TRUE(tied.has_ties);
    EXPECT_TRUE(tied.is_closed);
    const auto ported = test::ported_certificate(
        {test::Corner{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}, 10'000);
    EXPECT_EQ(tied.shapes, ported.shapes);
    EXPECT_EQ(tied.placements, ported.placements);
    EXPECT_EQ(tied.generations, ported.generations);
    expect_bounds(tied.bounds, ported.bounds);
}

/// Random tetrahedra, from a few coordinates, with many ties, to many.
TEST(Certificate, EqualsTheSlowDefinition) {
    std::mt19937 random(5);
    int tied = 0;
    for (const int most : {2, 2, 2, 3, 3, 4, 6, 50, 50, 50}) {
        std::uniform_int_distribution<int> coordinate(0, most);
        test::Tetrahedron t;
        Corners corners;
        do {
            for (std::size_t k = 0; k < 4; ++k) {
                for (std::int64_t& x : t[k]) x = coordinate(random);
                corners[k] = test::point_of(t[k]);
            }
        } while (test::six_volumes(t) <= 0);
        constexpr std::size_t limit = 3000;
        const CellCertificate found = certify_cell(corners, limit);
        const test::PortedCertificate expected = test::ported_certificate(t, limit);
        SCOPED_TRACE(fmt::format("{} shapes, ties {}", found.shapes, found.has_ties));
        ASSERT_EQ(found.is_closed, expected.is_closed);
        if (!found.is_closed) continue;
        EXPECT_EQ(found.shapes, expected.shapes);
        expect_bounds(found.bounds, expected.bounds);
        if (!found.has_ties) continue;
        ++tied;
        EXPECT_EQ(found.placements, expected.placements);
        EXPECT_EQ(found.generations, expected.generations);
    }
    EXPECT_GE(tied, 2);
}

TEST(Certificate, IsInvariantUnderRenumberingTranslationAndScaling) {
    const CellCertificate expected = certificate_of(regular_corners);
    const auto& [a, b, c, d] = regular_corners;
    EXPECT_EQ(certificate_of({b, c, a, d}), expected);
    EXPECT_EQ(certificate_of({d, c, b, a}), expected);
    Corners moved = regular_corners;
    for (Point& p : moved) p = {3 * p.x + 1e6, 3 * p.y - 0.5, 3 * p.z};
    EXPECT_EQ(certificate_of(moved), expected);
    for (const double scale : {0x1p-1040, 0x1p1000}) {
        Corners scaled = tie_free_corners;
        for (Point& p : scaled) p = {p.x * scale, p.y * scale, p.z * scale};
        EXPECT_EQ(certificate_of(scaled), certificate_of(tie_free_corners));
    }
}

/// Coordinates of 70, 300 and 1000 binary places need integers of each size.
TEST(Certificate, TakesLargerIntegersWhereCoordinatesNeedThem) {
    const CellCertificate exact = certificate_of(tie_free_corners);
    for (const double noise : {0x1p-60, 0x1p-300, 0x1p-1000}) {
        Corners corners = tie_free_corners;
        corners[0] = {noise, 3 * noise, -noise};
        const CellCertificate found = certify_cell(corners);
        EXPECT_EQ(found.shapes, exact.shapes);
        EXPECT_EQ(found.generations, exact.generations);
        EXPECT_TRUE(found.is_closed);
        EXPECT_NEAR(found.bounds.min_dihedral, exact.bounds.min_dihedral, 1e-8);
        EXPECT_NEAR(found.bounds.max_dihedral, exact.bounds.max_dihedral, 1e-8);
        EXPECT_NEAR(found.bounds.min_eta, exact.bounds.min_eta, 1e-10);
        EXPECT_NEAR(found.bounds.min_solid, exact.bounds.min_solid, 1e-10);
    }
}

/// The lengths of this cell grow beyond those that integers of 128 bits are used for.
TEST(Certificate, IsRepeatedWithLargerIntegersIfLengthsGrow) {
    const Corners small{Point{0, 0, 0}, {13, -20, -1}, {17, -19, 1}, {-10, -20, 1}};
    Corners large = small;
    for (Point& p : large) p = {p.x * 0x1p55, p.y * 0x1p55, p.z * 0x1p55};
    large[0].z = 1;
    const CellCertificate expected = certificate_of(small);
    const CellCertificate found = certificate_of(large);
    EXPECT_EQ(found.shapes, expected.shapes);
    EXPECT_EQ(found.generations, expected.generations);
    EXPECT_NEAR(found.bounds.min_dihedral, expected.bounds.min_dihedral, 1e-8);
    EXPECT_NEAR(found.bounds.max_dihedral, expected.bounds.max_dihedral, 1e-8);
}

/// Bisection makes lengths four times as large, and intermediate results four times larger still.
template <class Int>
void expect_headroom(const Int& first_that_does_not_fit) {
    const Int largest = first_that_does_not_fit - 1;
    EXPECT_TRUE(shapes::fits(largest));
    EXPECT_FALSE(shapes::fits(first_that_does_not_fit));
    const Int product = largest * 16;
    EXPECT_TRUE(product > largest);
    EXPECT_TRUE(product / 16 == largest);
}

TEST(CertificateIntegers, FitIfBisectionCannotOverflow) {
    expect_headroom<shapes::Int128>(shapes::Int128{1} << 122);
    expect_headroom<shapes::Int512>(shapes::Int512{1} << 506);
    EXPECT_TRUE(shapes::fits(shapes::BigInt{shapes::BigInt{1} << 5000}));
}

/// Two edges of the base that are equal, or differ in their last bits: either may be the longest.
TEST(Certificate, CoversBothDecisionsWhereRoundingMayDecide) {
    const auto cell = [](double shift) {
        return Corners{Point{0, 0, 0}, {6, 0, 0}, {3 + shift, 8, 0}, {2, 1, 3}};
    };
    const CellCertificate first = certify_cell(cell(0x1p-20));
    const CellCertificate second = certify_cell(cell(-0x1p-20));
    for (const double shift : {0x1p-45, -0x1p-45}) {
        const CellCertificate near = certify_cell(cell(shift));
        EXPECT_TRUE(near.has_near_ties);
        EXPECT_GE(near.shapes, std::max(first.shapes, second.shapes));
        for (const CellCertificate& one : {first, second}) {
            EXPECT_LE(near.bounds.min_dihedral, one.bounds.min_dihedral + 1e-4);
            EXPECT_GE(near.bounds.max_dihedral, one.bounds.max_dihedral - 1e-4);
        }
    }
    EXPECT_FALSE(first.has_near_ties);
    EXPECT_FALSE(certificate_of(kuhn_corners).has_near_ties);
}

TEST(Certificate, OfThinCellsIsExact) {
    for (const double height : {1e-3, 1e-6, 1e-9}) {
        const CellCertificate found =
            certify_cell({Point{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}, {0.4, 0.3, height}}, 1);
        // At the longest edges of the base, the foot of the height is 0.3 away from the first one.
        EXPECT_LE(found.bounds.min_dihedral, degrees(std::atan2(height, 0.3)));
        EXPECT_GT(found.bounds.min_dihedral, degrees(height) / 10);
        EXPECT_GT(found.bounds.max_dihedral, 180 - degrees(20 * height));
        EXPECT_LT(found.bounds.max_dihedral, 180);
    }
    EXPECT_THROW((void)certify_cell({Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-300}}),
                 InputError);
}

/// The angles of all cells up to this generation, and of the pieces of these, children included.
test::Angles angles_to_generation(const test::Tetrahedron& root, int last) {
    test::Angles found;
    std::vector<test::Tetrahedron> cells{root};
    for (int generation = 0; generation <= last; ++generation) {
        std::vector<test::Tetrahedron> next;
        for (const test::Tetrahedron& cell : cells) {
            found.add(test::angles(cell));
            for (unsigned edges = 1; edges < 64; ++edges) {
                if (!test::is_closed(cell, edges)) continue;
                for (const auto& piece : test::children(cell, edges)) {
                    found.add(test::angles(piece));
                    if (edges == 63) next.push_back(piece);
                }
            }
        }
        cells = std::move(next);
    }
    return found;
}

TEST(Certificate, HoldsToAGenerationIfTheLimitIsReached) {
    const std::size_t limit = 20;  // 1, 6, 20, 13 new shapes
    const CellCertificate found = certify_cell(tie_free_corners, limit);
    EXPECT_FALSE(found.is_closed);
    EXPECT_EQ(found.generations, 1U);
    const CellCertificate all = certificate_of(tie_free_corners);
    EXPECT_GE(found.bounds.min_dihedral, all.bounds.min_dihedral);
    expect_bounds(found.bounds, angles_to_generation(
                                    {test::Corner{0, 0, 0}, {7, 0, 0}, {2, 5, 0}, {1, 2, 6}}, 1));
}

/// Dihedral angles of some 60 degrees at long edges, whose cosines floating point would cancel.
TEST(Certificate, OfNeedlesIsExact) {
    const std::int64_t length = 10'000;
    const test::Tetrahedron needle{test::Corner{0, 0, 0}, {3, 0, 0}, {1, 2, 0}, {0, 0, length}};
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = test::point_of(needle[k]);
    expect_bounds(certify_cell(corners, 1).bounds, angles_to_generation(needle, 0));
}

TEST(CertificateOfAMesh, IsThatOfItsCells) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.2, 5);
    const ShapeCertificate found = certify_shapes(mesh, {.worst = 4});
    ASSERT_EQ(found.cells, mesh.cells.size());
    std::multimap<double, std::uint64_t> by_angle;
    std::uint64_t sum = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
        const CellCertificate cell = certify_cell(corners);
        sum += cell.shapes;
        by_angle.emplace(cell.bounds.min_dihedral, c.value());
        EXPECT_GE(cell.bounds.min_eta, found.bounds.min_eta);
        EXPECT_LE(cell.bounds.max_dihedral, found.bounds.max_dihedral);
        EXPECT_GE(cell.bounds.min_solid, found.bounds.min_solid);
    }
    EXPECT_EQ(found.sum_of_shapes, sum);
    EXPECT_TRUE(found.is_closed());
    ASSERT_EQ(found.worst.size(), 4U);
    auto expected = by_angle.begin();
    for (const CertifiedCell& cell : found.worst) {
        EXPECT_EQ(cell.certificate.bounds.min_dihedral, expected->first);
        EXPECT_EQ(cell.cell, (expected++)->second);
    }
    EXPECT_EQ(found.bounds.min_dihedral, by_angle.begin()->first);
    const auto& counts = found.dihedral_histogram;
    EXPECT_EQ(std::reduce(counts.begin(), counts.end()), found.cells);
}

TEST(CertificateOfAMesh, OfAKuhnCubeHasAllCellsAt45Degrees) {
    const ShapeCertificate found = certify_shapes(test::kuhn(4, 4, 4));
    EXPECT_EQ(found.max_shapes, 1U);
    EXPECT_EQ(found.dihedral_histogram[9], 384U);
    EXPECT_NEAR(found.bounds.min_dihedral, 45, 1e-8);
    EXPECT_NEAR(found.bounds.max_dihedral, 120, 1e-8);
}

TEST(CertificateOfAMesh, IsTheSameOnAnyNumberOfProcesses) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.2, 5);
    for (const CertifyOptions& options : {CertifyOptions{}, CertifyOptions{.limit = 30}}) {
        const ShapeCertificate alone = certify_shapes(mesh, options);
        for (const int size : {1, 2, 3, 7}) {
            test::run_together(size, [&](const ProcessGroup& group) {
                const MeshSlice slice = distribute_slices(mesh, group);
                EXPECT_EQ(certify_shapes(slice, group, options), alone);
            });
        }
    }
}

TEST(CertificateOfAMesh, WithoutCellsIsEmpty) {
    const ShapeCertificate found = certify_shapes(Mesh{});
    EXPECT_EQ(found.cells, 0U);
    EXPECT_TRUE(found.is_closed());
}

std::string refusal(const Mesh& mesh, int size) {
    std::string message;
    test::run_together(size, [&](const ProcessGroup& group) {
        const MeshSlice slice = distribute_slices(mesh, group);
        try {
            (void)certify_shapes(slice, group);
            ADD_FAILURE() << "not refused";
        } catch (const InputError& error) {
            if (group.is_first()) message = error.what();
        }
    });
    return message;
}

TEST(CertificateOfAMesh, RefusesFlatAndInvertedCellsByNumber) {
    Mesh mesh = test::kuhn(2, 2, 2);
    mesh.index_base = 1;
    std::swap(mesh.cells[CellIndex{40}][0], mesh.cells[CellIndex{40}][1]);
    for (const int size : {1, 3}) {
        EXPECT_EQ(refusal(mesh, size), "cell 41 is inverted: its corners are in negative order");
    }
    mesh.cells[CellIndex{7}][3] = mesh.cells[CellIndex{7}][0];
    for (const int size : {1, 3}) {
        EXPECT_EQ(refusal(mesh, size), "cell 8 is flat: it has no shape to certify");
    }
    EXPECT_THROW((void)certify_shapes(mesh), InputError);
}

}  // namespace
}  // namespace octetra::verify
