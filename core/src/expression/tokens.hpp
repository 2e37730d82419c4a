#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The words of an expression.
namespace octetra::expression {

enum class TokenKind : std::uint8_t {
    number,
    name,      ///< of a variable or function, or of a field
    quoted,    ///< a name in quotation marks, which `text` does not have
    negation,  ///< not
    logical,   ///< and, or
    comparison,
    arithmetic,  ///< + - * / ^
    open,
    close,
    comma,
    end,
};

struct Token {
    TokenKind kind = TokenKind::end;
    std::size_t begin = 0;  ///< byte of the expression
    std::string text;
    double number = 0;
};

/// Throws InputError: the message, the text, and a caret below the character at this byte.
[[noreturn]] void refuse(std::string_view text, std::size_t byte, std::string_view what);

/// Splits an expression. The last token is the end. Throws InputError.
[[nodiscard]] std::vector<Token> tokens_of(std::string_view text);

}  // namespace octetra::expression
