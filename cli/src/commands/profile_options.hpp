#pragma once

#include <string>

#include <octetra/distributed/communicator.hpp>

namespace CLI {
class App;
}

namespace octetra::cli {

struct ProfileOptions {
    std::string profile;
    std::string trace;
};

/// Declares --profile and --trace.
void add_profile_options(CLI::App& subcommand, ProfileOptions& options);

/// Collective. Returns a communicator of the same processes, with profiling if requested.
[[nodiscard]] distributed::Communicator measured(const distributed::Communicator& world,
                                                 const ProfileOptions& options);

/// Collective. Writes the requested profiles, at the end of a run, and prints the table of
/// --profile to stdout unless `quiet`. Throws SystemError on all processes.
void write_profile(const distributed::Communicator& measured, const ProfileOptions& options,
                   bool quiet);

}  // namespace octetra::cli
