#pragma once

#include <cstdint>

namespace octetra::distributed {

/// Two numbers that are computed with at once. An extension that gcc and clang have in common; they
/// make vector instructions of it where the machine has any.
using Pair = double __attribute__((vector_size(16)));

/// What comparing pairs yields: all bits of a half are set where it is true.
using PairMask = std::int64_t __attribute__((vector_size(16)));

/// The bits of both halves.
[[nodiscard]] inline unsigned bits_of(PairMask mask) {
    return static_cast<unsigned>(mask[0] | mask[1]);
}

}  // namespace octetra::distributed
