#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/reference/refine.hpp>

#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/thrown.hpp"

namespace octetra::reference {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Exactness, ChildrenFillTheirParentsExactlyOnDyadicCoordinates) {
    const Mesh mesh = test::perturbed_kuhn(3, 0.3, 9);
    constexpr int levels = 3;
    const double scale = std::ldexp(1, 20 + levels);
    const Refinement fine = refine(mesh, {.random = RandomShare{0.1, 1}}, Scheme::eight, levels);
    IndexVector<CellIndex, test::Int128> sums(mesh.cells.size(), 0);
    for (CellIndex c{0}; c < fine.mesh.cells.end_index(); ++c) {
        const auto volume = test::exact_volume(test::corners_of(fine.mesh, c), scale);
        ASSERT_TRUE(volume > 0);
        sums[fine.maps.cell_to_parent[c]] += volume;
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        ASSERT_TRUE(sums[c] == test::exact_volume(test::corners_of(mesh, c), scale));
    }
}

TEST(Exactness, MidpointsOfDyadicEdgesAreExact) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.3, 4);
    const Refinement fine = refine(mesh, {.all = true}, Scheme::eight, 2);
    VertexIndex v = fine.maps.first_midpoint;
    for (const auto& [a, b] : fine.maps.midpoint_to_edge) {
        const Point& m = fine.mesh.points[v];
        const Point& p = fine.mesh.points[a];
        const Point& q = fine.mesh.points[b];
        ASSERT_EQ(m.x - p.x, q.x - m.x);
        ASSERT_EQ(m.y - p.y, q.y - m.y);
        ASSERT_EQ(m.z - p.z, q.z - m.z);
        ++v;
    }
    EXPECT_EQ(v, fine.mesh.points.end_index());
}

/// A corner of a cube with coordinates near 2^52, where halves of 1 are not representable.
Mesh cell_of_side(double side) {
    const double far = 0x1p52;
    return test::one_cell({{{far, far, far},
                            {far + side, far, far},
                            {far, far + side, far},
                            {far, far, far + side}}});
}

TEST(Rounding, ThatWouldFlattenAChildIsReportedByCellAndLevel) {
    // One grid step: midpoints round to an end (to even).
    EXPECT_THAT(test::thrown_by<InputError>(
                    [] { (void)refine(cell_of_side(1), {.all = true}, Scheme::eight, 1); }),
                AllOf(HasSubstr("cell 0, level 1"), HasSubstr("flat")));
    // Four steps: two levels are exact, the third is not possible.
    EXPECT_EQ(refine(cell_of_side(4), {.all = true}, Scheme::eight, 2).mesh.cells.size(), 64U);
    EXPECT_THAT(test::thrown_by<InputError>(
                    [] { (void)refine(cell_of_side(4), {.all = true}, Scheme::eight, 3); }),
                HasSubstr("level 3"));
}

TEST(Rounding, NamesTheCellAsTheFileNumbersIt) {
    Mesh mesh = test::one_cell(test::cube_corner);
    const Mesh tiny = cell_of_side(1);
    mesh.points.insert(mesh.points.end(), tiny.points.begin(), tiny.points.end());
    mesh.cells.append({VertexIndex{4}, VertexIndex{5}, VertexIndex{6}, VertexIndex{7}});
    mesh.index_base = 1;
    EXPECT_THAT(
        test::thrown_by<InputError>([&] { (void)refine(mesh, {.all = true}, Scheme::eight, 1); }),
        HasSubstr("cell 2, level 1"));
}

TEST(Rounding, AtALaterLevelNamesTheCellOfTheInput) {
    Mesh mesh = test::one_cell(test::cube_corner);
    const Mesh small = cell_of_side(4);  // two levels are exact, the third is not possible
    mesh.points.insert(mesh.points.end(), small.points.begin(), small.points.end());
    mesh.cells.append({VertexIndex{4}, VertexIndex{5}, VertexIndex{6}, VertexIndex{7}});
    EXPECT_THAT(
        test::thrown_by<InputError>([&] { (void)refine(mesh, {.all = true}, Scheme::eight, 3); }),
        HasSubstr("cell 1, level 3"));
}

TEST(Rounding, ThatWouldInvertAChildIsReported) {
    // A sliver one grid step thick: the rounding of its midpoints moves a vertex through a face.
    std::size_t inverted = 0;
    std::size_t refused = 0;
    for (int i = 0; i < 256; ++i) {
        const auto step = [&](int bit) { return 0x1p52 + static_cast<double>(i >> bit & 3); };
        Mesh mesh;
        try {
            const std::array<Point, 4> corners{{{0x1p52, 0x1p52, step(0)},
                                                {0x1p52 + 9, 0x1p52, step(2)},
                                                {0x1p52, 0x1p52 + 11, step(4)},
                                                {0x1p52 + 7, 0x1p52 + 6, step(6)}}};
            if (orientation(corners[0], corners[1], corners[2], corners[3]) == 0) continue;
            mesh = test::one_cell(corners);
            const Mesh fine = refine(mesh, {.all = true}, Scheme::eight, 1).mesh;
            for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
                const Corners p = test::corners_of(fine, c);
                ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), 1);
            }
        } catch (const InputError& error) {
            ++refused;
            if (std::string(error.what()).find("inverted") != std::string::npos) ++inverted;
        }
    }
    EXPECT_GT(refused, 10U);
    EXPECT_GT(inverted, 0U);
}

