#include "commands/abbreviations.hpp"

#include <limits>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "parse_numbers.hpp"

namespace octetra::cli {
namespace {

using Limits = std::numeric_limits<double>;

const Range<double> shares{Limits::min(), 1, "above 0, at most 1"};
const Range<double> lengths{Limits::denorm_min(), Limits::max(), "above 0", ""};

struct FieldNumber {
    std::string name;  ///< in quotation marks
    double number = 0;
};

/// Parses NAME,NUMBER; the name may contain commas.
FieldNumber parse_field_number(std::string_view option, std::string_view text,
                               const Range<double>& range) {
    const std::size_t comma = text.rfind(',');
    if (comma == std::string_view::npos || comma == 0) {
        throw InputError(
            fmt::format("{} takes the name of a field and a number, as in {} eta,0.5, not '{}'",
                        option, option, text));
    }
    return {quoted(option, text.substr(0, comma)),
            parse_number<double>(option, text.substr(comma + 1), range)};
}

std::string near(const std::string& value) {
    std::vector<std::string> words{""};
    for (const char c : value) {
        if (c == ',') {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    if (words.size() < 2 || words.size() > 3 || words.front().empty()) {
        throw InputError(fmt::format(
            "--near takes a marker or the name of a group and a distance, and possibly a length, "
            "as in --near wall,0.1,0.02, not '{}'",
            value));
    }
    const auto length = [&](std::size_t k) {
        return parse_number<double>("--near", words[k], lengths);
    };
    std::string text = fmt::format("distance({}) < {}", quoted("--near", words[0]), length(1));
    if (words.size() == 3) text += fmt::format(" and longest > {}", length(2));
    return text;
}

std::string min_eta(const std::string& value) {
    return fmt::format("eta < {}", parse_number<double>("--min-eta", value, shares));
}

std::string bulk(const std::string& value) {
    const auto [name, share] = parse_field_number("--bulk", value, shares);
    return fmt::format("bulk({}, {})", name, share);
}

std::string fraction(const std::string& value) {
    const auto [name, share] = parse_field_number("--fraction", value, shares);
    return fmt::format("fraction({}, {})", name, share);
}

std::string above(const std::string& value) {
    const auto [name, limit] =
        parse_field_number("--above", value, {Limits::lowest(), Limits::max(), "of any size", ""});
    return fmt::format("field({}) > {}", name, limit);
}

}  // namespace

std::string quoted(std::string_view option, std::string_view name) {
    const char quote = name.find('"') == std::string_view::npos ? '"' : '\'';
    if (name.find(quote) == std::string_view::npos)
        return fmt::format("{}{}{}", quote, name, quote);
    throw InputError(
        fmt::format("{}: the name {} has both kinds of quotation marks", option, name));
}

const std::array<Abbreviation, 5>& abbreviations() {
    static constexpr std::array<Abbreviation, 5> list{
        {{"near", "MARKER,D[,H]",
          "cells nearer than D to tagged facets with this marker or group name [with an\n"
          "edge longer than H]",
          near},
         {"min-eta", "ETA", "cells with a mean ratio below ETA, above 0 and at most 1", min_eta},
         {"bulk", "NAME,THETA",
          "cells with the largest values of a field that have the fraction THETA of their\n"
          "sum (Doerfler marking)",
          bulk},
         {"fraction", "NAME,SHARE",
          "this fraction of the cells, those with the largest values of a field", fraction},
         {"above", "NAME,VALUE", "cells with a value of a field above VALUE", above}}};
    return list;
}

}  // namespace octetra::cli
