#include "commands/engine_option.hpp"

#include <array>

#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>

#include "choice.hpp"

namespace octetra::cli {

void add_engine_options(CLI::App& subcommand, std::string& engine, ParallelOptions& parallel) {
    subcommand
        .add_option("--engine", engine,
                    "the default, parallel under mpirun, or the serial reference [distributed]")
        ->type_name("distributed|reference")
        ->group(execution_group);
    add_parallel_options(subcommand, parallel);
}

Engine parse_engine(const std::string& text, const ParallelOptions& parallel) {
    constexpr std::array<Word<Engine>, 2> engines{
        {{"distributed", Engine::distributed}, {"reference", Engine::reference}}};
    const Engine engine = parse_choice("--engine", text, engines);
    if (engine == Engine::reference &&
        (parallel.partition || parallel.synchronisation || parallel.rebalance)) {
        throw InputError(
            "--partition, --sync and --rebalance cannot be combined with --engine reference, which "
            "uses one rank");
    }
    return engine;
}

}  // namespace octetra::cli
