#pragma once

#include <string>

#include "commands/parallel_options.hpp"

namespace CLI {
class App;
}

namespace octetra::cli {

enum class Engine { distributed, reference };

/// Declares --engine and the options for parallel execution.
void add_engine_options(CLI::App& subcommand, std::string& engine, ParallelOptions& parallel);

/// Throws InputError for an unknown word, or if options for parallel execution are given with the
/// reference.
[[nodiscard]] Engine parse_engine(const std::string& engine, const ParallelOptions& parallel);

}  // namespace octetra::cli
