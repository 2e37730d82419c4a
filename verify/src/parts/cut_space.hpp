#pragma once

#include <vector>

#include <octetra/core/process_group.hpp>

#include "lookup/box_tree.hpp"
#include "parts/domain.hpp"

namespace octetra::verify {

/// Collective. Divides space into one domain for each process, such that each contains about the
/// same number of `places`, of all processes together. The result is the same on all processes.
[[nodiscard]] std::vector<Domain> cut_space(const std::vector<Point>& places,
                                            const ProcessGroup& group);

/// Returns the closed intersection of the domain with `bounds`, possibly empty.
[[nodiscard]] Bounds closed_box(const Domain& domain, const Bounds& bounds);

}  // namespace octetra::verify
