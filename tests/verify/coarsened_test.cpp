#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/reference/history.hpp>
#include <octetra/verify/verify.hpp>

#include "support/meshes.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// The mesh after coarsening is a refinement of the input.
namespace octetra::verify {
namespace {

using reference::History;
using reference::Refinement;
using test::codes_of;
using testing::AnyOf;

Selection ball(double y, double radius) { return {.spheres = {{{0.5, y, 1}, radius}}}; }

class Coarsened : public testing::TestWithParam<double> {
protected:
    /// Two cubes a side, with a tagged boundary, refined in three nested balls.
    [[nodiscard]] static History refined_thrice() {
        History history{test::perturbed_kuhn(2, GetParam(), 5), {}};
        test::list_boundary(history.input);
        for (const double radius : {1.0, 0.8, 0.5}) {
            const Refinement present = reference::replay(history).back();
            const auto marks = reference::marked_cells(present, ball(0.5, radius));
            history = reference::refined(history, marks, Scheme::eight);
        }
        return history;
    }
};

TEST_P(Coarsened, IsAValidRefinementOfTheInputAndRefinedByThePreviousMesh) {
    History history = refined_thrice();
    const Mesh input = history.input;
    Refinement before = reference::replay(history).back();
    for (const double y : {0.8, 0.5, 0.2}) {
        history = reference::coarsened(history, reference::marked_cells(before, ball(y, 0.6)));
        const Refinement coarser = reference::replay(history).back();
        ASSERT_LT(coarser.mesh.cells.size(), before.mesh.cells.size());
        EXPECT_EQ(codes_of(test::verified_by_all(coarser.mesh)), "");
        EXPECT_EQ(codes_of(test::verified_by_all(input, coarser.mesh, {.maps = &coarser.maps})),
                  "");
        // The old cells halve the new ones, but not always at their longest edges, for which alone
        // angles are bounded.
        EXPECT_THAT(codes_of(test::verified_by_all(coarser.mesh, before.mesh)),
                    AnyOf("", "face_angle_too_small"));
        before = coarser;
    }
}

INSTANTIATE_TEST_SUITE_P(WithTiesAndWithout, Coarsened, testing::Values(0.0, 0.2));

}  // namespace
}  // namespace octetra::verify
