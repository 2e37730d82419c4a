#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>

/// Are global numbers that processes bring what they should be? Each number is looked at by one
/// process, which its value decides.
namespace octetra::distributed {

struct CheckedVertices {
    std::uint64_t count = 0;          ///< in the whole mesh
    std::vector<std::uint8_t> keeps;  ///< of each listed vertex: is it this process's?
};

/// Collective. `numbers` are this process's vertices, ascending; `used` says which of them its
/// cells have. It keeps these, and of those that no process uses the ones that it lists as the
/// first. Throws InputError on all processes if a number from 0 to the greatest is nobody's, or
/// the point, marker or attributes of a vertex differ between processes.
[[nodiscard]] CheckedVertices check_vertices(
    const Communicator& processes, const std::vector<std::uint64_t>& numbers,
    const std::vector<std::uint8_t>& used, const std::function<Point(std::size_t)>& point_at,
    const std::function<Marker(std::size_t)>& marker_at,
    const std::function<std::span<const double>(std::size_t)>& attributes_at);

/// Collective. Throws InputError on all processes unless the numbers, ascending on each, are 0 ..
/// count-1, each on one process.
void check_complete(const Communicator& processes, const std::vector<std::uint64_t>& numbers,
                    std::uint64_t count, const char* what);

}  // namespace octetra::distributed
