#pragma once

#include <octetra/distributed/refine.hpp>

namespace octetra::distributed {

/// Thresholds by which each process chooses its algorithm for a level. They do not affect the
/// results; only tests and benchmarks change them.
struct Tuning {
    /// A level is incremental, with work proportional to the changes, if the vertices of the marked
    /// cells are fewer than this fraction of the process's vertices; otherwise it is a full sweep
    /// of the whole part, with less work per cell. 0: always a full sweep.
    double incremental_below = 0.0625;
    /// A full sweep numbers the edges near marked cells only, if the near cells are fewer than this
    /// fraction of all cells; after a path has led further, than 1.5 times this fraction. Otherwise
    /// it numbers the edges of all cells. 0: always all.
    double local_below = 0.5;
    /// Incremental coarsening processes the descendants of the roots that lose a vertex, if they
    /// are at most this fraction of the process's cells; otherwise coarsening processes the whole
    /// part.
    double roots_below = 0.25;
};

/// Collective. Calls refine() with given thresholds.
SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options, const Tuning& tuning);

}  // namespace octetra::distributed
