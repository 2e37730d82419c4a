#pragma once

namespace octetra {

/// The rule by which marked edges force others to be marked.
enum class Closure {
    /// A face with a marked edge has its longest edge marked.
    longest_edge,
    /// In addition, cells that were bisected by some of their edges only are not bisected further:
    /// they are replaced by the eight children of their parent. The shapes of all cells are then
    /// bounded, however often the mesh is refined.
    regular,
};

}  // namespace octetra
