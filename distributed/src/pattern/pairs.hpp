#pragma once

#include <cstdint>

namespace octetra::distributed {

/// Two numbers for parallel computation: a vector extension of gcc and clang, which compile it to
/// vector instructions if the machine has them.
using Pair = double __attribute__((vector_size(16)));

/// Result of comparing pairs: all bits of an element are set where the comparison is true.
using PairMask = std::int64_t __attribute__((vector_size(16)));

/// Returns the bits of both elements combined.
[[nodiscard]] inline unsigned bits_of(PairMask mask) {
    return static_cast<unsigned>(mask[0] | mask[1]);
}

}  // namespace octetra::distributed
