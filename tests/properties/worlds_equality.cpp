#include "properties/worlds_equality.hpp"

#include <gtest/gtest.h>

#include "distributed/world.hpp"
#include "properties/case_files.hpp"
#include "properties/judge.hpp"
#include "properties/report.hpp"
#include "properties/small_worlds.hpp"

namespace octetra::properties {

void expect_equality(const Case& c) {
    const std::string fault = judge(law_named("equality"), c);
    if (fault.empty()) return;
    const Finding finding{"equality", fault, c, test::world().size()};
    FAIL() << kept(shrunk(finding), found_folder());
}

void expect_equality_of_all(const std::string& kind, const std::vector<Mesh>& worlds,
                            const std::vector<unsigned>& choices) {
    const std::size_t cells = worlds.front().cells.size();
    Case c{.kind = kind, .mesh = side_by_side(worlds, 0x1p23)};
    for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
        c.cell_to_rank.push_back(static_cast<int>(i % cells));
    }
    for (const unsigned choice : choices) {
        c.selection.cells.clear();
        for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
            if ((choice >> (i % cells) & 1U) != 0) c.selection.cells.push_back(GlobalCell{i});
        }
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            c.scheme = scheme;
            expect_equality(c);
            if (testing::Test::HasFailure()) return;
        }
    }
}

std::vector<unsigned> all_choices(std::size_t cells) {
    std::vector<unsigned> choices;
    for (unsigned choice = 1; choice < 1U << cells; ++choice) choices.push_back(choice);
    return choices;
}

}  // namespace octetra::properties
