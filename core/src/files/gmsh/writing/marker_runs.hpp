#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octetra/core/mesh_source.hpp>

namespace octetra::gmsh {

/// A maximal run of consecutive entities in canonical order with the same marker.
struct MarkerRun {
    std::uint64_t first = 0;
    std::uint64_t length = 0;
    Marker marker = 0;
};

/// The runs and markers of a kind of entity.
struct MarkerRuns {
    std::uint64_t count = 0;      ///< number of runs on all processes
    std::vector<MarkerRun> here;  ///< runs that begin in this process's share, ascending
    std::vector<Marker> markers;  ///< the distinct markers on all processes, ascending
};

/// Collective. The share of a process is that of share_window(). If `markers` is empty, all markers
/// are 0.
[[nodiscard]] MarkerRuns find_marker_runs(
    std::uint64_t count, const ProcessGroup& group,
    const std::function<std::span<const Marker>(const Window&)>& markers);

}  // namespace octetra::gmsh
