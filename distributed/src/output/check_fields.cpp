#include "output/check_fields.hpp"

#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

/// The maximum number of components in a checkpoint's table.
constexpr std::size_t max_components = std::size_t{1} << 20U;

std::size_t value_count(const Field& field) {
    return std::visit([](const auto& values) { return values.size(); }, field.values);
}

}  // namespace

FieldFacts facts_of(const Field& field) {
    return {.name = field.name,
            .on = field.on,
            .type = static_cast<FieldType>(field.values.index()),
            .components = field.components};
}

void check_sizes(const DistributedMesh& mesh, std::span<const Field> fields) {
    std::set<std::pair<FieldOn, std::string>> names;
    for (const Field& field : fields) {
        const bool on_vertices = field.on == FieldOn::vertices;
        const std::size_t entities = on_vertices ? mesh.points.size() : mesh.cells.size();
        if (value_count(field) != entities * field.components) {
            throw InputError(
                fmt::format("rank {}: field '{}' has {} values; {} with {} components need {}",
                            mesh.processes.rank(), field.name, value_count(field),
                            fmt::format("{} {}", entities, on_vertices ? "vertices" : "cells"),
                            field.components, entities * field.components));
        }
        if (!is_name(field.name)) {
            throw InputError("the name of a field is not UTF-8, or has a control character");
        }
        if (!names.insert({field.on, field.name}).second) {
            throw InputError(fmt::format("two fields are called '{}'", field.name));
        }
        if (field.components > max_components) {
            throw InputError(
                fmt::format("field '{}' has more than {} components", field.name, max_components));
        }
    }
}

void check_same(const Communicator& processes, std::span<const Field> fields) {
    std::vector<std::uint8_t> encoded;
    for (const Field& field : fields) {
        const FieldFacts facts = facts_of(field);
        encoded.push_back(static_cast<std::uint8_t>(facts.on));
        encoded.push_back(static_cast<std::uint8_t>(facts.type));
        append_number(facts.components, encoded);
        append_number(facts.name.size(), encoded);
        encoded.insert(encoded.end(), facts.name.begin(), facts.name.end());
    }
    std::vector<std::uint8_t> of_first = encoded;
    processes.broadcast(of_first);
    if (processes.max(of_first == encoded ? 0 : 1) == 0) return;
    throw InputError("processes have different fields");
}

}  // namespace octetra::distributed
