#include <octetra/core/select_cells.hpp>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/shape.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "expression/evaluator.hpp"

namespace octetra {
namespace {

using expression::Evaluator;

/// Cells that are evaluated together: their values stay in the cache.
constexpr std::size_t block_size = 256;

struct Block {
    std::size_t begin = 0;
    std::size_t count = 0;
    std::array<CellToTest, block_size> cells;
};

double greatest_length(const Corners& corners) {
    double greatest = 0;
    for (const auto& [i, j] : cell_edges) {
        greatest = std::max(greatest, length(corners[i], corners[j]));
    }
    return greatest;
}

double least_length(const Corners& corners) {
    double least = length(corners[0], corners[1]);
    for (const auto& [i, j] : cell_edges) least = std::min(least, length(corners[i], corners[j]));
    return least;
}

/// An expression of a selection, and where the values of its terms are.
class Test {
public:
    /// `external` and `values`: all external terms of the selection.
    Test(const Expression& expression, std::size_t number, std::span<const Term> external,
         const TermValues& values)
        : number_(number), evaluator_(expression), terms_(expression.terms()) {
        for (const Term& term : terms_) {
            if (!is_external(term.quantity)) {
                lists_.push_back(nullptr);
                continue;
            }
            const auto place =
                static_cast<std::size_t>(std::ranges::find(external, term) - external.begin());
            if (place >= values.size()) {
                throw InputError(fmt::format(
                    "{} cannot be evaluated here, where only the corners and the region tag of "
                    "each cell are known",
                    text_of(term)));
            }
            lists_.push_back(&values[place]);
        }
        columns_.resize(terms_.size());
    }

    /// Calls take(i, value) for each cell of the block.
    void evaluate(const Block& block, std::vector<UndefinedValue>& undefined, auto&& take) {
        fill_columns(block);
        std::feclearexcept(FE_INVALID);
        bool is_nan = false;
        for (std::size_t i = 0; i < block.count; ++i) {
            const double value = value_in(i);
            is_nan |= std::isnan(value);
            take(i, value);
        }
        if (is_nan || has_nan_ || std::fetestexcept(FE_INVALID) != 0)
            find_undefined(block, undefined);
    }

private:
    void fill_columns(const Block& block) {
        has_nan_ = false;
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            for (std::size_t i = 0; i < block.count; ++i) {
                columns_[t][i] = lists_[t] == nullptr ? value_of(terms_[t].quantity, block.cells[i])
                                                      : (*lists_[t])[block.begin + i];
                has_nan_ |= std::isnan(columns_[t][i]);
            }
        }
    }

    [[nodiscard]] double value_in(std::size_t i) {
        const std::span<double> values = evaluator_.values();
        for (std::size_t t = 0; t < values.size(); ++t) values[t] = columns_[t][i];
        return evaluator_();
    }

    void find_undefined(const Block& block, std::vector<UndefinedValue>& undefined) {
        for (std::size_t i = 0; i < block.count; ++i) {
            std::feclearexcept(FE_INVALID);
            const bool is_undefined =
                std::isnan(value_in(i)) || std::fetestexcept(FE_INVALID) != 0 ||
                std::ranges::any_of(columns_, [&](const auto& c) { return std::isnan(c[i]); });
            if (is_undefined) undefined.push_back({block.begin + i, number_});
        }
    }

    std::size_t number_;
    Evaluator evaluator_;
    std::span<const Term> terms_;
    std::vector<const std::vector<double>*> lists_;        ///< of external terms; null for others
    std::vector<std::array<double, block_size>> columns_;  ///< the values of each term
    bool has_nan_ = false;
};

/// Criteria of which one must mark a cell.
struct Group {
    const Selection* criteria;
    std::vector<Test> tests;

