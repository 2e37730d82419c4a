#include "adapt/size_files.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "commands/mesh_options.hpp"
#include "commands/size_option.hpp"
#include "script/check_script.hpp"

namespace octetra::cli {
namespace {

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

/// Collective.
Field read_size(const distributed::AdaptiveMesh& mesh, const std::string& file) {
    std::vector<Field> read = mesh.read_fields(file, note);
    if (read.size() != 1) {
        throw InputError(fmt::format("{}: --size takes a file with one field, and this has {}",
                                     file, read.size()));
    }
    read.front().name = file;
    return std::move(read.front());
}

}  // namespace

bool has_size_file(const Script& script) { return !files_of(script).empty(); }

void read_size_files(const distributed::AdaptiveMesh& mesh, const Script& script,
                     CarriedFields& fields) {
    for (const std::string& file : files_of(script)) {
        if (std::ranges::find(fields.all, file, &Field::name) != fields.all.end()) {
            throw InputError(
                fmt::format("--size: the mesh has a field with the name of this file: {}", file));
        }
        fields.all.push_back(read_size(mesh, file));
        ++fields.sizes;
    }
}

}  // namespace octetra::cli
