#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <octetra/core/checkpoint_blocks.hpp>

#include "files/input/fields.hpp"

namespace octetra {
namespace {

std::optional<Feature> feature_of(Section section) {
    if (section < Section::features || section >= Section::cuts) return std::nullopt;
    return all_features.at(static_cast<std::size_t>(section) -
                           static_cast<std::size_t>(Section::features));
}

std::string name_of_list(Feature feature) {
    constexpr std::array<std::string_view, feature_count> names{
        "corners",        "required vertices", "ridges",
        "required edges", "required facets",   "required cells"};
    return std::string(names.at(static_cast<std::size_t>(feature)));
}

}  // namespace

std::size_t vertex_number_size(const CheckpointFacts& facts) {
    return facts.vertices <= (std::uint64_t{1} << 32U) ? 4 : 8;
}

SectionShape shape_of(const CheckpointFacts& facts, Section section) {
    const std::size_t number_size = vertex_number_size(facts);
    if (const auto feature = feature_of(section)) {
        return {facts.features[*feature], sizeof(std::uint64_t)};
    }
    switch (section) {
        case Section::features: break;  // above
        case Section::points: return {facts.vertices, 3 * sizeof(double)};
        case Section::point_markers:
            return {facts.has_point_markers ? facts.vertices : 0, sizeof(Marker)};
        case Section::point_attributes:
            return {facts.attributes_per_point > 0 ? facts.vertices : 0,
                    facts.attributes_per_point * sizeof(double)};
        case Section::cells: return {facts.cells, 4 * number_size};
        case Section::regions: return {facts.has_regions ? facts.cells : 0, sizeof(Marker)};
        case Section::facets: return {facts.facets, 3 * number_size};
        case Section::facet_markers:
            return {facts.has_facet_markers ? facts.facets : 0, sizeof(Marker)};
        case Section::edges: return {facts.edges, 2 * number_size};
        case Section::edge_markers:
            return {facts.has_edge_markers ? facts.edges : 0, sizeof(Marker)};
        case Section::cuts: return {facts.steps.empty() ? 0 : facts.cells, 0};
    }
    const FieldFacts& field = facts.fields[static_cast<std::size_t>(section) - first_field];
    const std::size_t entity_size = field.components * size_of(field.type);
    const std::uint64_t count =
        field.on == FieldOn::vertices ? facts.vertices_now : facts.cells_now;
    return {entity_size > 0 ? count : 0, entity_size};
}

std::string name_of(const CheckpointFacts& facts, Section section) {
    if (const auto feature = feature_of(section)) return name_of_list(*feature);
    switch (section) {
        case Section::features: break;  // above
        case Section::points: return "points";
        case Section::point_markers: return "vertex markers";
        case Section::point_attributes: return "attributes";
        case Section::cells: return "cells";
        case Section::regions: return "region tags";
        case Section::facets: return "facets";
        case Section::facet_markers: return "facet markers";
        case Section::edges: return "edges";
        case Section::edge_markers: return "edge markers";
        case Section::cuts: return "cuts";
    }
    const FieldFacts& field = facts.fields[static_cast<std::size_t>(section) - first_field];
    return "values of " + shown(field.name);
}

std::string wrong_in(const SavedState& state) {
    if (!std::isfinite(state.time)) return "the time of a checkpoint is not finite";
    std::string text = state.text;
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    if (!is_name(text))
        return "the text of a checkpoint is not valid UTF-8 or has a control character";
    return {};
}

bool is_name(std::string_view text) {
    const auto byte_at = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    for (std::size_t i = 0; i < text.size();) {
        const unsigned lead = byte_at(i);
        const std::size_t more = lead < 0x80 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
        if (lead < 0x20 || (lead >= 0x7f && lead < 0xc2) || lead > 0xf4) return false;
        for (std::size_t k = 1; k <= more; ++k) {
            if ((byte_at(i + k) & 0xc0U) != 0x80) return false;
        }
        const unsigned next = byte_at(i + 1);
        const bool is_control = lead == 0xc2 && next < 0xa0;
        const bool is_too_long = (lead == 0xe0 && next < 0xa0) || (lead == 0xf0 && next < 0x90);
        const bool is_no_letter = (lead == 0xed && next >= 0xa0) || (lead == 0xf4 && next >= 0x90);
        if (is_control || is_too_long || is_no_letter) return false;
        i += more + 1;
    }
    return true;
}

}  // namespace octetra
