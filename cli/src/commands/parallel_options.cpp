#include "commands/parallel_options.hpp"

#include <array>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/from_chars.hpp>

#include "choice.hpp"

namespace octetra::cli {

void add_partition_option(CLI::App& subcommand, ParallelOptions& options) {
    subcommand
        .add_option(
            "--partition", options.partition,
            "assignment of cells to ranks: rcb, lepp, dual, block, random:SEED, file:PATH [rcb]")
        ->type_name("METHOD")
        ->group(execution_group);
}

void add_parallel_options(CLI::App& subcommand, ParallelOptions& options) {
    add_partition_option(subcommand, options);
    subcommand
        .add_option("--sync", options.synchronisation,
                    "exchange of marks between neighbours, or through the first rank [neighbour]")
        ->type_name("neighbour|gateway")
        ->group(execution_group);
    subcommand
        .add_option(
            "--rebalance", options.rebalance,
            "when cells move: auto, never, or if a rank exceeds the mean by FRACTION [auto]")
        ->type_name("auto|never|FRACTION")
        ->group(execution_group);
}

distributed::Partition partition_named(const std::string& word) {
    try {
        return distributed::parse_partition(word);
    } catch (const InputError& error) {
        throw InputError(std::string("--") + error.what());
    }
}

distributed::Partition partition_of(const ParallelOptions& options) {
    return partition_named(options.partition.value_or("rcb"));
}

distributed::Synchronisation synchronisation_of(const ParallelOptions& options) {
    using distributed::Synchronisation;
    constexpr std::array<Word<Synchronisation>, 2> synchronisations{
        {{"neighbour", Synchronisation::neighbour}, {"gateway", Synchronisation::gateway}}};
    return parse_choice("--sync", options.synchronisation.value_or("neighbour"), synchronisations);
}

std::optional<distributed::BalanceOptions> balance_of(const ParallelOptions& options) {
    const std::string word = options.rebalance.value_or("auto");
    if (word == "auto") return distributed::BalanceOptions{.only_if_it_pays = true};
    if (word == "never") return std::nullopt;
    double share = -1;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = from_chars(word.data(), end, share);
    if (error != std::errc{} || stop != end || !(share >= 0 && share <= 1e9)) {
        throw InputError(
            fmt::format("--rebalance takes auto, never or a number from 0 to 1e9, not '{}'", word));
    }
    return distributed::BalanceOptions{.most_over_mean = 1 + share};
}

}  // namespace octetra::cli
