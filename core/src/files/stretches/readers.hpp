#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra {

/// Collective, as read_stretch().
[[nodiscard]] std::optional<MeshStretch> read_tetgen_stretch(const std::filesystem::path& path,
                                                             const ProcessGroup& group);
[[nodiscard]] std::optional<MeshStretch> read_medit_stretch(const std::filesystem::path& path,
                                                            const ProcessGroup& group);
[[nodiscard]] std::optional<MeshStretch> read_meshb_stretch(const std::filesystem::path& path,
                                                            const ProcessGroup& group);

[[nodiscard]] std::optional<MeshStretch> read_gmsh_stretch(const std::filesystem::path& path,
                                                           const ProcessGroup& group);

/// Collective. What is told of a mesh of Medit's or Gmsh's once all have their shares: `counts` has
/// how many there are of each kind. Markers that are 0 on all processes are dropped.
void settle_facts(const MeshFacts& counts, const ProcessGroup& group, MeshStretch& stretch);

/// Room for the entities of a process's share of a list, of which the whole is `count`: in
/// proportion to the bytes, and a quarter more, as some lines are shorter. What is not used of it
/// takes no memory.
[[nodiscard]] inline std::size_t room_for(std::uint64_t count, std::uint64_t share,
                                          std::uint64_t whole) {
    if (whole == 0) return 0;
    const double entities =
        static_cast<double>(count) * static_cast<double>(share) / static_cast<double>(whole);
    return std::min(count, static_cast<std::uint64_t>(1.25 * entities) + 16);
}

/// Collective. The number of this process's first entity: those that lower ranks have `read` come
/// before. `well` becomes false, on all processes, if they are not as many as announced.
[[nodiscard]] inline std::uint64_t number_stretch(const ProcessGroup& group, std::uint64_t read,
                                                  std::uint64_t announced, bool& well) {
    well = group.sum(read) == announced && well;
    return group.sum_before(read);
}

}  // namespace octetra
