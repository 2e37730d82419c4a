#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

/// 8T-LE refinement of a distributed mesh: Balman, "Tetrahedral Mesh Refinement in Distributed
/// Environments", Figure 3.
namespace octetra::distributed {

/// The method by which processes notify each other of marked edges that they share.
enum class Synchronisation {
    neighbour,  ///< each process notifies those that share the edge
    gateway,    ///< the first process collects marks, drops known ones and passes the others on
};

struct RefineOptions {
    Scheme scheme = Scheme::eight;  ///< the edges that a marked cell marks
    int levels = 1;                 ///< number of levels
    /// Does not affect the result.
    Synchronisation synchronisation = Synchronisation::neighbour;
    /// A level after which the whole mesh would have more cells than this is refused.
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    /// No level of refinement or coarsening follows: a level that changes few cells then omits the
    /// time and memory for data structures that only later levels use.
    bool is_last = false;
    /// Parameters of migrating cells before a level that would leave the processes with too
    /// different numbers of cells; see AdaptiveMesh::refine_evenly(). Without a value, cells are
    /// not migrated.
    std::optional<BalanceOptions> balance = std::nullopt;
    /// Called on the first process after each level, with the level, counted from 1, and the number
    /// of cells of the whole mesh. May be empty.
    std::function<void(int level, std::uint64_t cells)> on_level;
};

/// Cost of synchronisation on this process, summed over the levels. In addition to these messages,
/// each round and each level need one maximum over all processes.
struct SynchronisationCounts {
    std::uint64_t rounds = 0;    ///< the same on all processes
    std::uint64_t messages = 0;  ///< sent by this process, or passed on by the gateway
    std::uint64_t bytes = 0;     ///< in these messages
    std::uint64_t edges = 0;     ///< marked edges in these messages

    SynchronisationCounts& operator+=(const SynchronisationCounts& more) {
        rounds += more.rounds;
        messages += more.messages;
        bytes += more.bytes;
        edges += more.edges;
        return *this;
    }
};

/// Collective. Refines the mesh in place; it stays distributed. The result and its canonical order
/// do not depend on the number of processes, the partition or the method of synchronisation. Throws
/// on all processes InputError if a rounded midpoint would make a child flat or inverted, or if the
/// mesh would have more than RefineOptions::max_cells cells, and std::bad_alloc if a process runs
/// out of memory. The mesh is then as it was before the level that failed.
SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options);

}  // namespace octetra::distributed
