#include <octetra/core/expression.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <octetra/core/error.hpp>

#include "expression/functions.hpp"
#include "expression/tokens.hpp"

namespace octetra {
namespace {

using expression::Function;
using expression::functions;
using expression::Token;
using expression::TokenKind;

struct QuantityName {
    std::string_view name;
    Quantity quantity;
};

constexpr std::array<QuantityName, 12> variables{{{"x", Quantity::x},
                                                  {"y", Quantity::y},
                                                  {"z", Quantity::z},
                                                  {"volume", Quantity::volume},
                                                  {"longest", Quantity::longest},
                                                  {"shortest", Quantity::shortest},
                                                  {"eta", Quantity::eta},
                                                  {"min_dihedral", Quantity::min_dihedral},
                                                  {"max_dihedral", Quantity::max_dihedral},
                                                  {"region", Quantity::region},
                                                  {"generation", Quantity::generation},
                                                  {"boundary", Quantity::boundary}}};

/// Quantities with arguments: a name, and for the last two a number.
constexpr std::array<QuantityName, 9> named_quantities{
    {{"distance", Quantity::distance},
     {"background", Quantity::background},
     {"graded", Quantity::graded},
     {"field", Quantity::field},
     {"field_max", Quantity::field_max},
     {"metric_longest", Quantity::metric_longest},
     {"size", Quantity::size},
     {"bulk", Quantity::bulk},
     {"fraction", Quantity::fraction}}};

bool takes_share(Quantity quantity) {
    return quantity == Quantity::graded || quantity >= Quantity::bulk;
}

const QuantityName* find_name(const auto& names, std::string_view name) {
    const auto* const found = std::ranges::find(names, name, &QuantityName::name);
    return found == names.end() ? nullptr : found;
}

/// Returns the names of the variables, or of the functions, that can be used.
std::string known_names(bool of_functions) {
    std::vector<std::string_view> names;
    const auto add = [&](const auto& list) {
        for (const auto& entry : list) names.push_back(entry.name);
    };
    if (of_functions) {
        add(named_quantities);
        add(functions);
    } else {
        add(variables);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns a hint for a word that is `and`, `or` or `not` but for upper case, otherwise nothing.
std::string hint_of_word(std::string_view word) {
    std::string lower(word);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    const bool is_operator = lower == "and" || lower == "or" || lower == "not";
    return is_operator ? fmt::format("write {} in lower case", lower) : "";
}

/// A pair of parentheses that is open.
struct Nesting {
    std::size_t begin;         ///< of the parenthesis
    const Function* function;  ///< whose arguments it contains, or null
    std::size_t arguments = 1;
    bool has_comparison = false;  ///< since the last `and`, `or` or comma
};

/// Checks the syntax of an expression and translates it. At each token, an operand or an operator
/// is expected, so that every error is found at its token, and muParser gets only correct text.
class Translation {
public:
    Translation(std::string_view text, std::vector<Token> tokens)
        : text_(text), tokens_(std::move(tokens)) {}

    void run() {
        while (tokens_[at_].kind != TokenKind::end) {
            expects_operand_ ? take_operand() : take_operator();
        }
        if (expects_operand_) refuse_here("a number or variable is missing at the end");
        if (nestings_.size() > 1) {
            expression::refuse(text_, nestings_.back().begin, "this parenthesis is not closed");
        }
    }

    std::vector<Term> terms;
    std::vector<double> numbers;
    std::string translated;

private:
    [[nodiscard]] const Token& here() const { return tokens_[at_]; }
    [[noreturn]] void refuse_here(std::string_view what) const {
        expression::refuse(text_, here().begin, what);
    }
    void put(std::string_view words) {
        translated += words;
        translated += ' ';
    }

    void open(const Function* function) {
        if (nestings_.size() > Expression::deepest_nesting) {
            refuse_here(
                fmt::format("more than {} parentheses are nested", Expression::deepest_nesting));
        }
        nestings_.push_back({here().begin, function});
        is_in_arithmetic_ = false;
        put("(");
        ++at_;
    }

    void take_operand() {
        const Token& token = here();
        switch (token.kind) {
            case TokenKind::number:
                put_number(token.number);
                ++at_;
                expects_operand_ = false;
                return;
            case TokenKind::open: return open(nullptr);
            case TokenKind::negation:
                if (is_in_arithmetic_) refuse_here("not applies to a comparison: write not (...)");
                put(take_repeated(token.kind, token.text) % 2 == 1 ? "!" : "~");
                return;
            case TokenKind::name: return take_name();
            default: break;
        }
        if (token.text == "-") {
            return take_signs();
        }
        refuse_here("a number or variable is missing before this");
    }

    // muParser accepts a single prefix operator before an operand.

    /// Skips tokens like the present one, and returns their number.
    std::size_t take_repeated(TokenKind kind, const std::string& text) {
        const std::size_t begin = at_;
        while (here().kind == kind && here().text == text) ++at_;
        return at_ - begin;
    }

    void take_signs() {
        const bool follows_not = at_ > 0 && tokens_[at_ - 1].kind == TokenKind::negation;
        is_in_arithmetic_ = true;
        if (take_repeated(TokenKind::arithmetic, "-") % 2 == 0) return;
        if (follows_not) put_number(0);
        put("-");
    }

    void put_number(double number) {
        put(fmt::format("k{}", numbers.size()));
        numbers.push_back(number);
    }

    void take_name() {
        const Token& token = here();
        const bool is_call = tokens_[at_ + 1].kind == TokenKind::open;
        if (const auto* variable = find_name(variables, token.text); variable && !is_call) {
            ++at_;
            return put_term({variable->quantity, "", 0});
        }
        if (const auto* quantity = find_name(named_quantities, token.text)) {
            return quantity->quantity == Quantity::graded ? take_graded()
                                                          : take_quantity(quantity->quantity);
        }
        const auto* const function = std::ranges::find(functions, token.text, &Function::name);
        if (function == functions.end()) refuse_name(token.text, is_call);
        if (!is_call) refuse_here(fmt::format("{} takes arguments in parentheses", token.text));
        translated += function->name;  // muParser expects the parenthesis right behind it
        ++at_;
        open(function);
    }

    [[noreturn]] void refuse_name(const std::string& name, bool is_call) const {
        if (const std::string hint = hint_of_word(name); !hint.empty()) refuse_here(hint);
        if (is_call) {
            refuse_here(
                fmt::format("there is no function {}; there are {}", name, known_names(true)));
        }
        refuse_here(
            fmt::format("there is no variable {0}; there are {1}, and field({0}) for a "
                        "field of this name",
                        name, known_names(false)));
    }

    /// Takes NAME(ARGUMENT) or NAME(ARGUMENT, SHARE).
    void take_quantity(Quantity quantity) {
        const std::string name = here().text;
        const auto refuse_argument = [&](std::string_view what) {
            refuse_here(fmt::format("{} {}", name, what));
        };
        const auto take = [&](TokenKind kind, std::string_view what) {
            if (here().kind != kind) refuse_argument(what);
            ++at_;
        };
        ++at_;
        take(TokenKind::open, "takes its arguments in parentheses");
        Term term{quantity, "", 0};
        const bool is_marker = quantity == Quantity::distance;
        const std::string_view wanted =
            is_marker ? "takes a marker or the name of a group" : "takes the name of a field";
        if (is_marker && here().text == "-") {
            term.name = "-";
            ++at_;
        }
        const bool is_name = here().kind == TokenKind::name || here().kind == TokenKind::quoted;
        if (!is_name && !(is_marker && here().kind == TokenKind::number)) {
            refuse_argument(wanted);
        }
        term.name += here().text;
        if (term.name.empty()) refuse_argument(wanted);
        ++at_;
        if (takes_share(quantity)) {
            take(TokenKind::comma, "takes the name of a field and a number");
            const bool is_share =
                here().kind == TokenKind::number && here().number > 0 && here().number <= 1;
            if (!is_share) refuse_argument("takes a number above 0, at most 1");
            term.share = here().number;
            ++at_;
        }
        take(TokenKind::close, "has more arguments than it takes, or is not closed");
        put_term(term);
    }

    /// Takes graded(EXPRESSION, R).
    void take_graded() {
        constexpr std::string_view wanted = "graded takes an expression and a number above 1";
        ++at_;
        if (here().kind != TokenKind::open) refuse_here(wanted);
        const std::size_t begin = at_ + 1;
        std::size_t comma = 0;  // the last one that no inner parentheses contain
        std::size_t depth = 0;
        do {
            const Token& token = here();
            if (token.kind == TokenKind::end) refuse_here(wanted);
            if (token.kind == TokenKind::name && token.text == "graded") {
                refuse_here("graded cannot contain graded");
            }
            if (token.kind == TokenKind::open) ++depth;
            if (token.kind == TokenKind::close) --depth;
            if (token.kind == TokenKind::comma && depth == 1) comma = at_;
            ++at_;
        } while (depth > 0);
        const bool has_number = comma > begin && comma + 3 == at_ &&
                                tokens_[comma + 1].kind == TokenKind::number &&
                                tokens_[comma + 1].number > 1;
        if (!has_number) {
            at_ = begin;
            refuse_here(wanted);
        }
        const std::string_view text =
            text_.substr(tokens_[begin].begin, tokens_[comma].begin - tokens_[begin].begin);
        put_term({Quantity::graded,
                  Expression(text.substr(0, text.find_last_not_of(" \t") + 1)).text(),
                  tokens_[comma + 1].number});
    }

    void put_term(const Term& term) {
        const auto found = std::ranges::find(terms, term);
        put(fmt::format("v{}", found - terms.begin()));
        if (found == terms.end()) terms.push_back(term);
        expects_operand_ = false;
    }

    void take_operator() {
        const Token& token = here();
        Nesting& nesting = nestings_.back();
        is_in_arithmetic_ =
            token.kind == TokenKind::comparison || token.kind == TokenKind::arithmetic;
        switch (token.kind) {
            case TokenKind::comparison:
                if (nesting.has_comparison) {
                    refuse_here("comparisons cannot be chained: write a < b and b < c");
                }
                nesting.has_comparison = true;
                break;
            case TokenKind::logical: nesting.has_comparison = false; break;
            case TokenKind::arithmetic: break;
            case TokenKind::comma:
                if (nesting.function == nullptr) refuse_here("this comma separates no arguments");
                ++nesting.arguments;
                nesting.has_comparison = false;
                break;
            case TokenKind::close: return close();
            default: {
                const std::string hint = hint_of_word(token.text);
                refuse_here(hint.empty() ? "an operator is missing before this" : hint);
            }
        }
        put(token.text);
        ++at_;
        expects_operand_ = true;
    }

    void close() {
        if (nestings_.size() == 1) refuse_here("this parenthesis closes none");
        const Nesting& nesting = nestings_.back();
        if (nesting.function != nullptr) {
            const auto& [name, least, most] = *nesting.function;
            if (nesting.arguments < least || nesting.arguments > most) {
                refuse_here(fmt::format(
                    "{} takes {} argument{}, not {}", name,
                    least == most ? fmt::format("{}", least) : fmt::format("{} or more", least),
                    most == 1 ? "" : "s", nesting.arguments));
            }
        }
        nestings_.pop_back();
        put(")");
        ++at_;
    }

    std::string_view text_;
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    bool expects_operand_ = true;
    bool is_in_arithmetic_ = false;  ///< after a comparison or an operator of arithmetic
    std::vector<Nesting> nestings_{{0, nullptr}};
};

}  // namespace

std::string text_of(const Term& term) {
    for (const auto& [name, quantity] : variables) {
        if (quantity == term.quantity) return std::string(name);
    }
    for (const auto& [name, quantity] : named_quantities) {
        if (quantity != term.quantity) continue;
        return takes_share(quantity) ? fmt::format("{}({}, {})", name, term.name, term.share)
                                     : fmt::format("{}({})", name, term.name);
    }
    return {};
}

Expression::Expression(std::string_view text) : text_(text) {
    if (text.size() > longest_text) {
        throw InputError(fmt::format("the expression has {} bytes, more than the {} allowed",
                                     text.size(), longest_text));
    }
    const auto is_control = [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
    };
    if (std::ranges::any_of(text, is_control)) {
        throw InputError("there is a control character in the expression");
    }
    if (text.find_first_not_of(" \t") == std::string_view::npos) {
        throw InputError("the expression is empty");
    }
    Translation translation(text, expression::tokens_of(text));
    translation.run();
    terms_ = std::move(translation.terms);
    numbers_ = std::move(translation.numbers);
    translated_ = std::move(translation.translated);
}

}  // namespace octetra
