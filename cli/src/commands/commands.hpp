#pragma once

namespace CLI {
class App;
}

/// Each function declares one subcommand of the program: its options, its help, and what runs when
/// it is called. A subcommand fails by throwing.
namespace octetra::cli {

void add_convert(CLI::App& program);
void add_generate(CLI::App& program);
void add_info(CLI::App& program);
void add_refine(CLI::App& program);

}  // namespace octetra::cli
