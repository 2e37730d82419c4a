#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/core/shape.hpp>

#include "support/thrown.hpp"

namespace octetra {
namespace {

const Corners unit{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};  // centroid (1, 1, 1)

Selection where(const std::string& text) { return {.where = {Expression(text)}}; }

bool is_true(const std::string& text, const Corners& corners = unit, Marker region = 0) {
    return marks(where(text), corners, region, GlobalCell{0});
}

std::string refused(const std::string& text) {
    return test::thrown_by<InputError>([&] { Expression{text}; });
}

Corners random_corners(std::mt19937_64& random) {
    std::uniform_real_distribution<double> place(-2, 2);
    Corners corners;
    for (Point& p : corners) p = {place(random), place(random), place(random)};
    return corners;
}

TEST(Expression, HasTheUsualPrecedence) {
    for (const char* text : {"2 + 3 * 4 == 14",
                             "(2 + 3) * 4 == 20",
                             "10 - 4 - 3 == 3",
                             "16 / 4 / 2 == 2",
                             "2 ^ 3 ^ 2 == 512",
                             "-2 ^ 2 == -4",
                             "2 * -3 == -6",
                             "2 ^ -1 == 0.5",
                             "1 - -1 == 2",
                             "1 < 2 and 2 < 3",
                             "not 1 < 0",
                             "not 0 and 1",
                             "not (0 or 1) == 0",
                             "1 or 0 and 0",
                             "not not 1",
                             "not not not 0",
                             "not -x > 0",
                             "not --x < 0",
                             "(not not 2) == 1",
                             "x - --1 == 0",
                             "1 + 1 > 1 and not 2 * 2 < 4",
                             "1 && 1 || 0",
                             "3 >= 3 and 3 <= 3",
                             "3 != 4",
                             "1e-2 == .01",
                             "max(1, 2, 3) == 3 and min(1, 2) == 1",
                             "abs(-2) == 2",
                             "hypot(3, 4) == 5",
                             "floor(1.5) == 1 and ceil(1.5) == 2",
                             "sqrt(16) == 4",
                             "log(exp(0)) == 0 and log10(1000) == 3",
                             "atan2(0, 1) == 0",
                             "sin(0) == 0 and cos(0) == 1"}) {
        EXPECT_TRUE(is_true(text)) << text;
    }
    for (const char* text :
         {"0", "1 < 0", "not 1", "not 0 and 0", "(1 or 0) and 0", "not not 0", "2 == 3"}) {
        EXPECT_FALSE(is_true(text)) << text;
    }
}

TEST(Expression, IsRefusedAtTheColumnOfTheError) {
    EXPECT_EQ(refused("x <"),
              "column 4: a number or variable is missing at the end\n  x <\n     ^");
    const std::vector<std::array<std::string, 2>> cases{
        {"lenght > 1", "column 1: there is no variable lenght; there are x, y, z, volume"},
        {"x > wall(1)", "column 5: there is no function wall; there are distance, background"},
        {"x(1) > 2", "column 1: there is no function x;"},
        {"sqrt > 2", "column 1: sqrt takes arguments in parentheses"},
        {"x = 1", "column 3: = assigns; a comparison for equality is =="},
        {"!x", "column 1: the word for ! is not"},
        {"x =< 1", "column 3: write <= in place of =<"},
        {"x => 1", "column 3: write >= in place of =>"},
        {"x <> 1", "column 3: write != in place of <>"},
        {"x ** 2 > 1", "column 3: write ^ in place of **"},
        {"x > 1 AND y > 1", "column 7: write and in lower case"},
        {"x > 1 Or y > 1", "column 7: write or in lower case"},
        {"NOT x", "column 1: write not in lower case"},
        {"NOT (x)", "column 1: write not in lower case"},
        {"x ? 1 : 0", "column 3: the character ? has no meaning here"},
        {"0 < x < 1", "column 7: comparisons cannot be chained"},
        {"x + not y", "column 5: not applies to a comparison"},
        {"2 x", "column 3: an operator is missing before this"},
        {"2x", "column 2: a number ends here"},
        {"1.2.3", "column 4: a number ends here"},
        {"x * * y", "column 5: a number or variable is missing before this"},
        {"(x < 1", "column 1: this parenthesis is not closed"},
        {"x < 1)", "column 6: this parenthesis closes none"},
        {"x, y", "column 2: this comma separates no arguments"},
        {"()", "column 2: a number or variable is missing before this"},
        {"sqrt(1, 2)", "column 10: sqrt takes 1 argument, not 2"},
        {"atan2(1)", "column 8: atan2 takes 2 arguments, not 1"},
        {"min(1)", "column 6: min takes 2 or more arguments, not 1"},
        {"1e999 < x", "column 1: the number is out of range"},
        {"distance", "column 9: distance takes its arguments in parentheses"},
        {"distance()", "column 10: distance takes a marker or the name of a group"},
        {"field(1)", "column 7: field takes the name of a field"},
        {"field(u, 2)", "column 8: field has more arguments than it takes, or is not closed"},
        {"field(\"u)", "column 7: the closing quotation mark is missing"},
        {"bulk(u)", "column 7: bulk takes the name of a field and a number"},
        {"bulk(u, 2)", "column 9: bulk takes a number above 0, at most 1"},
        {"fraction(u, 0)", "column 13: fraction takes a number above 0, at most 1"},
        {"field(\u00fc) > 1 1", "column 14: an operator is missing before this"},
    };
    for (const auto& [text, message] : cases) {
        EXPECT_THAT(refused(text), testing::StartsWith(message)) << text;
    }
    EXPECT_THAT(refused("sol_1 > 0.5"),
                testing::HasSubstr("generation, boundary, and field(sol_1) for a field of this"));
    EXPECT_EQ(refused(""), "the expression is empty");
    EXPECT_EQ(refused(" \t"), "the expression is empty");
    EXPECT_EQ(Expression("field(AND) > distance(NOT)").terms().size(), 2U);
    EXPECT_EQ(refused("x\n< 1"), "there is a control character in the expression");
}

TEST(Expression, OfAnyLengthAndNestingIsReadOrRefused) {
    const auto repeated = [](const std::string& what, std::size_t times) {
        std::string text;
        for (std::size_t i = 0; i < times; ++i) text += what;
        return text;
    };
    const std::size_t deepest = Expression::deepest_nesting;
    EXPECT_TRUE(is_true(repeated("(", deepest) + "1" + repeated(")", deepest)));
    EXPECT_THAT(refused(repeated("(", deepest + 1) + "1" + repeated(")", deepest + 1)),
                testing::StartsWith("column 61: more than 60 parentheses are nested"));
    EXPECT_EQ(refused(repeated(" ", 4001)),
              "the expression has 4001 bytes, more than the 4000 allowed");
    EXPECT_TRUE(is_true("x < 1." + repeated("3", 3000)));
    EXPECT_TRUE(is_true(repeated("not ", 998) + "x"));
    EXPECT_TRUE(is_true(repeated("-", 2000) + "x == 1"));
    EXPECT_TRUE(is_true(repeated("x + ", 990) + "x == 991"));
    EXPECT_TRUE(is_true(repeated("1 ^ ", 990) + "1 == 1"));
    EXPECT_TRUE(is_true("max(" + repeated("x, ", 1000) + "2) == 2"));
}

TEST(Expression, OfRandomWordsIsRefusedOrEvaluated) {
    const std::vector<std::string> words{
        "x", "region", "1", "2.5", "1e3", "(",  ")",   "(",   ")", ",",   "+",    "-",
        "*", "^",      "<", "==",  "and", "or", "not", "not", "-", "max", "sqrt", "abs"};
    std::mt19937_64 random(3);
    int accepted = 0;
    for (int i = 0; i < 200000; ++i) {
        std::string text;
        for (std::size_t k = 1 + random() % 9; k > 0; --k) {
            text += words[random() % words.size()] + (random() % 2 == 0 ? " " : "");
        }
        std::optional<Expression> expression;
        try {
            expression.emplace(text);
        } catch (const InputError& error) {
            ASSERT_THAT(error.what(), testing::StartsWith("column ")) << text;
            continue;
        }
        ++accepted;
        const auto cell = [](std::size_t) { return CellToTest{unit, 0, GlobalCell{0}}; };
        const Selection selection{.where = {*expression}};
        ASSERT_NO_THROW((void)select_cells(selection, 1, cell, {})) << text;
    }
    EXPECT_GT(accepted, 1000);
}

struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Expression, DoesNotDependOnTheLocale) {
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
    EXPECT_TRUE(is_true("1234.5 > 1234.25 and 1234.5 < 1e4"));
    std::locale::global(before);
}

TEST(Expression, HasTheVariablesOfACell) {
    EXPECT_TRUE(is_true("x == 1 and y == 1 and z == 1"));
    EXPECT_TRUE(is_true("abs(volume - 64 / 6) < 1e-12"));
    EXPECT_TRUE(is_true("longest == sqrt(32) and shortest == 4"));
    EXPECT_TRUE(is_true("region == -7", unit, -7));
    EXPECT_TRUE(is_true("abs(max_dihedral - 90) < 1e-12"));
    EXPECT_TRUE(is_true("abs(min_dihedral - 54.735610317245346) < 1e-12"));  // acos(1 / sqrt(3))
    const double half = 0.5 / std::sqrt(2.0);
    const Corners regular{
        {{half, half, half}, {half, -half, -half}, {-half, half, -half}, {-half, -half, half}}};
    EXPECT_TRUE(is_true("abs(eta - 1) < 1e-12 and abs(longest - shortest) < 1e-12", regular));
}

TEST(Expression, DoesNotDependOnTheOrderOfTheCorners) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20; ++i) {
        Corners corners = random_corners(random);
        std::ranges::sort(corners);
        for (const char* name : {"x", "y", "z", "volume", "longest", "shortest", "eta",
                                 "min_dihedral", "max_dihedral"}) {
            // The value lies in [low, high), with no number in between.
            double low = -1e3;
            double high = 1e3;
            for (double middle = 1; low < middle && middle < high;
                 middle = low + (high - low) / 2) {
                const bool is_less = is_true(fmt::format("{} < {}", name, middle), corners);
                (is_less ? high : low) = middle;
            }
            const std::string text = fmt::format("{} < {} or {} >= {}", name, low, name, high);
            Corners permuted = corners;
            while (std::ranges::next_permutation(permuted).found) {
                ASSERT_FALSE(is_true(text, permuted)) << text;
            }
        }
    }
}

