#include <gtest/gtest.h>

#include <octetra/reference/history.hpp>

#include "support/meshes.hpp"

/// Counts of refined and coarsened meshes, computed by an independent program.
namespace octetra::reference {
namespace {

struct Counts {
    std::size_t cells = 0;
    std::size_t vertices = 0;
    friend bool operator==(const Counts&, const Counts&) = default;
};
void PrintTo(const Counts& counts, std::ostream* out) {
    *out << counts.cells << " / " << counts.vertices;
}

/// 4 x 4 x 4 bricks in the unit cube, with six cells each: a ring round its diagonal.
Mesh bricks() {
    // Bit 0 of a corner's number is set at the high end of x, bit 1 of y, bit 2 of z.
    constexpr std::array<std::array<std::size_t, 4>, 6> cells_of_brick{
        {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
    Mesh mesh = test::kuhn(4, 4, 4, 0.25);
    mesh.cells.clear();
    for (std::size_t brick = 0; brick < 64; ++brick) {
        const std::size_t low = brick % 4 + brick / 4 % 4 * 5 + brick / 16 * 25;
        const auto corner = [&](std::size_t bits) {
            return VertexIndex{low + (bits & 1U) + (bits >> 1U & 1U) * 5 + (bits >> 2U) * 25};
        };
        for (const auto& [a, b, c, d] : cells_of_brick) {
            mesh.cells.push_back({corner(a), corner(b), corner(c), corner(d)});
        }
    }
    return mesh;
}

/// Refines and coarsens it.
class Histories : public testing::Test {
protected:
    History history{bricks(), {}};

    [[nodiscard]] Refinement present() const { return replay(history).back(); }
    [[nodiscard]] CellMarks in_sphere(const Point& centre, double radius) const {
        Selection selection;
        selection.spheres.push_back({centre, radius});
        return marked_cells(present(), selection);
    }
    [[nodiscard]] CellMarks all() const { return marked_cells(present(), {.all = true}); }
    [[nodiscard]] CellMarks every(std::size_t stride) const {
        CellMarks marks(present().mesh.cells.size(), false);
        for (std::size_t c = 0; c < marks.size(); c += stride) marks[CellIndex{c}] = true;
        return marks;
    }
    Counts refine(const CellMarks& marks) {
        history = refined(history, marks, Scheme::eight);
        return counts();
    }
    Counts coarsen(const CellMarks& marks) {
        history = coarsened(history, marks);
        return counts();
    }

private:
    [[nodiscard]] Counts counts() const {
        const Mesh mesh = present().mesh;
        return {mesh.cells.size(), mesh.points.size()};
    }
};

TEST_F(Histories, OfTwoBallsThatOverlapGoBackToTheInputStepByStep) {
    const Mesh input = history.input;
    const Point centre{.3, .4, .5};
    EXPECT_EQ(refine(in_sphere(centre, .3)), (Counts{1254, 290}));
    EXPECT_EQ(refine(in_sphere(centre, .2)), (Counts{3420, 679}));
    EXPECT_EQ(coarsen(in_sphere(centre, .2)), (Counts{3128, 636}));
    EXPECT_EQ(refine(in_sphere({.7, .6, .5}, .25)), (Counts{6108, 1162}));
    EXPECT_EQ(coarsen(in_sphere(centre, .4)), (Counts{3500, 701}));
    EXPECT_EQ(coarsen(all()), (Counts{1250, 287}));
    EXPECT_EQ(coarsen(all()), (Counts{734, 190}));
    EXPECT_EQ(coarsen(all()), (Counts{384, 125}));
    EXPECT_EQ(present().mesh, input);
}

TEST_F(Histories, AroundACornerLoseOnlyWhatNoCellNeeds) {
    EXPECT_EQ(refine(in_sphere({0, 0, 0}, .3)), (Counts{534, 162}));
    EXPECT_EQ(refine(in_sphere({0, 0, 0}, .2)), (Counts{690, 202}));
    EXPECT_EQ(refine(in_sphere({0, 0, 0}, .1)), (Counts{846, 242}));
    EXPECT_EQ(coarsen(in_sphere({0, 0, 0}, .15)), (Counts{708, 205}));
    EXPECT_EQ(coarsen(every(2)), (Counts{708, 205}));
    EXPECT_EQ(refine(every(5)), (Counts{4828, 1052}));
    EXPECT_EQ(coarsen(all()), (Counts{708, 205}));
    EXPECT_EQ(coarsen(all()), (Counts{678, 196}));
}

TEST_F(Histories, OfAUniformStepKeepWhatALaterStepNeeds) {
    const Mesh input = history.input;
    EXPECT_EQ(refine(all()), (Counts{3072, 729}));
    EXPECT_EQ(refine(in_sphere({.5, .5, .5}, .3)), (Counts{6768, 1381}));
    EXPECT_EQ(coarsen(all()), (Counts{1872, 385}));
    EXPECT_EQ(coarsen(all()), (Counts{384, 125}));
    EXPECT_EQ(present().mesh, input);
}

}  // namespace
}  // namespace octetra::reference
