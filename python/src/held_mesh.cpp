#include "held_mesh.hpp"

#include <algorithm>

namespace octetra::python {

std::shared_ptr<Memory> Mesh::hold(Array array) {
    std::shared_ptr<Memory> memory = held_[array].lock();
    if (!memory) {
        memory = std::make_shared<Memory>(Memory{shared_from_this()});
        held_[array] = memory;
    }
    return memory;
}

void Mesh::detach_arrays() {
    const auto in_use = [&](Array array) { return !held_[array].expired(); };
    const od::ArraysInUse arrays{.points = in_use(points),
                                 .cells = in_use(cells),
                                 .facets = in_use(facets),
                                 .edges = in_use(edges),
                                 .vertex_numbers = in_use(vertex_numbers),
                                 .roots = in_use(roots)};
    const bool none = std::ranges::all_of(held_, [](const auto& held) { return held.expired(); });
    if (none) return;
    const auto left = std::make_shared<od::DetachedArrays>();  // first, as the allocation may fail
    *left = mesh_.detach_arrays(arrays);
    for (std::weak_ptr<Memory>& held : held_) {
        if (const auto memory = held.lock()) memory->owner = left;
        held.reset();
    }
}

}  // namespace octetra::python
