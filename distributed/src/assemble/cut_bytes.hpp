#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace octetra::distributed {

/// The patterns of all steps for one root and its descendants: for each step the number of bytes,
/// and the runs; zero bytes if the step left all its cells whole. Empty for a root that was never
/// cut.
using RootBytes = std::span<const std::uint8_t>;

/// The patterns of a process's roots, by local index of the root.
struct CutRoots {
    struct Root {
        std::uint32_t index = 0;
        std::uint32_t bytes = 0;
    };
    std::vector<Root> roots;          ///< the roots that were cut in any step
    std::vector<std::uint8_t> bytes;  ///< their RootBytes, one after the other
};

}  // namespace octetra::distributed
