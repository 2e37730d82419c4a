#pragma once

#include <optional>
#include <string>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

namespace CLI {
class App;
}

namespace octetra::cli {

/// Options for parallel execution, as given.
struct ParallelOptions {
    std::optional<std::string> partition;
    std::optional<std::string> synchronisation;
    std::optional<std::string> rebalance;
};

/// Declare --partition, --sync and --rebalance under the heading `group` of the help.
void add_partition_option(CLI::App& subcommand, ParallelOptions& options, const std::string& group);
void add_synchronisation_option(CLI::App& subcommand, ParallelOptions& options,
                                const std::string& group);
void add_rebalance_option(CLI::App& subcommand, ParallelOptions& options, const std::string& group);

/// Returns the meaning of a word of --partition. Throws InputError.
[[nodiscard]] distributed::Partition partition_named(const std::string& word);

/// Return the meaning of the options, or the default. Throw InputError.
[[nodiscard]] distributed::Partition partition_of(const ParallelOptions& options);
[[nodiscard]] distributed::Synchronisation synchronisation_of(const ParallelOptions& options);
/// Returns nothing if cells must not move.
[[nodiscard]] std::optional<distributed::BalanceOptions> balance_of(const ParallelOptions& options);

}  // namespace octetra::cli