TEST(Expression, CombinesAsSetsDo) {
    std::mt19937_64 random(2);
    const std::vector<std::string> parts{"x < 0.3",      "longest > 1.5",       "eta < 0.4",
                                         "region == 2",  "volume > shortest/4", "y * z > 0.1",
                                         "max(x, y) < 0"};
    for (int i = 0; i < 2000; ++i) {
        const std::string& a = parts[random() % parts.size()];
        const std::string& b = parts[random() % parts.size()];
        const Corners cell = random_corners(random);
        const Marker region = static_cast<Marker>(random() % 3);
        const auto holds = [&](const std::string& text) { return is_true(text, cell, region); };
        EXPECT_EQ(holds(a + " and " + b), holds(a) && holds(b));
        EXPECT_EQ(holds(a + " or " + b), holds(a) || holds(b));
        EXPECT_EQ(holds("not " + a), !holds(a));
        EXPECT_EQ(holds("not (" + a + " or " + b + ")"), holds("not " + a + " and not " + b));
        const Selection either{.where = {Expression(a), Expression(b)}};
        const Selection both{.where = {Expression(a)}, .narrowed_by = {where(b)}};
        EXPECT_EQ(marks(either, cell, region, GlobalCell{0}), holds(a) || holds(b));
        EXPECT_EQ(marks(both, cell, region, GlobalCell{0}), holds(a) && holds(b));
        const Selection narrowed{.regions = {1}, .narrowed_by = {where(b), {.regions = {1, 2}}}};
        EXPECT_EQ(marks(narrowed, cell, region, GlobalCell{0}), region == 1 && holds(b));
    }
}

