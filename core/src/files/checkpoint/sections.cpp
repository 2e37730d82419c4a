#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>

namespace octetra {

std::size_t size_of(FieldType type) {
    return type == FieldType::float64 || type == FieldType::int64 ? 8 : 4;
}

std::size_t vertex_number_size(const CheckpointFacts& facts) {
    return facts.vertices <= (std::uint64_t{1} << 32U) ? 4 : 8;
}

SectionShape shape_of(const CheckpointFacts& facts, Section section) {
    const std::size_t number_size = vertex_number_size(facts);
    switch (section) {
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
    switch (section) {
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
    return fmt::format("values of '{}'", field.name);
}

}  // namespace octetra
