#pragma once

namespace CLI {
class App;
}
namespace octetra::distributed {
class Communicator;
}

/// Each function declares one subcommand of the program: its options, its help, and what runs when
/// it is called. A subcommand fails by throwing. Under mpirun every process of `world` runs the
/// subcommand; those that are not parallel work on the first and wait on the others, and failures
/// are thrown on all.
namespace octetra::cli {

void add_adapt(CLI::App& program, const distributed::Communicator& world);
void add_coarsen(CLI::App& program, const distributed::Communicator& world);
void add_compare(CLI::App& program, const distributed::Communicator& world);
void add_convert(CLI::App& program, const distributed::Communicator& world);
void add_generate(CLI::App& program, const distributed::Communicator& world);
void add_info(CLI::App& program, const distributed::Communicator& world);
void add_partition(CLI::App& program, const distributed::Communicator& world);
void add_refine(CLI::App& program, const distributed::Communicator& world);
void add_verify(CLI::App& program, const distributed::Communicator& world);

}  // namespace octetra::cli
