#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands/selection_options.hpp"

/// The option --size: a target size, the length that no edge of a cell is to exceed.
namespace octetra::cli {

/// Declares --size and --gradation under the heading `group` of the help, which describes --size by
/// `meaning`.
void add_size_option(CLI::App& subcommand, SelectionOptions& options, const std::string& group,
                     const std::string& meaning);

/// Returns whether a value of --size is the name of a file rather than an expression, by its
/// extension: a file of values of MESH (.sol, .solb), or a background mesh (.mesh, .meshb with a
/// .sol or .solb beside it, .msh or .octetra).
[[nodiscard]] bool is_size_file(std::string_view value);
[[nodiscard]] bool is_background_file(std::string_view value);

/// Returns the expression of the target size for a value of --size and of --gradation, if given;
/// the field of a file has the name of the file. A cell is too large if `longest > (SIZE)`. Throws
/// InputError if the value is invalid.
[[nodiscard]] std::string target_size(const std::string& value, std::optional<double> gradation);

/// Returns the files of --size in all groups of criteria, each once, in the order of their first
/// use.
[[nodiscard]] std::vector<std::string> size_files_of(const SelectionOptions& options);

}  // namespace octetra::cli
