#pragma once

#include <memory>
#include <span>

#include <octetra/core/expression.hpp>

namespace octetra::expression {

/// Evaluates an expression for one cell after another.
class Evaluator {
public:
    explicit Evaluator(const Expression& expression);
    ~Evaluator();
    Evaluator(Evaluator&&) noexcept;
    Evaluator& operator=(Evaluator&&) noexcept;
    Evaluator(const Evaluator&) = delete;
    Evaluator& operator=(const Evaluator&) = delete;

    /// The values of the terms of the expression, to be set before it is evaluated.
    [[nodiscard]] std::span<double> values();
    /// Each operation is rounded as it is written, none is contracted or reordered. An operation
    /// without a result, such as 0/0, raises FE_INVALID.
    [[nodiscard]] double operator()() const;

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace octetra::expression
