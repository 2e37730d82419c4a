#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include <octetra/generator/tetgen.hpp>

#include "distributed/world.hpp"
#include "properties/case_files.hpp"
#include "properties/case_json.hpp"
#include "properties/draw_case.hpp"
#include "properties/histories/draw_history.hpp"
#include "properties/one_level.hpp"
#include "properties/simpler.hpp"
#include "support/temporary_folder.hpp"

/// Tests of the cases themselves: degeneracy, simplification and storage in files.
namespace octetra::properties {
namespace {

constexpr int ranks = 3;

std::vector<Case> some_cases(int count) {
    std::vector<Case> cases;
    Draw draw(7);
    for (int i = 0; i < count; ++i) {
        cases.push_back(draw_case(draw, i % 100, ranks, i % 5 == 0));
    }
    return cases;
}

std::vector<Case> some_histories(int count) {
    std::vector<Case> cases;
    Draw draw(8);
    for (int i = 0; i < count; ++i) {
        cases.push_back(draw_history(draw, i % 100, ranks, i % 5 == 0));
    }
    return cases;
}

std::vector<Case> some_of_both(int count) {
    std::vector<Case> cases = some_cases(count);
    for (Case& c : some_histories(count)) cases.push_back(std::move(c));
    return cases;
}

TEST(Cases, AreOftenDegenerateInEachWay) {
    if (!test::world().is_first()) return;  // drawn on the first rank alone, as for the laws
    ASSERT_TRUE(generator::has_tetgen()) << "without TetGen there are lattices only";
    std::map<std::string, int> counts;
    for (const Case& c : some_cases(300)) {
        for (const std::string& tag : tags_of(c, ranks)) ++counts[tag];
    }
    for (const std::string& tag : all_tags())
        EXPECT_GE(counts[tag], 9) << tag << ": " << counts[tag];
}

TEST(Cases, AreHistoriesInWhichEachThingHappensOften) {
    if (!test::world().is_first()) return;
    std::map<std::string, int> counts;
    for (const Case& c : some_histories(300)) {
        EXPECT_LE(c.steps.size(), 12U);
        for (const std::string& tag : tags_of_history(c, ranks)) ++counts[tag];
    }
    for (const std::string& tag : all_tags_of_histories())
        EXPECT_GE(counts[tag], 9) << tag << ": " << counts[tag];
}

/// Whichever simplification is tried first, the search ends at one cell that nothing marks.
TEST(Cases, BecomeSimplerUntilOneCellIsLeft) {
    if (!test::world().is_first()) return;
    for (Case c : some_of_both(20)) {
        while (true) {
            const auto simpler = simplifications(c);
            const auto next = std::ranges::find_if(
                simpler, [](const auto& s) { return !s().mesh.cells.empty(); });
            if (next == simpler.end()) break;
            c = (*next)();
        }
        EXPECT_EQ(c.mesh.cells.size(), 1U);
        EXPECT_EQ(c.mesh.points.size(), 4U);
        EXPECT_EQ(c.levels, 1);
        EXPECT_TRUE(c.steps.empty());
        EXPECT_TRUE(c.mesh.regions.empty() && c.mesh.facets.empty() && c.mesh.edges.empty());
        EXPECT_EQ(c.cell_to_rank, std::vector<int>{0});
    }
}

TEST(Cases, KeepTheirNumbersInRangeAsTheyBecomeSimpler) {
    if (!test::world().is_first()) return;
    for (const Case& c : some_of_both(20)) {
        for (const auto& simpler : simplifications(c)) {
            const Case s = simpler();
            EXPECT_EQ(s.cell_to_rank.size(), s.mesh.cells.size());
            std::vector<Selection> selections{s.selection};
            for (const Step& step : s.steps) selections.push_back(step.selection);
            for (const Selection& selection : selections) {
                for (const GlobalCell cell : selection.cells) {
                    EXPECT_LT(static_cast<std::size_t>(cell), s.mesh.cells.size());
                }
            }
        }
    }
}

TEST(Cases, OfHistoriesBecomeSimplerUntilOnlyStepsAreLeftThatMatter) {
    if (!test::world().is_first()) return;
    const auto is_faulty = [](const Case& c) {
        const auto coarsens = std::ranges::find(c.steps, Action::coarsen, &Step::action);
        return coarsens != c.steps.end() && coarsens->selection.random &&
               std::ranges::find(coarsens, c.steps.end(), Action::refine, &Step::action) !=
                   c.steps.end();
    };
    int tried = 0;
    for (const Case& c : some_histories(60)) {
        if (!is_faulty(c)) continue;
        ++tried;
        const Case s = simplest(
            c, [&](const Case& each) { return is_faulty(each) ? Trial::fails : Trial::holds; });
        EXPECT_EQ(s.mesh.cells.size(), 1U);
        ASSERT_EQ(s.steps.size(), 2U);
        EXPECT_EQ(s.steps[0].action, Action::coarsen);
        EXPECT_EQ(s.steps[1].action, Action::refine);
        EXPECT_EQ(s.steps[1].scheme, Scheme::eight);
        EXPECT_FALSE(s.steps[1].selection.random || s.steps[1].selection.all);
    }
    EXPECT_GT(tried, 5);
}

TEST(Cases, AreReadBackFromFilesBitByBit) {
    if (!test::world().is_first()) return;
    const test::TemporaryFolder folder;
    for (const Case& c : some_of_both(20)) {
        const auto file = write_finding({"closure", "a fault", c}, folder.path(), "one");
        const Finding back = read_finding(file);
        EXPECT_EQ(back.law, "closure");
        EXPECT_EQ(back.refinement.mesh, c.mesh);
        EXPECT_EQ(back.refinement.cell_to_rank, c.cell_to_rank);
        EXPECT_EQ(json_of(back.refinement), json_of(c));
        for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) {
            EXPECT_EQ(is_marked(back.refinement, i), is_marked(c, i));
        }
        remove_finding(folder.path(), "one");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace octetra::properties
