#include <cstdlib>
#include <iostream>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "distributed/world.hpp"
#include "properties/draw_case.hpp"
#include "properties/histories/draw_history.hpp"
#include "properties/judge.hpp"
#include "properties/report.hpp"
#include "properties/simpler.hpp"
#include "properties/team.hpp"

/// Each law is tested on random cases. RC_PARAMS="seed=..." repeats a run on as many ranks,
/// RC_PARAMS="max_success=..." sets the number of cases. A case that breaks a law is shrunk and
/// written to disk, and the command that replays it is printed.
namespace octetra::properties {

/// Used by rapidcheck to print a case.
static void showValue(const Case& c, std::ostream& out) { out << c.kind << ": " << size_of(c); }

/// Used by GoogleTest.
static void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

namespace {

rc::Shrinkable<Case> shrinkable(Case c) {
    return rc::shrinkable::shrinkRecur(std::move(c), [](const Case& from) {
        return rc::seq::map(rc::seq::fromContainer(simplifications(from)),
                            [](const std::function<Case()>& simpler) { return simpler(); });
    });
}

/// The cases of a list of laws.
struct Cases {
    Case (*draw)(Draw& draw, int size, int ranks, bool exact);
    std::vector<std::string> (*tags)(const Case& c, int ranks);
};

/// Each law gets different cases.
rc::Gen<Case> drawn(const Cases& cases, const Law& law) {
    return {[&](const rc::Random& random, int size) {
        Draw draw(rc::Random(random).next() ^ std::hash<std::string>{}(law.name));
        return shrinkable(cases.draw(draw, size, test::world().size(), law.exact));
    }};
}

/// Counts the cases that have each tag.
class Census {
public:
    void count(const std::vector<std::string>& tags) {
        ++cases_;
        for (const std::string& tag : tags) ++counts_[tag];
    }
    void print() const {
        std::cerr << "  " << cases_ << " cases";
        for (const auto& [tag, count] : counts_) {
            std::cerr << ", " << tag << ' ' << 100 * count / cases_ << " %";
        }
        std::cerr << '\n';
    }

private:
    std::size_t cases_ = 0;
    std::map<std::string, std::size_t> counts_;
};

void check(const Law& law, const Cases& cases) {
    Census census;
    Finding smallest;  // rapidcheck continues from each case that fails, so this is the last one
    const bool holds = rc::check(law.name, [&] {
        const Case c = *drawn(cases, law);
        if (smallest.fault.empty()) census.count(cases.tags(c, test::world().size()));
        const std::string fault = judge(law, c);
        if (fault.empty()) return;
        smallest = {law.name, fault, c, test::world().size()};
        RC_FAIL(fault);
    });
    census.print();
    if (holds) return;
    if (smallest.fault.empty()) {
        FAIL() << law.name << ": no cases could be drawn";
    }
    FAIL() << kept(smallest, found_folder());
}

class Laws : public testing::TestWithParam<Law> {
protected:
    static void check_of(const Cases& cases, const char* parameters) {
        ::setenv("RC_PARAMS", parameters, 0);  // what the user has set stays
        run_on_first_rank([&] { check(GetParam(), cases); });
    }
};

TEST_P(Laws, HoldOfRandomCases) {
    check_of({draw_case, tags_of}, "max_success=" OCTETRA_SUCCESSES);
}

INSTANTIATE_TEST_SUITE_P(, Laws, testing::ValuesIn(laws()),
                         [](const auto& law) { return law.param.name; });

class HistoryLaws : public Laws {};

TEST_P(HistoryLaws, HoldOfRandomHistories) {
    check_of({draw_history, tags_of_history}, "max_success=" OCTETRA_HISTORY_SUCCESSES);
}

INSTANTIATE_TEST_SUITE_P(, HistoryLaws, testing::ValuesIn(history_laws()),
                         [](const auto& law) { return law.param.name; });

}  // namespace
}  // namespace octetra::properties
