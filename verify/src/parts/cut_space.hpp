#pragma once

#include <vector>

#include <octetra/core/process_group.hpp>

#include "lookup/box_tree.hpp"
#include "parts/domain.hpp"

namespace octetra::verify {

/// Collective. Cuts space into one domain for each process, so that about as many of `places`, of
/// all processes together, fall into each. The same on all processes.
[[nodiscard]] std::vector<Domain> cut_space(const std::vector<Point>& places,
                                            const ProcessGroup& group);

/// The domain as far as it lies in `bounds`, closed; empty if it does not.
[[nodiscard]] Bounds closed_box(const Domain& domain, const Bounds& bounds);

}  // namespace octetra::verify
