#include "commands/parallel_options.hpp"

#include <array>

#include <CLI/CLI.hpp>

#include "choice.hpp"

namespace octetra::cli {

void add_partition_option(CLI::App& subcommand, ParallelOptions& options,
                          const std::string& group) {
    subcommand
        .add_option(
            "--partition", options.partition,
            "which rank gets which cell: rcb, lepp, dual, block, random:SEED, file:PATH [rcb]")
        ->type_name("METHOD")
        ->group(group);
}

void add_synchronisation_option(CLI::App& subcommand, ParallelOptions& options,
                                const std::string& group) {
    subcommand
        .add_option("--sync", options.synchronisation,
                    "ranks tell their neighbours, or the first rank, which tells the others "
                    "[neighbour]")
        ->type_name("neighbour|gateway")
        ->group(group);
}

distributed::Partition partition_of(const ParallelOptions& options) {
    return distributed::parse_partition(options.partition.value_or("rcb"));
}

distributed::Synchronisation synchronisation_of(const ParallelOptions& options) {
    using distributed::Synchronisation;
    constexpr std::array<Word<Synchronisation>, 2> synchronisations{
        {{"neighbour", Synchronisation::neighbour}, {"gateway", Synchronisation::gateway}}};
    return parse_choice("--sync", options.synchronisation.value_or("neighbour"), synchronisations);
}

}  // namespace octetra::cli