/// A cell moved by 2^52, where only whole numbers are representable.
std::array<Point, 4> far_out(std::array<Point, 4> corners) {
    for (Point& p : corners) p = {0x1p52 + p.x, 0x1p52 + p.y, 0x1p52 + p.z};
    return corners;
}

/// A cell at the origin, refined in a first step, and a sliver, refined in a second.
struct RefinedSliver {
    History history;
    std::size_t children = 0;

    explicit RefinedSliver(const std::array<Point, 4>& corners) {
        history.input = test::one_cell(test::cube_corner);
        Mesh& mesh = history.input;
        const Mesh sliver = test::one_cell(corners);
        for (const Point& p : sliver.points) mesh.points.append(p);
        mesh.cells.append(sliver.cells.front());
        for (VertexIndex& v : mesh.cells.back()) v = VertexIndex{4U + v.value()};
        history = refined(history, {true, false}, Scheme::eight);
        history = refined(history, {0, 0, 0, 0, 0, 0, 0, 0, true}, Scheme::eight);
        children = replay(history).back().mesh.cells.size() - 8;
    }
    /// Marks some of the sliver's children, as bits, and all or none of the first step's.
    [[nodiscard]] CellMarks marks(unsigned of_sliver, bool of_other) const {
        CellMarks marks(8, static_cast<char>(of_other));
        for (std::size_t i = 0; i < children; ++i) {
            marks.push_back(static_cast<char>(of_sliver >> i & 1U));
        }
        return marks;
    }
    [[nodiscard]] std::string refusal_of(const CellMarks& may_coarsen) const {
        const History coarser = coarsened(history, may_coarsen);
        return test::thrown_by<InputError>([&] { (void)replay(coarser); });
    }
};

TEST(Rounding, ThatInvalidatesALargerCellIsReportedWhenCoarseningIsReplayed) {
    // The eight children and the cell are positively oriented. Without one of the midpoints there
    // are larger children, which are not, because the displacement by rounding is missing.
    const RefinedSliver inverted(far_out({{{5, 7, 0}, {13, 21, 0}, {63, 51, 3}, {22, 62, 1}}}));
    ASSERT_EQ(inverted.children, 8U);
    EXPECT_THAT(inverted.refusal_of(inverted.marks(0b0011'1100, false)),
                AllOf(HasSubstr("cell 1, level 2"), HasSubstr("inverted")));
    EXPECT_THAT(inverted.refusal_of(inverted.marks(0b0011'1100, true)),  // the first step is undone
                AllOf(HasSubstr("cell 1, level 1"), HasSubstr("inverted")));

    const RefinedSliver flat(far_out({{{57, 47, 2}, {56, 42, 2}, {25, 36, 3}, {20, 54, 0}}}));
    ASSERT_EQ(flat.children, 8U);
    EXPECT_THAT(flat.refusal_of(flat.marks(0b0000'1100, false)),
                AllOf(HasSubstr("cell 1, level 2"), HasSubstr("flat")));
    // The cell as a whole can be restored.
    EXPECT_EQ(replay(coarsened(flat.history, flat.marks(0xFF, true))).back().mesh,
              flat.history.input);
}

TEST(Rounding, OfMidpointsBeyondTheLargestDoubleIsReported) {
    const double big = 0x1.8p1023;
    const std::vector<std::array<Point, 4>> cells{
        {{{big, 0, 0}, {big, 1, 0}, {big, 0, 1}, {0, 0, 0}}},
        {{{0, big, 0}, {1, big, 0}, {0, big, 1}, {0, 0, 0}}},
        {{{0, 0, big}, {1, 0, big}, {0, 1, big}, {0, 0, 0}}}};
    for (const auto& corners : cells) {
        EXPECT_THAT(test::thrown_by<InputError>([&] {
                        (void)refine(test::one_cell(corners), {.all = true}, Scheme::eight, 1);
                    }),
                    HasSubstr("cannot be rounded"));
    }
}

TEST(Rounding, OfInexactMidpointsKeepsAllChildrenPositive) {
    Mesh mesh = test::kuhn(3, 3, 3, 1.0 / 3);
    for (Point& p : mesh.points) p = {p.x + 1e6, p.y / 7, p.z * 1e-3};
    const Mesh fine = refine(mesh, {.all = true}, Scheme::eight, 2).mesh;
    EXPECT_EQ(test::count_faces(fine).faults, 0U);
    for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
        const Corners p = test::corners_of(fine, c);
        ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), 1);
    }
}

}  // namespace
}  // namespace octetra::reference
