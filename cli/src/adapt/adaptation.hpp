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

/// The property of the result that --verify checks.
enum class Claim {
    refines_input,  ///< a refinement of MESH, or of the input of its history
    refines_mesh,   ///< the refinement of MESH that the only step requests
    coarsens_mesh,  ///< the coarsening of MESH that the only step requests
};

/// Options common to the commands that adapt a mesh by steps, as given.
struct AdaptationOptions {
    InputOptions input;
    std::string output;
    ParallelOptions parallel;
    ProfileOptions profile;
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    std::string series;  ///< a .vtkhdf file with all steps; empty: none
    std::string maps;    ///< maps of MESH, as it was read; only for refinement
    bool check = false;  ///< verify MESH, as it was read
    bool verify = false;
    Claim claim = Claim::refines_input;
    bool quiet = false;
};

/// Collective. `world` is measured if profiling was requested. Reads the mesh or its history, runs
/// the steps, and verifies and writes the result. Throws NegativeAnswer if it is not valid.
void adapt(const AdaptationOptions& options, const Script& script,
           const distributed::Communicator& world);

}  // namespace octetra::cli
