#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octetra/core/mesh_source.hpp>

namespace octetra::gmsh {

/// Entities one after the other in the canonical order that have one marker, all of those that
/// stand together.
struct MarkerRun {
    std::uint64_t first = 0;
    std::uint64_t length = 0;
    Marker marker = 0;
};

/// The markers of a kind of entity, as its list has them.
struct MarkerRuns {
    std::uint64_t count = 0;      ///< of all runs
    std::vector<MarkerRun> here;  ///< those that begin in this process's stretch, ascending
    std::vector<Marker> markers;  ///< all there are, ascending, each once
};

/// Collective. A process's stretch is that of share_window(). Without `markers` all are 0.
[[nodiscard]] MarkerRuns find_marker_runs(
    std::uint64_t count, const ProcessGroup& group,
    const std::function<std::span<const Marker>(const Window&)>& markers);

}  // namespace octetra::gmsh
