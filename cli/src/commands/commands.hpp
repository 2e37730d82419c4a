#pragma once

namespace CLI {
class App;
}
namespace octetra::distributed {
class Communicator;
}

/// Each function declares a subcommand of the program: its options, its help, and the function to
/// be run. A subcommand fails by throwing. Under mpirun, every process of `world` runs the
/// subcommand; serial subcommands run on the first while the others wait, and errors are thrown on
/// all.
namespace octetra::cli {

void add_adapt(CLI::App& program, const distributed::Communicator& world);
void add_certify(CLI::App& program, const distributed::Communicator& world);
void add_coarsen(CLI::App& program, const distributed::Communicator& world);
void add_compare(CLI::App& program, const distributed::Communicator& world);
void add_convert(CLI::App& program, const distributed::Communicator& world);
void add_fit(CLI::App& program, const distributed::Communicator& world);
void add_generate(CLI::App& program, const distributed::Communicator& world);
void add_info(CLI::App& program, const distributed::Communicator& world);
void add_partition(CLI::App& program, const distributed::Communicator& world);
void add_refine(CLI::App& program, const distributed::Communicator& world);
void add_verify(CLI::App& program, const distributed::Communicator& world);

}  // namespace octetra::cli
