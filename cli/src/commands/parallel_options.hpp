#pragma once

#include <optional>
#include <string>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

namespace CLI {
class App;
}

namespace octetra::cli {

/// How ranks share the work, as it was typed.
struct ParallelOptions {
    std::optional<std::string> partition;
    std::optional<std::string> synchronisation;
    std::optional<std::string> rebalance;
};

/// Declare --partition, --sync and --rebalance, under the headline `group` of the help.
void add_partition_option(CLI::App& subcommand, ParallelOptions& options, const std::string& group);
void add_synchronisation_option(CLI::App& subcommand, ParallelOptions& options,
                                const std::string& group);
void add_rebalance_option(CLI::App& subcommand, ParallelOptions& options, const std::string& group);

/// What a word of --partition means. Throws InputError.
[[nodiscard]] distributed::Partition partition_named(const std::string& word);

/// What they mean, or the default. Throw InputError.
[[nodiscard]] distributed::Partition partition_of(const ParallelOptions& options);
[[nodiscard]] distributed::Synchronisation synchronisation_of(const ParallelOptions& options);
/// Nothing, where cells are never to move.
[[nodiscard]] std::optional<distributed::BalanceOptions> balance_of(const ParallelOptions& options);

}  // namespace octetra::cli
