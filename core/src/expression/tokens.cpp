#include "expression/tokens.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/from_chars.hpp>

namespace octetra::expression {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || byte >= 0x80;
}
bool is_blank(char c) { return c == ' ' || c == '\t'; }

struct Symbol {
    std::string_view text;
    TokenKind kind;
};

/// Longer symbols precede those with which they begin.
constexpr std::array<Symbol, 16> symbols{{{"<=", TokenKind::comparison},
                                          {">=", TokenKind::comparison},
                                          {"==", TokenKind::comparison},
                                          {"!=", TokenKind::comparison},
                                          {"&&", TokenKind::logical},
                                          {"||", TokenKind::logical},
                                          {"<", TokenKind::comparison},
                                          {">", TokenKind::comparison},
                                          {"+", TokenKind::arithmetic},
                                          {"-", TokenKind::arithmetic},
                                          {"*", TokenKind::arithmetic},
                                          {"/", TokenKind::arithmetic},
                                          {"^", TokenKind::arithmetic},
                                          {"(", TokenKind::open},
                                          {")", TokenKind::close},
                                          {",", TokenKind::comma}}};

struct Hint {
    std::string_view text;
    std::string_view what;
};

/// Operators of other languages, as they are written here.
constexpr std::array<Hint, 4> foreign_symbols{{{"=<", "write <= in place of =<"},
                                               {"=>", "write >= in place of =>"},
                                               {"<>", "write != in place of <>"},
                                               {"**", "write ^ in place of **"}}};

class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    Token next() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
        if (at_ == text_.size()) return {TokenKind::end, at_, "", 0};
        const char c = text_[at_];
        if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) {
            return number();
        }
        if (is_letter(c)) return word();
        if (c == '"' || c == '\'') return quoted();
        return symbol();
    }

private:
    Token number() {
        Token token{TokenKind::number, at_, "", 0};
        const char* const begin = text_.data() + at_;
        const auto [end, error] = from_chars(begin, text_.data() + text_.size(), token.number);
        token.text = std::string(begin, end);
        at_ += token.text.size();
        if (error != std::errc() || !std::isfinite(token.number)) {
            refuse(text_, token.begin, "the number is out of range");
        }
        if (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '.')) {
            refuse(text_, at_, "a number ends here, and an operator is missing");
        }
        return token;
    }

    Token word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
        Token token{TokenKind::name, begin, std::string(text_.substr(begin, at_ - begin)), 0};
        if (token.text == "and") token = {TokenKind::logical, begin, "&&", 0};
        if (token.text == "or") token = {TokenKind::logical, begin, "||", 0};
        if (token.text == "not") token = {TokenKind::negation, begin, "!", 0};
        return token;
    }

    Token quoted() {
        const std::size_t begin = at_;
        const std::size_t end = text_.find(text_[begin], begin + 1);
        if (end == std::string_view::npos) {
            refuse(text_, begin, "the closing quotation mark is missing");
        }
        at_ = end + 1;
        return {TokenKind::quoted, begin, std::string(text_.substr(begin + 1, end - begin - 1)), 0};
    }

    Token symbol() {
        const std::string_view rest = text_.substr(at_);
        for (const auto& [foreign, what] : foreign_symbols) {
            if (rest.starts_with(foreign)) refuse(text_, at_, what);
        }
        const auto* const found = std::ranges::find_if(
            symbols, [&](const Symbol& s) { return rest.starts_with(s.text); });
        if (found != symbols.end()) {
            const Token token{found->kind, at_, std::string(found->text), 0};
            at_ += found->text.size();
            return token;
        }
        if (rest.front() == '=') {
            refuse(text_, at_, "= assigns; a comparison for equality is ==");
        }
        if (rest.front() == '!') refuse(text_, at_, "the word for ! is not");
        refuse(text_, at_, fmt::format("the character {} has no meaning here", rest.front()));
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

void refuse(std::string_view text, std::size_t byte, std::string_view what) {
    const auto is_continuation = [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    };
    const std::string_view before = text.substr(0, byte);
    const auto column =
        before.size() - static_cast<std::size_t>(std::ranges::count_if(before, is_continuation));
    std::string shown(text);
    std::ranges::replace(shown, '\t', ' ');
    throw InputError(fmt::format("column {}: {}\n  {}\n  {}^", column + 1, what, shown,
                                 std::string(column, ' ')));
}

std::vector<Token> tokens_of(std::string_view text) {
    Scanner scanner(text);
    std::vector<Token> tokens;
    do {
        tokens.push_back(scanner.next());
    } while (tokens.back().kind != TokenKind::end);
    return tokens;
}

}  // namespace octetra::expression
