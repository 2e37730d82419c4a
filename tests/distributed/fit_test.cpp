#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/distributed/fit.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/reference_steps.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Fits of a mesh to target sizes, and the number of cells after a step.
namespace octetra::distributed {
namespace {

using testing::HasSubstr;

AdaptiveMesh mesh_for_fit(const Mesh& whole) {
    return distributed_mesh(whole, {.method = PartitionMethod::random, .seed = 5});
}

struct Fitted {
    int refined = 0;
    int coarsened = 0;
    MisfitCells misfits;
};

Fitted fit_to(AdaptiveMesh& mesh, const std::string& size, const FitOptions& options = {}) {
    Fit fit(mesh, options);
    const Expression expression(size);
    while (fit.next(mesh.cell_values(expression))) {
    }
    return {fit.refined(), fit.coarsened(), fit.misfit_cells(mesh.cell_values(expression))};
}

/// The definition of a fit, by steps of the reference on the first process.
class ReferenceFit {
public:
    ReferenceFit(const Mesh& mesh, Closure closure) : steps_(mesh), closure_(closure) {}

    void fit_to(const std::string& size) {
        const Selection too_long{.where = {Expression("longest > (" + size + ")")}};
        const Selection mergeable{.where = {Expression("2 * longest <= (" + size + ")")}};
        refine(too_long);
        for (std::size_t before = 0;; refine(too_long)) {
            const std::size_t now = count();
            if (before != 0 && now >= before) return;
            before = now;
            steps_.coarsen(mergeable, closure_);
            if (count() == before) return;
        }
    }
    [[nodiscard]] const Mesh& mesh() const { return steps_.mesh(); }

private:
    [[nodiscard]] std::size_t count() const { return mesh().cells.size(); }
    void refine(const Selection& selection) {
        for (std::size_t before = 0; before != count();) {
            before = count();
            if (closure_ == Closure::regular) {
                steps_.refine_regularly(selection);
            } else {
                steps_.refine(selection);
            }
        }
    }

