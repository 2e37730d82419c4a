#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include <octetra/core/error.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/core/process_group.hpp>

#include "files/stretches/shares.hpp"

/// How processes find their shares of a mesh file. In a text file, a line belongs to the process in
/// whose share of the bytes it begins, and the number of lines of lower ranks is the number of the
/// first entity. In a Medit text file all processes search for the lines with keywords first. In a
/// binary Medit file the counts of rows determine the shares. In a Gmsh file nodes and elements are
/// in blocks whose places are known only from the blocks before, so the first process reads the
/// heads of all blocks (gmsh_blocks.hpp); rows of text are located by counts of lines
/// (line_index.hpp). Node tags that are not consecutive are resolved by a rendezvous
/// (gmsh_node_tags.hpp).
namespace octetra {

/// Collective, as read_mesh_share().
[[nodiscard]] std::optional<MeshShare> read_gmsh_share(const std::filesystem::path& path,
                                                       const ProcessGroup& group);

/// Returns the capacity to reserve for a process's share of a list of `count` entities:
/// proportional to its bytes, plus a quarter, because some lines are shorter. Unused capacity
/// occupies no memory.
[[nodiscard]] inline std::uint64_t room_for(std::uint64_t count, const FileRange& share,
                                            const FileRange& whole) {
    if (whole.size() == 0) return 0;
    const double entities = static_cast<double>(count) * static_cast<double>(share.size()) /
                            static_cast<double>(whole.size());
    return std::min(count, static_cast<std::uint64_t>(1.25 * entities) + 16);
}

/// Collective. Returns the number of this process's first entity, the sum of `read` over lower
/// ranks. Throws InputError on all processes if the total differs from the announced number.
[[nodiscard]] inline std::uint64_t number_share(const ProcessGroup& group, std::uint64_t read,
                                                std::uint64_t announced) {
    if (group.sum(read) != announced) throw InputError("the count differs from the announced one");
    return group.sum_before(read);
}

}  // namespace octetra
