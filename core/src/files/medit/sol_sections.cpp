#include "files/medit/sol_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/point.hpp>

namespace octetra {

std::size_t sol_component_position(std::size_t component, std::size_t components) {
    constexpr std::array<std::size_t, 6> of_symmetric{0, 2, 5, 1, 4, 3};
    return components == of_symmetric.size() ? of_symmetric.at(component) : component;
}

std::int32_t sol_type(std::size_t components) {
    const auto found = std::ranges::find(sol_components, components);
    if (found == sol_components.end()) return 0;
    return static_cast<std::int32_t>(found - sol_components.begin()) + 1;
}

std::size_t SolSection::width() const {
    return std::accumulate(components.begin(), components.end(), std::size_t{0});
}

FieldRows SolSection::without_rows() const {
    return {keyword == 0 ? FieldOn::vertices : FieldOn::cells, components, count, 0, {}};
}

std::string wrong_sol_count(const SolSection& section,
                            const std::optional<EntityCounts>& expected) {
    if (!expected || section.keyword >= kept_sol_keywords) return {};
    const std::uint64_t there = section.keyword == 0 ? expected->vertices : expected->cells;
    if (section.count == there) return {};
    return fmt::format("{} {} announced, and the mesh has {}", section.count,
                       sol_keywords.at(section.keyword).entities, there);
}

std::string wrong_field_count(std::int64_t fields) {
    if (fields >= 1 && fields <= static_cast<std::int64_t>(max_sol_fields)) return {};
    return fmt::format("the number of fields should be from 1 to {}, not {}", max_sol_fields,
                       fields);
}

std::string wrong_sol_type(std::int64_t type) {
    if (type >= 1 && type <= static_cast<std::int64_t>(sol_components.size())) return {};
    return fmt::format(
        "the type of a field should be 1 (scalar), 2 (vector), 3 (symmetric tensor) or 4 (full "
        "tensor), not {}",
        type);
}

std::string wrong_value(double value) {
    if (!std::isfinite(value)) return fmt::format("a value is not finite: {}", value);
    if (std::abs(value) < coordinate_limit) return {};
    return fmt::format(
        "a value is {}: values must be less than 2^1023, about 8.98e307, or means overflow", value);
}

std::string second_sol_section(std::string_view keyword) {
    return fmt::format("a second section {}", keyword);
}

std::size_t sol_keyword(std::string_view keyword) {
    const auto found = std::ranges::find(sol_keywords, keyword, &SolKeyword::keyword);
    return static_cast<std::size_t>(found - sol_keywords.begin());
}

std::size_t sol_keyword(std::int32_t code) {
    const auto found = std::ranges::find(sol_keywords, code, &SolKeyword::code);
    return static_cast<std::size_t>(found - sol_keywords.begin());
}

SolSection take_sol_head(Tokens& tokens, const LineReader& reader, std::size_t keyword,
                         const std::optional<EntityCounts>& expected) {
    SolSection section{.keyword = keyword, .keyword_at = reader.line_number()};
    const auto refuse = [&](const std::string& wrong) {
        if (!wrong.empty()) reader.fail(wrong);
    };
    section.count = tokens.unsigned_integer("the number of entries");
    refuse(wrong_sol_count(section, expected));
    const auto fields = std::min<std::uint64_t>(tokens.unsigned_integer("the number of fields"),
                                                std::uint64_t{1} << 32U);
    refuse(wrong_field_count(static_cast<std::int64_t>(fields)));
    for (std::uint64_t f = 0; f < fields; ++f) {
        const auto type = std::min<std::uint64_t>(tokens.unsigned_integer("the type of a field"),
                                                  std::uint64_t{1} << 32U);
        refuse(wrong_sol_type(static_cast<std::int64_t>(type)));
        section.components.push_back(sol_components.at(type - 1));
    }
    reader.check_count(section.count, section.width(), "rows of values");
    return section;
}

}  // namespace octetra
