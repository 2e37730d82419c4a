#pragma once

#include <algorithm>
#include <cstdint>

#include <octetra/core/mesh_source.hpp>

#include "files/output/output_file.hpp"

namespace octetra {

/// How much of a list of text lines each process makes before the group takes turns: little enough
/// for a buffer, much enough that turns are rare; of a small list, an equal share.
[[nodiscard]] inline std::uint64_t lines_of_a_turn(std::uint64_t count, const ProcessGroup& group) {
    const std::uint64_t most = group.size() > 1 ? 1U << 15U : 1U << 12U;
    return std::clamp(count / static_cast<std::uint64_t>(group.size()) + 1, std::uint64_t{1}, most);
}

/// Collective. Calls put_slice(window, number of the slice's first entity) for this process's
/// slices of a list, in turns with the other processes.
void put_list(OutputFile& out, std::uint64_t count, const ProcessGroup& group, auto&& put_slice) {
    const std::uint64_t length = lines_of_a_turn(count, group);
    const std::uint64_t stride = length * static_cast<std::uint64_t>(group.size());
    for (Window window{0, length, count}; window.begin < count; window.begin += stride) {
        put_slice(window, window.begin_of(group.rank()));
        if (group.size() > 1) out.end_turn_later();
    }
}

}  // namespace octetra
