#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

#include "commands/engine_option.hpp"
#include "commands/mesh_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "commands/refinement_options.hpp"

namespace octetra::cli {

/// The validated and parsed options of octetra refine.
struct Plan {
    Selection selection;
    Scheme scheme = Scheme::eight;
    Closure closure = Closure::longest_edge;
    Engine engine = Engine::distributed;
    distributed::Partition partition;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    std::optional<distributed::BalanceOptions> balance;
};

/// The options of octetra refine, as given.
struct RefineOptions {
    InputOptions input;
    std::string output;
    std::string maps;
    RefinementOptions refinement;
    std::string engine = "distributed";
    ParallelOptions parallel;
    ProfileOptions profile;
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    bool check = false;
    bool verify = false;
    bool quiet = false;
};

}  // namespace octetra::cli
