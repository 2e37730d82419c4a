#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Expressions over the quantities of a cell: the language of `--where`, docs/cli.md.
namespace octetra {

/// A quantity of a cell that an expression may use.
enum class Quantity : std::uint8_t {
    // of the corners
    x,
    y,
    z,
    volume,
    longest,
    shortest,
    eta,
    min_dihedral,
    max_dihedral,
    // of the region tag
    region,
    // of the mesh around the cell; see is_external()
    generation,
    boundary,
    distance,    ///< to the tagged facets with the marker or group name `name`
    background,  ///< the value of the field `name` of a background mesh at the centroid
    graded,      ///< the value of the expression `name`, growing by at most `share` - 1 per length
    field,       ///< the value, or the mean over the corners, of the field `name`
    field_max,   ///< likewise, with the maximum over the corners
    metric_longest,  ///< the length of the longest edge in the metric `name`
    size,            ///< the length that the field or metric `name` allows an edge
    bulk,      ///< 1 if bulk marking of the field `name` with the fraction `share` marks the cell
    fraction,  ///< 1 if the cell is in the fraction `share` with the largest values of `name`
};

/// A quantity with its arguments.
struct Term {
    Quantity quantity = Quantity::x;
    std::string name;  ///< of a field, marker or group; the text of the expression of graded()
    double share = 0;  ///< the second argument of graded(), bulk() and fraction()

    friend bool operator==(const Term&, const Term&) = default;
};

/// Returns whether the quantity follows from more than the corners and region tag of the cell: its
/// values are computed for all cells of a mesh together.
[[nodiscard]] constexpr bool is_external(Quantity quantity) {
    return quantity >= Quantity::generation;
}
/// Returns whether the quantity needs the values of a field.
[[nodiscard]] constexpr bool needs_field(Quantity quantity) { return quantity >= Quantity::field; }
/// Returns the term as it is written: "distance(wall)".
[[nodiscard]] std::string text_of(const Term& term);

/// An expression whose syntax and names have been checked. A value: it has no state that evaluation
/// changes.
class Expression {
public:
    static constexpr std::size_t longest_text = 4000;  ///< bytes
    static constexpr std::size_t deepest_nesting = 60;

    /// Throws InputError, whose message contains the text and a caret below the column of the
    /// error, if the text is no expression, longer than longest_text or nested more deeply than
    /// deepest_nesting. Independent of the locale.
    explicit Expression(std::string_view text);

    [[nodiscard]] const std::string& text() const { return text_; }
    /// The terms that the expression uses, each once, in the order of their first use.
    [[nodiscard]] std::span<const Term> terms() const { return terms_; }

    // For evaluation: the expression in the syntax of muParser, in which term i is the variable
    // v<i>, and number i the constant k<i>.
    [[nodiscard]] const std::string& translated() const { return translated_; }
    [[nodiscard]] std::span<const double> numbers() const { return numbers_; }

private:
    std::string text_;
    std::vector<Term> terms_;
    std::vector<double> numbers_;
    std::string translated_;
};

}  // namespace octetra
