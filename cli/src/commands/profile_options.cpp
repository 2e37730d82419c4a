#include "commands/profile_options.hpp"

#include <CLI/CLI.hpp>

#include <octetra/core/files/lists.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/profile.hpp>

#include "commands/mesh_options.hpp"
#include "profile/format_profile.hpp"
#include "terminal.hpp"

namespace octetra::cli {

void add_profile_options(CLI::App& subcommand, ProfileOptions& options) {
    const std::string group = "Profiling";
    subcommand
        .add_option("--profile", options.profile,
                    "print times, messages and bytes of every phase, and write them as JSON")
        ->type_name("FILE")
        ->check(file_name_validator())
        ->group(group);
    subcommand
        .add_option("--trace", options.trace,
                    "write a timeline of all ranks, as JSON for ui.perfetto.dev")
        ->type_name("FILE")
        ->check(file_name_validator())
        ->group(group);
}

distributed::Communicator measured(const distributed::Communicator& world,
                                   const ProfileOptions& options) {
    if (options.profile.empty() && options.trace.empty()) return world;
    return distributed::profiled(world, options.trace.empty() ? distributed::ProfileDetail::sums
                                                              : distributed::ProfileDetail::spans);
}

void write_profile(const distributed::Communicator& measured, const ProfileOptions& options,
                   bool quiet) {
    if (measured.profile() == nullptr) return;
    const auto profile = distributed::gather_profile(measured);
    measured.on_first([&] {
        if (!options.profile.empty()) {
            if (!quiet) print("\n{}", format_profile_table(profile));
            write_text(format_profile_json(profile), options.profile);
        }
        if (!options.trace.empty()) write_text(format_trace(profile), options.trace);
    });
}

}  // namespace octetra::cli
