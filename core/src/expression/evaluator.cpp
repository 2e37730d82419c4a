#include "expression/evaluator.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <muParser.h>

#include <octetra/core/error.hpp>

namespace octetra::expression {
namespace {

/// `not` binds less tightly than comparisons, and more tightly than `and`.
constexpr int precedence_of_not = mu::prLOGIC;

double negation(double x) { return x == 0 ? 1 : 0; }
double double_negation(double x) { return x == 0 ? 0 : 1; }

}  // namespace

struct Evaluator::Parser {
    mu::Parser parser;
    std::vector<double> values;
};

Evaluator::Evaluator(const Expression& expression) : parser_(std::make_unique<Parser>()) {
    // Cells are evaluated one at a time: the bulk mode of muParser starts OpenMP threads, which
    // compete with the other processes of a machine.
    auto& [parser, values] = *parser_;
    values.resize(expression.terms().size());
    try {
        parser.EnableOptimizer(false);  // it reorders products and sums
        parser.DefineInfixOprt("!", negation, precedence_of_not, false);
        parser.DefineInfixOprt("~", double_negation, precedence_of_not, false);
        parser.DefineFun("atan2", [](double y, double x) { return std::atan2(y, x); });
        parser.DefineFun("ceil", [](double x) { return std::ceil(x); });
        parser.DefineFun("floor", [](double x) { return std::floor(x); });
        parser.DefineFun("hypot", [](double x, double y) { return std::hypot(x, y); });
        parser.DefineFun("log", [](double x) { return std::log(x); });
        for (std::size_t i = 0; i < values.size(); ++i) {
            parser.DefineVar(fmt::format("v{}", i), &values[i]);
        }
        for (std::size_t i = 0; i < expression.numbers().size(); ++i) {
            parser.DefineConst(fmt::format("k{}", i), expression.numbers()[i]);
        }
        parser.SetExpr(expression.translated());
        (void)parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
        throw InputError(fmt::format("{}: {}", expression.text(), error.GetMsg()));
    }
}

Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

std::span<double> Evaluator::values() { return parser_->values; }

double Evaluator::operator()() const { return parser_->parser.Eval(); }

}  // namespace octetra::expression
