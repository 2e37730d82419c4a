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

/// What --verify asks of the result.
enum class Claim {
    refines_input,  ///< a refinement of MESH, or of what its history began with
    refines_mesh,   ///< of MESH, as it was read, the one that the only step asks for
    coarsens_mesh,  ///< the coarsening of MESH that the only step asks for
};

/// What the commands that adapt a mesh by steps have in common, as it was typed.
struct AdaptationOptions {
    InputOptions input;
    std::string output;
    ParallelOptions parallel;
    ProfileOptions profile;
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    std::string series;  ///< a .vtkhdf with all steps; empty: none
    std::string maps;    ///< of MESH, as it was read; goes with refinement alone
    bool check = false;  ///< judge MESH, as it was read
    bool verify = false;
    Claim claim = Claim::refines_input;
    bool quiet = false;
};

/// Collective, among processes that measure themselves if that is asked for. Reads the mesh, or its
/// history, runs the steps, judges and writes the result. Throws AnswerIsNo if it is not valid.
void adapt(const AdaptationOptions& options, const Script& script,
           const distributed::Communicator& world);

}  // namespace octetra::cli
