#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <octetra/distributed/entity_transfer.hpp>

namespace octetra::distributed {

/// For each entity of a list, the entity before a step of which it is a part, and the number of
/// bisections between them.
struct Descent {
    std::vector<std::uint32_t> before;
    std::vector<std::uint8_t> halvings;

    Descent() = default;
    /// `count` entities before the first level of a step.
    explicit Descent(std::size_t count) : before(count), halvings(count, 0) {
        std::iota(before.begin(), before.end(), 0U);
    }

    /// Appends a level that gave new numbers to all entities.
    void append(const EntityTransfer& level) {
        Descent after;
        after.before.reserve(level.count());
        after.halvings.reserve(level.count());
        level.for_each_new([&](std::size_t, std::size_t parent, unsigned more) {
            after.before.push_back(before[parent]);
            after.halvings.push_back(static_cast<std::uint8_t>(halvings[parent] + more));
        });
        *this = std::move(after);
    }
};

}  // namespace octetra::distributed
