#include "commands/size_option.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_formats.hpp>

#include "commands/abbreviations.hpp"
#include "commands/number_options.hpp"

namespace octetra::cli {

void add_size_option(CLI::App& subcommand, SelectionOptions& options, const std::string& group,
                     const std::string& meaning) {
    subcommand
        .add_option(
            "--size", options.sizes,
            meaning +
                ": a number, an expression such as\n"
                "\"0.02 + distance(wall) / 4\", or a file: .sol or .solb with sizes or metrics on\n"
                "the vertices or cells of MESH; another mesh with sizes, .mesh or .meshb with a\n"
                ".sol or .solb beside it, .msh with $NodeData or $ElementData, or .octetra")
        ->type_name("SIZE")
        ->allow_extra_args(false)
        ->group(group);
    using Limits = std::numeric_limits<double>;
    add_number<double>(subcommand, "--gradation", options.gradation,
                       {1 + Limits::epsilon(), Limits::max(), "above 1", ""},
                       "limit how fast the size of --size grows from a cell to the next: by at\n"
                       "most R - 1 for each unit of length")
        ->type_name("R")
        ->group(group);
}

bool is_background_file(std::string_view value) {
    return sol_path_for(value).has_value() || is_checkpoint(value) ||
           format_of(value) == Format::gmsh;
}

bool is_size_file(std::string_view value) { return is_sol(value) || is_background_file(value); }

std::string target_size(const std::string& value, std::optional<double> gradation) {
    std::string size = value;
    if (is_size_file(value)) {
        size = fmt::format("{}({})", is_background_file(value) ? "background" : "size",
                           quoted("--size", value));
    }
    if (gradation) size = fmt::format("graded({}, {})", size, *gradation);
    try {
        if (!is_size_file(value)) (void)Expression(value);  // whose errors show VALUE alone
        (void)Expression(size);
    } catch (const InputError& error) {
        throw InputError(fmt::format("--size: {}", error.what()));
    }
    return size;
}

std::vector<std::string> size_files_of(const SelectionOptions& options) {
    std::vector<std::string> files;
    const auto add = [&](const std::string& file) {
        if (std::ranges::find(files, file) == files.end()) files.push_back(file);
    };
    for (const std::string& value : options.sizes) {
        if (is_size_file(value)) add(value);
    }
    for (const SelectionOptions& other : options.narrowed_by) {
        for (const std::string& file : size_files_of(other)) add(file);
    }
    return files;
}

}  // namespace octetra::cli