    void mark(const Block& block, std::span<std::uint8_t> marks,
              std::vector<UndefinedValue>& undefined) {
        for (std::size_t i = 0; i < block.count; ++i) {
            const auto& [corners, region, root] = block.cells[i];
            marks[i] = marks_by_criteria(*criteria, corners, region, root) ? 1 : 0;
        }
        for (Test& test : tests) {
            test.evaluate(block, undefined, [&](std::size_t i, double value) {
                if (value != 0) marks[i] = 1;
            });
        }
    }
};

/// Calls work(block) for blocks of all cells.
void for_each_block(std::size_t count, const std::function<CellToTest(std::size_t)>& cell,
                    auto&& work) {
    Block block;
    for (block.begin = 0; block.begin < count; block.begin += block_size) {
        block.count = std::min(block_size, count - block.begin);
        for (std::size_t i = 0; i < block.count; ++i) block.cells[i] = cell(block.begin + i);
        work(block);
    }
}

/// Returns the external terms that expressions use, each once.
std::vector<Term> external_terms_of(std::span<const Expression* const> expressions) {
    std::vector<Term> terms;
    for (const Expression* expression : expressions) {
        for (const Term& term : expression->terms()) {
            if (!is_external(term.quantity)) continue;
            if (std::ranges::find(terms, term) == terms.end()) terms.push_back(term);
        }
    }
    return terms;
}

bool uses_generation(std::span<const Term> terms) {
    return std::ranges::any_of(terms, [](const Term& term) {
        return term.quantity == Quantity::generation ||
               (term.quantity == Quantity::graded &&
                uses_generation(Expression(term.name).terms()));
    });
}

std::vector<const Selection*> groups_of(const Selection& selection) {
    std::vector<const Selection*> groups{&selection};
    for (const Selection& other : selection.narrowed_by) {
        const auto more = groups_of(other);
        groups.insert(groups.end(), more.begin(), more.end());
    }
    return groups;
}

}  // namespace

double length(const Point& a, const Point& b) {
    // The squared length is rounded alike everywhere, std::hypot() perhaps not.
    const double squared = squared_length({a, b});
    return is_sure_square(squared) ? std::sqrt(squared) : distance(a, b);
}

double value_of(Quantity quantity, const CellToTest& cell) {
    // The order of the corners must not affect the rounding.
    const auto in_order = [&] {
        Corners corners = cell.corners;
        std::ranges::sort(corners);
        return corners;
    };
    switch (quantity) {
        case Quantity::x: return centroid(cell.corners).x;
        case Quantity::y: return centroid(cell.corners).y;
        case Quantity::z: return centroid(cell.corners).z;
        case Quantity::volume: return volume(cell.corners);
        case Quantity::longest: return greatest_length(cell.corners);
        case Quantity::shortest: return least_length(cell.corners);
        case Quantity::eta: return mean_ratio(in_order());
        case Quantity::min_dihedral: return std::ranges::min(dihedral_angles(in_order()));
        case Quantity::max_dihedral: return std::ranges::max(dihedral_angles(in_order()));
        case Quantity::region: return cell.region;
        default: return 0;
    }
}

std::vector<const Expression*> expressions_of(const Selection& selection) {
    std::vector<const Expression*> expressions;
    for (const Selection* group : groups_of(selection)) {
        for (const Expression& expression : group->where) expressions.push_back(&expression);
    }
    return expressions;
}

std::vector<Term> external_terms(const Selection& selection) {
    return external_terms_of(expressions_of(selection));
}

bool uses_history(const Selection& selection) { return uses_generation(external_terms(selection)); }

EvaluatedCells evaluate(const Expression& expression, std::size_t count,
                        const std::function<CellToTest(std::size_t)>& cell,
                        const TermValues& values) {
    const StandardArithmetic standard;
    const std::vector<Term> external = external_terms_of(std::array{&expression});
    Test test(expression, 0, external, values);
    EvaluatedCells evaluated;
    evaluated.values.reserve(count);
    for_each_block(count, cell, [&](const Block& block) {
        test.evaluate(block, evaluated.undefined,
                      [&](std::size_t, double value) { evaluated.values.push_back(value); });
    });
    return evaluated;
}

SelectedCells select_cells(const Selection& selection, std::size_t count,
                           const std::function<CellToTest(std::size_t)>& cell,
                           const TermValues& values) {
    const StandardArithmetic standard;
    const std::vector<Term> external = external_terms(selection);
    std::vector<Group> groups;
    std::size_t expressions = 0;
    for (const Selection* criteria : groups_of(selection)) {
        Group& group = groups.emplace_back(Group{criteria, {}});
        for (const Expression& expression : criteria->where) {
            group.tests.emplace_back(expression, expressions++, external, values);
        }
    }
    SelectedCells selected{std::vector<std::uint8_t>(count, 1), {}};
    std::array<std::uint8_t, block_size> marked{};
    for_each_block(count, cell, [&](const Block& block) {
        for (Group& group : groups) {
            group.mark(block, marked, selected.undefined);
            for (std::size_t i = 0; i < block.count; ++i)
                selected.marks[block.begin + i] &= marked[i];
        }
    });
    return selected;
}

void refuse_undefined(const Selection& selection, std::size_t expression,
                      std::uint64_t cell_number) {
    throw InputError(fmt::format("the expression has no value in cell {}: {}", cell_number,
                                 expressions_of(selection)[expression]->text()));
}

}  // namespace octetra
