#pragma once

#include <octetra/distributed/refine.hpp>

namespace octetra::distributed {

/// Where a process takes which way through a level. The result is the same whatever each process
/// says here; only tests and benchmarks say anything.
struct Tuning {
    /// A level is incremental, with work in proportion to what changes, where the vertices of the
    /// marked cells are less than this share of the process's; else a full sweep, which goes
    /// through its whole part and has less work with each cell. 0: always a full sweep.
    double incremental_below = 0.0625;
    /// A full sweep numbers the edges of all cells, unless the cells close to the marked ones are
    /// less than this share of all; or less than 1.5 times this share, when paths led further.
    /// 0: always all.
    double local_below = 0.5;
    /// Coarsening that is incremental goes through the descendants of those roots that lose a
    /// vertex, where they are at most this share of the process's cells; else through its whole
    /// part.
    double roots_below = 0.25;
};

/// Collective. refine() with a tuning other than the default.
SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options, const Tuning& tuning);

}  // namespace octetra::distributed
