#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/core/selection.hpp>

/// The evaluation of a selection for many cells.
namespace octetra {

/// The properties of a cell that most criteria use.
struct CellToTest {
    Corners corners;
    Marker region = 0;  ///< its region tag, or 0 if the mesh has none
    GlobalCell root{0};
};

/// Values of external terms: a list with a value for each cell for each term.
using TermValues = std::vector<std::vector<double>>;

/// Returns whether the selection has more than the criteria of single cells: expressions, or
/// selections that narrow it.
[[nodiscard]] inline bool is_compound(const Selection& selection) {
    return !selection.where.empty() || !selection.narrowed_by.empty();
}

/// The distance of two points, rounded alike on every machine unless its square over- or
/// underflows.
[[nodiscard]] double length(const Point& a, const Point& b);

/// Returns the value of a quantity that is not external.
[[nodiscard]] double value_of(Quantity quantity, const CellToTest& cell);

/// The criteria but for expressions and `narrowed_by`.
[[nodiscard]] bool marks_by_criteria(const Selection& selection, const Corners& corners,
                                     Marker region, GlobalCell root);

/// Returns all expressions of a selection, in order; valid as long as the selection.
[[nodiscard]] std::vector<const Expression*> expressions_of(const Selection& selection);

/// Returns the external terms that a selection uses, each once.
[[nodiscard]] std::vector<Term> external_terms(const Selection& selection);

/// Returns whether an expression of the selection uses the history of the mesh.
[[nodiscard]] bool uses_history(const Selection& selection);

/// An expression has no value in a cell.
struct UndefinedValue {
    std::size_t cell = 0;
    std::size_t expression = 0;  ///< its position in expressions_of()

    friend auto operator<=>(const UndefinedValue&, const UndefinedValue&) = default;
};

struct SelectedCells {
    std::vector<std::uint8_t> marks;  ///< 1 for each selected cell, else 0
    std::vector<UndefinedValue> undefined;
};

/// Evaluates a selection for `count` cells, of which cell(i) returns number i. `values` are those
/// of external_terms(selection). An expression has no value in a cell if one of its operations has
/// no result there (0/0, sqrt(-1)), or if a value of its terms is not a number.
[[nodiscard]] SelectedCells select_cells(const Selection& selection, std::size_t count,
                                         const std::function<CellToTest(std::size_t)>& cell,
                                         const TermValues& values);

struct EvaluatedCells {
    std::vector<double> values;  ///< of each cell
    std::vector<UndefinedValue> undefined;
};

/// Evaluates an expression likewise; `values` are those of its external terms, which are those of a
/// selection with this expression alone.
[[nodiscard]] EvaluatedCells evaluate(const Expression& expression, std::size_t count,
                                      const std::function<CellToTest(std::size_t)>& cell,
                                      const TermValues& values);

/// Throws InputError: the expression has no value in the cell with this number, as in files.
[[noreturn]] void refuse_undefined(const Selection& selection, std::size_t expression,
                                   std::uint64_t cell_number);

}  // namespace octetra
