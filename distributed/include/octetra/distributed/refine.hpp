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

/// How processes tell each other which shared edges they have marked.
enum class Synchronisation {
    neighbour,  ///< processes that share an edge tell each other
    gateway,    ///< the first process collects all, drops what is known, informs those concerned
};

struct RefineOptions {
    Scheme scheme = Scheme::eight;
    int levels = 1;
    Synchronisation synchronisation = Synchronisation::neighbour;
    /// A level that would make more cells than this, of the whole mesh, is not begun.
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    /// The mesh is not refined or coarsened after this: a level that changes little then takes no
    /// time and memory for what would make later ones of that kind cheap.
    bool is_last = false;
    /// Whether cells move before a level that would leave processes with too different numbers of
    /// them: see AdaptiveMesh::refine_evenly().
    std::optional<BalanceOptions> balance = std::nullopt;
    /// Told on the first process, after each level, of the level (from 1) and of the cells that the
    /// whole mesh now has. May be empty.
    std::function<void(int level, std::uint64_t cells)> on_level;
};

/// What synchronisation took, on this process, summed over the levels. Beside its messages every
/// round, and once more every level, takes a maximum over all processes.
struct SynchronisationCounts {
    std::uint64_t rounds = 0;    ///< the same on all processes
    std::uint64_t messages = 0;  ///< sent by this process; by the gateway, also those passed on
    std::uint64_t bytes = 0;     ///< in these messages
    std::uint64_t edges = 0;     ///< selections in these messages

    SynchronisationCounts& operator+=(const SynchronisationCounts& more) {
        rounds += more.rounds;
        messages += more.messages;
        bytes += more.bytes;
        edges += more.edges;
        return *this;
    }
};

/// Collective. Refines in place; the mesh stays distributed. What is in which order afterwards, and
/// what it is, does not depend on the number of processes, the partition or the synchronisation.
/// Throws InputError on all processes where a rounded midpoint would flatten or invert a cell, or
/// where there would be more cells than allowed, and std::bad_alloc on all where one has no memory;
/// the mesh is then as it was before the level that failed.
SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options);

}  // namespace octetra::distributed