TEST(Expression, HasNoValueWhereAnOperationHasNone) {
    const auto undefined_in = [](const std::string& text) {
        const Selection selection = where(text);
        const auto cell = [](std::size_t i) {
            CellToTest test{unit, 0, GlobalCell{0}};
            for (Point& p : test.corners) p.x += static_cast<double>(i) - 501;  // x is i - 500
            return test;
        };
        std::vector<std::size_t> cells;
        for (const auto& [number, expression] : select_cells(selection, 1000, cell, {}).undefined) {
            cells.push_back(number);
        }
        return cells;
    };
    using testing::ElementsAre;
    EXPECT_THAT(undefined_in("sqrt(x + 497) < 1"), ElementsAre(0, 1, 2));
    EXPECT_THAT(undefined_in("x / x == 1"), ElementsAre(500));
    EXPECT_THAT(undefined_in("not log(x + 499) > 0"), ElementsAre(0));
    EXPECT_THAT(undefined_in("x > 0 and log(498 - x) > 0"), ElementsAre(999));
    EXPECT_THAT(undefined_in("1 / x > 0"), ElementsAre());  // infinite
    EXPECT_EQ(undefined_in("0 / 0").size(), 1000);
    EXPECT_EQ(test::thrown_by<InputError>([&] { (void)is_true("sqrt(-x)"); }),
              "sqrt(-x): the expression has no value in a cell");
}

