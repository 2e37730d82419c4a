#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <octetra/distributed/communicator.hpp>

#include "commands/mesh_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// What the commands that adapt a mesh by steps have in common, as it was typed.
struct AdaptationOptions {
    InputOptions input;
    std::string output;
    ParallelOptions parallel;
    ProfileOptions profile;
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    bool verify = false;
    bool quiet = false;
};

/// Collective, among processes that measure themselves if that is asked for. Reads the mesh, or its
/// history, runs the steps, judges and writes the result. Throws AnswerIsNo if it is not valid.
void adapt(const AdaptationOptions& options, const Script& script,
           const distributed::Communicator& world);

}  // namespace octetra::cli
