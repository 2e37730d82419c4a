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

/// The heading of these options in the help.
inline constexpr const char* execution_group = "Execution (does not change the result)";

/// Declares --partition.
void add_partition_option(CLI::App& subcommand, ParallelOptions& options);
/// Declares --partition, --sync and --rebalance.
void add_parallel_options(CLI::App& subcommand, ParallelOptions& options);

/// Returns the meaning of a word of --partition. Throws InputError.
[[nodiscard]] distributed::Partition partition_named(const std::string& word);

/// Return the meaning of the options, or the default. Throw InputError.
[[nodiscard]] distributed::Partition partition_of(const ParallelOptions& options);
[[nodiscard]] distributed::Synchronisation synchronisation_of(const ParallelOptions& options);
/// Returns nothing if cells must not move.
[[nodiscard]] std::optional<distributed::BalanceOptions> balance_of(const ParallelOptions& options);

}  // namespace octetra::cli