TEST(Expression, ContainsGradedExpressions) {
    const Expression expression("longest > 2 * graded( max(x, field(h)) + 1 , 1.25) and x < 1");
    EXPECT_THAT(expression.terms(),
                testing::ElementsAre(Term{Quantity::longest, "", 0},
                                     Term{Quantity::graded, "max(x, field(h)) + 1", 1.25},
                                     Term{Quantity::x, "", 0}));
    EXPECT_EQ(text_of(expression.terms()[1]), "graded(max(x, field(h)) + 1, 1.25)");
    EXPECT_TRUE(uses_history(where("x > graded(generation / 2, 2)")));
    EXPECT_FALSE(uses_history(where("x > graded(x / 2, 2)")));
    const auto refused = [](const std::string& text) {
        return test::thrown_by<InputError>([&] { (void)Expression(text); });
    };
    const std::string wanted = "graded takes an expression and a number above 1";
    for (const std::string text :
         {"graded", "graded()", "graded(x)", "graded(x, 1)", "graded(x, y)", "graded(, 2)",
          "graded(x, 1.5 + 1)", "graded(max(x, 2))", "graded(x, 2"}) {
        EXPECT_THAT(refused(text), testing::HasSubstr(wanted)) << text;
    }
    EXPECT_THAT(refused("graded(x, 2, 3)"),
                testing::HasSubstr("this comma separates no arguments"));
    EXPECT_THAT(refused("graded(graded(x, 2), 2)"),
                testing::HasSubstr("graded cannot contain graded"));
    EXPECT_THAT(refused("graded(x +, 2)"), testing::HasSubstr("is missing"));
}

TEST(Expression, OfAMeshNeedsTheMesh) {
    EXPECT_EQ(test::thrown_by<InputError>([&] { (void)is_true("x < 2 and distance(wall) < 1"); }),
              "distance(wall) cannot be evaluated here, where only the corners and the region tag "
              "of each cell are known");
    EXPECT_THAT(
        external_terms(where("field(u) > 0 and field(\"u\") < 3 and bulk(u, 0.5)")),
        testing::ElementsAre(Term{Quantity::field, "u", 0}, Term{Quantity::bulk, "u", 0.5}));
    EXPECT_THAT(external_terms(where("distance(-3) < x")),
                testing::ElementsAre(Term{Quantity::distance, "-3", 0}));
}

}  // namespace
}  // namespace octetra
