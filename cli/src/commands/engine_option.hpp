#pragma once

#include <string>

#include "commands/parallel_options.hpp"

namespace CLI {
class App;
}

namespace octetra::cli {

enum class Engine { distributed, reference };

/// Declares --engine, under the headline `group` of the help.
void add_engine_option(CLI::App& subcommand, std::string& engine, const std::string& group);

/// Throws InputError for a word that is none, and where the reference is asked how ranks should
/// share its work.
[[nodiscard]] Engine parse_engine(const std::string& engine, const ParallelOptions& parallel);

}  // namespace octetra::cli
