#include "adapt/size_files.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/sol_files.hpp>

#include "commands/abbreviations.hpp"
#include "commands/mesh_options.hpp"
#include "commands/size_option.hpp"
#include "script/check_script.hpp"

namespace octetra::cli {
namespace {

using distributed::AdaptiveMesh;
using distributed::Field;

std::vector<std::string> files_of(const Script& script) {
    std::vector<std::string> files;
    for (const ScriptStep& step : script.steps) {
        const SelectionOptions* criteria = criteria_of(step.step);
        if (criteria == nullptr) continue;
        for (std::string& file : size_files_of(*criteria)) {
            if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
        }
    }
    return files;
}

/// Returns the only field that was read from the file.
Field only_field(std::vector<Field> read, const std::string& file) {
    if (read.size() != 1) {
        throw InputError(fmt::format("{}: --size takes a file with one field, and this has {}",
                                     file, read.size()));
    }
    return std::move(read.front());
}

/// Collective. Reads a background mesh and its field, and sets the name of the file with the field.
AdaptiveMesh read_background_mesh(const distributed::Communicator& world, const std::string& file,
                                  Field& field) {
    const distributed::Partition rcb{.method = distributed::PartitionMethod::rcb};
    std::vector<Field> fields;
    if (is_checkpoint(file)) {
        AdaptiveMesh mesh = AdaptiveMesh::load(world, file, rcb, &fields);
        field = only_field(std::move(fields), file);
        field.name = file;
        return mesh;
    }
    AdaptiveMesh mesh = AdaptiveMesh::read(world, file, rcb);
    const std::string values = sol_path_for(file).value_or(file).native();  // beside it, or in it
    field = only_field(mesh.read_fields(values, note), values);
    field.name = values;
    return mesh;
}

/// Collective.
distributed::Background read_background(const distributed::Communicator& world,
                                        const std::string& file) {
    Field field;
    const AdaptiveMesh mesh = read_background_mesh(world, file, field);
    distributed::Background background = mesh.as_background(file, field);
    // This expression has no value unless all sizes are above 0.
    const std::string size = fmt::format("size({}) > 0", quoted("--size", field.name));
    (void)mesh.marked_cells({.where = {Expression(size)}}, std::array{field});
    return background;
}

}  // namespace

bool has_size_file(const Script& script) { return !files_of(script).empty(); }

void read_size_files(const distributed::AdaptiveMesh& mesh, const Script& script,
                     CarriedFields& fields) {
    for (const std::string& file : files_of(script)) {
        if (is_background_file(file)) {
            fields.backgrounds.push_back(read_background(mesh.processes(), file));
            continue;
        }
        if (std::ranges::find(fields.all, file, &Field::name) != fields.all.end()) {
            throw InputError(
                fmt::format("--size: the mesh has a field with the name of this file: {}", file));
        }
        fields.all.push_back(only_field(mesh.read_fields(file, note), file));
        fields.all.back().name = file;
        ++fields.sizes;
    }
}

}  // namespace octetra::cli
