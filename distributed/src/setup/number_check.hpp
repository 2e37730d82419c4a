#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>

/// Checks global numbers that processes pass. Each number is checked by the process that owns its
/// block. The functions are collective and must be called within a transaction.
namespace octetra::distributed {

struct CheckedVertices {
    std::uint64_t count = 0;          ///< number of vertices in the whole mesh
    std::vector<std::uint8_t> keeps;  ///< for each listed vertex: whether this process keeps it
};

/// `numbers` are this process's vertices, ascending; `used` states which of them its
/// cells have. A process keeps these; a vertex that no process uses is kept by the lowest rank that
/// lists it. Throws InputError if a number from 0 to the greatest is not listed,
/// or if the point, marker or attributes of a vertex differ between processes.
[[nodiscard]] CheckedVertices check_vertices(
    const Communicator& processes, const std::vector<std::uint64_t>& numbers,
    const std::vector<std::uint8_t>& used, const std::function<Point(std::size_t)>& point_at,
    const std::function<Marker(std::size_t)>& marker_at,
    const std::function<std::span<const double>(std::size_t)>& attributes_at);

/// Throws InputError unless the numbers, ascending on each process, are a
/// partition of 0 .. count - 1.
void check_complete(const Communicator& processes, const std::vector<std::uint64_t>& numbers,
                    std::uint64_t count, const char* what);

}  // namespace octetra::distributed
