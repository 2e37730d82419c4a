#pragma once

#include <string>
#include <string_view>

#include <octetra/verify/verify.hpp>

namespace octetra::test {

/// The codes of a verdict, joined for messages of failed expectations.
inline std::string codes_of(const verify::Verdict& verdict) {
    std::string codes;
    for (std::size_t code = 0; code < verify::code_count; ++code) {
        if (verdict.counts[code] == 0) continue;
        codes += codes.empty() ? "" : " ";
        codes += name(static_cast<verify::Code>(code));
    }
    return codes;
}

/// The check of this name; an empty one if there is none.
inline verify::Check check_named(const verify::Verdict& verdict, std::string_view name) {
    for (const verify::Check& check : verdict.checks) {
        if (check.name == name) return check;
    }
    return {};
}

}  // namespace octetra::test
