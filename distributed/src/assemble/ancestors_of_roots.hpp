#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Returns the ancestors of input entities: each is its own root.
[[nodiscard]] inline AncestorMap ancestors_of_roots(std::vector<std::uint64_t> numbers,
                                                    std::vector<Marker> markers) {
    AncestorMap ancestors{.roots = std::move(numbers), .first = {}, .markers = std::move(markers)};
    ancestors.first.resize(ancestors.roots.size() + 1);
    std::iota(ancestors.first.begin(), ancestors.first.end(), 0U);
    return ancestors;
}

}  // namespace octetra::distributed