    test::ReferenceSteps steps_;
    Closure closure_;
};

class FitsTo : public testing::TestWithParam<Closure> {};

/// Fine near a moving point, growing in proportion to the distance; near a moving plane, where the
/// size is not convex; everywhere; and coarse.
const std::array<std::string, 6> moving_sizes{
    "0.4 + hypot(x, hypot(y, z)) / 2",
    "0.4 + hypot(x - 1, hypot(y - 1, z)) / 2",
    "3 - 2.5 * (abs(x + y / 3 - 1.5) < 0.2)",
    "3 - 2.5 * (abs(x + y / 3 - 1.8) < 0.2)",
    "0.9",
    "100",
};

TEST_P(FitsTo, MovingSizesAsTheDefinitionByStepsOfTheReference) {
    const Mesh whole = test::perturbed_kuhn(2, 0.2, 3);
    AdaptiveMesh mesh = mesh_for_fit(whole);
    ReferenceFit reference(whole, GetParam());
    for (const std::string& size : moving_sizes) {
        SCOPED_TRACE(size);
        const FitOptions options{.step = {.closure = GetParam()},
                                 .balance = BalanceOptions{.most_over_mean = 1}};
        const Fitted fitted = fit_to(mesh, size, options);
        EXPECT_EQ(fitted.misfits.too_long, 0U);
        if (test::world().is_first()) reference.fit_to(size);
        const Mesh found = mesh.collect();
        EXPECT_TRUE(!test::world().is_first() || found == reference.mesh());
        // A second fit has nothing to do.
        const Fitted again = fit_to(mesh, size, options);
        EXPECT_LE(again.coarsened, 1);
        EXPECT_TRUE(mesh.collect() == found);
    }
    EXPECT_EQ(mesh.vertex_count(), whole.points.size());
}

INSTANTIATE_TEST_SUITE_P(Closures, FitsTo, testing::Values(Closure::longest_edge, Closure::regular),
                         [](const auto& closure) {
                             return closure.param == Closure::regular ? "Regular" : "LongestEdge";
                         });

TEST(Fit, CountsCellsOfOtherSizesAndThoseThatAreRoots) {
    // Cells of a Kuhn cube with edges of length 1 have a longest edge of sqrt(3).
    AdaptiveMesh mesh = mesh_for_fit(test::kuhn(3, 3, 3));
    const std::uint64_t input_cells = 6 * 27;
    Fitted fitted = fit_to(mesh, "9 - 8.1 * (x < 1)");
    EXPECT_EQ(fitted.refined, 1);
    EXPECT_EQ(fitted.coarsened, 0);
    EXPECT_EQ(fitted.misfits.too_long, 0U);
    EXPECT_EQ(test::world().sum(mesh.cells().size()) - fitted.misfits.too_short,
              std::uint64_t{8 * 6 * 9});
    EXPECT_GT(fitted.misfits.too_short, fitted.misfits.too_short_roots);
    EXPECT_GE(fitted.misfits.too_short_roots, std::uint64_t{6 * 9});

    fitted = fit_to(mesh, "9");
    EXPECT_EQ(fitted.coarsened, 1);
    EXPECT_EQ(fitted.misfits.too_short, input_cells);
    EXPECT_EQ(fitted.misfits.too_short_roots, input_cells);

    fitted = fit_to(mesh, "0.1", {.levels = 1});
    EXPECT_EQ(fitted.refined, 1);
    EXPECT_EQ(fitted.misfits.too_long, 8 * input_cells);
}

TEST(Fit, AcceptsInfiniteSizesAndMakesTheInput) {
    const Mesh whole = test::kuhn(2, 2, 2);
    AdaptiveMesh mesh = mesh_for_fit(whole);
    (void)mesh.refine(Selection{.all = true});
    Fit fit(mesh);
    const auto unlimited = [&] {
        return std::vector<double>(mesh.cells().size(), std::numeric_limits<double>::infinity());
    };
    while (fit.next(unlimited())) {
    }
    EXPECT_EQ(fit.coarsened(), 1);
    const Mesh found = mesh.collect();
    EXPECT_TRUE(!test::world().is_first() || found.cells == whole.cells);
}

TEST(Fit, RefusesSizesThatAreNotPositiveNamingTheCellAsInFiles) {
    Mesh whole = test::kuhn(2, 2, 2);
    whole.index_base = 1;
    AdaptiveMesh mesh = mesh_for_fit(whole);
    const std::vector<std::uint64_t> numbers = mesh.cell_numbers();
    for (const double wrong : {0.0, -2.5, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<double> sizes;
        for (const std::uint64_t number : numbers) {
            sizes.push_back(number == 17 || number == 30 ? wrong : 1.0);
        }
        Fit fit(mesh);
        EXPECT_EQ(test::thrown_by<InputError>([&] { (void)fit.next(sizes); }),
                  "the target size of cell 18 is " +
                      std::string(wrong == 0  ? "0"
                                  : wrong < 0 ? "-2.5"
                                              : "nan") +
                      ", not a number above 0");
    }
}

TEST(Fit, RefusesOtherNumbersOfSizesAndInvalidOrDifferentOptions) {
    AdaptiveMesh mesh = mesh_for_fit(test::kuhn(2, 2, 2));
    const auto refused = [&](const FitOptions& options, std::size_t more_sizes = 0) {
        return test::thrown_by<InputError>([&] {
            (void)Fit(mesh, options).next(std::vector<double>(mesh.cells().size() + more_sizes, 1));
        });
    };
    const bool is_last = test::world().rank() == test::world().size() - 1;
    EXPECT_THAT(refused({}, is_last ? 1 : 0), HasSubstr("target sizes for"));
    EXPECT_THAT(refused({.levels = -1}), HasSubstr("levels must not be negative"));
    EXPECT_THAT(refused({.step = {.is_last = true}}), HasSubstr("must not be the last step"));
    EXPECT_THAT(refused({.balance = BalanceOptions{.may_forget_history = true}}),
                HasSubstr("cannot forget the history"));
    if (test::world().size() == 1) return;
    EXPECT_THAT(refused({.levels = is_last ? 3 : 4}), HasSubstr("levels"));
    EXPECT_THAT(refused({.balance = is_last ? std::optional<BalanceOptions>() : BalanceOptions{}}),
                HasSubstr("balance"));
}

class CellsAfter : public testing::TestWithParam<Closure> {};

TEST_P(CellsAfter, IsTheNumberThatTheStepMakesAndChangesNothing) {
    AdaptiveMesh mesh = mesh_for_fit(test::perturbed_kuhn(3, 0.2, 7));
    for (const double share : {0.02, 0.3, 0.0, 0.01, 1.0}) {
        const StepOptions options{.closure = GetParam(), .max_cells = 1};
        const auto marks = marks_of(mesh, {.random = RandomShare{share, 4}});
        const Mesh before = mesh.collect();
        const std::uint64_t predicted = mesh.cells_after(marks, options);
        EXPECT_TRUE(mesh.collect() == before);
        (void)mesh.refine(marks, {.closure = GetParam()});
        EXPECT_EQ(predicted, test::world().sum(mesh.cells().size())) << share;
    }
}

/// Returns the cells that may be marked within a limit, ascending: searches for the greatest number
/// of them, in the documented order.
std::vector<std::uint64_t> marked_by_search(const Mesh& whole, Closure closure,
                                            std::uint64_t limit) {
    std::vector<CellIndex> order;
    for (CellIndex c{0}; c < whole.cells.end_index(); ++c) order.push_back(c);
    const auto squared_longest = [&](CellIndex c) {
        double longest = 0;
        for (const auto& [i, j] : cell_edges) {
            longest = std::max(longest, squared_length({whole.points[whole.cells[c][i]],
                                                        whole.points[whole.cells[c][j]]}));
        }
        return longest;
    };
    std::ranges::stable_sort(order, std::ranges::greater(), squared_longest);
    const reference::History input{whole, {}};
    reference::CellMarks marks(whole.cells.size(), 0);
    std::vector<std::uint64_t> most;
    std::vector<std::uint64_t> first;
    for (const CellIndex c : order) {
        marks[c] = 1;
        first.push_back(c.value());
        const reference::History after = closure == Closure::regular
                                             ? reference::refined_regularly(input, marks)
                                             : reference::refined(input, marks, Scheme::eight);
        if (reference::replay(after).back().mesh.cells.size() <= limit) most = first;
    }
    std::ranges::sort(most);
    return most;
}

/// Collective. Returns the numbers of the marked cells of all processes, ascending.
std::vector<std::uint64_t> marked_numbers(const AdaptiveMesh& mesh,
                                          const std::vector<std::uint8_t>& marks) {
    const std::vector<std::uint64_t> numbers = mesh.cell_numbers();
    std::vector<std::uint64_t> here;
    for (std::size_t c = 0; c < marks.size(); ++c) {
        if (marks[c] != 0) here.push_back(numbers[c]);
    }
    std::vector<std::uint64_t> all;
    for (const auto& of_rank : test::of_all(here))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::ranges::sort(all);
    return all;
}

TEST_P(CellsAfter, MarksWithinALimitAreThoseWithTheLongestEdgesAndThenTheLowestNumbers) {
    for (const Mesh& whole : {test::kuhn(2, 2, 2), test::perturbed_kuhn(2, 0.2, 7)}) {
        for (const std::uint64_t limit : {47U, 48U, 100U, 211U, 383U, 384U}) {
            AdaptiveMesh mesh = mesh_for_fit(whole);
            const std::vector<std::uint8_t> all(mesh.cells().size(), 1);
            const auto marks = mesh.marks_within(all, limit, {.closure = GetParam()});
            const std::vector<std::uint64_t> marked = marked_numbers(mesh, marks);
            if (!test::world().is_first()) continue;
            EXPECT_EQ(marked, marked_by_search(whole, GetParam(), limit)) << limit;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Closures, CellsAfter,
                         testing::Values(Closure::longest_edge, Closure::regular),
                         [](const auto& closure) {
                             return closure.param == Closure::regular ? "Regular" : "LongestEdge";
                         });

}  // namespace
}  // namespace octetra::distributed
