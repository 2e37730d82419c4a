#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/core/select_cells.hpp>

#include "fuzz/check_readers.hpp"

namespace octetra::test {
namespace {

/// Throws BrokenPromise unless the message is one line, or three: the second one shows the input,
/// or the argument of graded() in it, the third one a caret.
void check_refusal(const std::string& message, std::string_view input) {
    const auto fail = [&] { throw BrokenPromise("unfit for a message: " + message); };
    const auto is_control = [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f; };
    if (message.empty() || std::ranges::any_of(message, is_control)) fail();
    const std::size_t first = message.find('\n');
    if (first == std::string::npos) return;
    const std::size_t second = message.find('\n', first + 1);
    if (second == std::string::npos || second > first + 3 + input.size()) fail();
    const std::string caret = message.substr(second + 1);
    if (caret.size() < 3 || caret.find_first_not_of(' ') != caret.size() - 1) fail();
    if (caret.back() != '^' || caret.size() > input.size() + 3) fail();
}

void check_values(const Expression& expression) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 7> likely{0, 1, -2.5, 1e300, 5e-324, infinity, -infinity};
    const Selection selection{.where = {expression}};
    const auto cell = [&](std::size_t number) {
        const double size = std::max(likely[number % 5], 1e-300);
        return CellToTest{{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}}, -3, {}};
    };
    TermValues values;
    for (const Term& term : external_terms(selection)) {
        if (text_of(term).empty()) throw BrokenPromise("a term has no text");
        auto& list = values.emplace_back(likely.begin(), likely.end());
        std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(values.size() % 7),
                    list.end());
    }
    const EvaluatedCells found = evaluate(expression, likely.size(), cell, values);
    const SelectedCells selected = select_cells(selection, likely.size(), cell, values);
    if (found.undefined != selected.undefined) {
        throw BrokenPromise("a value and a mark are undefined in other cells");
    }
    for (std::size_t c = 0; c < likely.size(); ++c) {
        const auto is_of_cell = [&](const UndefinedValue& undefined) {
            return undefined.cell == c;
        };
        if (std::isnan(found.values[c]) && std::ranges::none_of(found.undefined, is_of_cell)) {
            throw BrokenPromise("a value that is no number is not reported");
        }
        if ((found.values[c] != 0) != (selected.marks[c] != 0)) {
            throw BrokenPromise("a cell is marked although the value is 0, or the reverse");
        }
    }
}

}  // namespace

void check_expression(std::string_view input, const std::filesystem::path& /*folder*/) {
    try {
        const Expression expression(input);
        if (expression.text() != input) throw BrokenPromise("an expression has another text");
        check_values(expression);
    } catch (const InputError& error) {
        check_refusal(error.what(), input);
    }
}

}  // namespace octetra::test
