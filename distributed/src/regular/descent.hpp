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

    /// Appends a level.
    void append(const EntityTransfer& level) {
        if (level.keeps_numbers()) {
            append_in_place(level);
            return;
        }
        Descent after;
        after.before.reserve(level.count());
        after.halvings.reserve(level.count());
        level.for_each_new([&](std::size_t, std::size_t parent, unsigned more) {
            after.before.push_back(before[parent]);
            after.halvings.push_back(static_cast<std::uint8_t>(halvings[parent] + more));
        });
        *this = std::move(after);
    }

    /// The entities get new numbers: `previous` has the present number of each.
    template <class I>
    void reorder(const std::vector<I>& previous) {
        if (previous.empty()) return;
        Descent after;
        after.before.reserve(previous.size());
        after.halvings.reserve(previous.size());
        for (const I i : previous) {
            after.before.push_back(before[i.value()]);
            after.halvings.push_back(halvings[i.value()]);
        }
        *this = std::move(after);
    }

private:
    void append_in_place(const EntityTransfer& level) {
        before.resize(level.count());
        halvings.resize(level.count());
        std::uint8_t of_parent = 0;  // the first child replaces the parent
        level.for_each_new([&](std::size_t number, std::size_t parent, unsigned more) {
            if (number == parent) of_parent = halvings[parent];
            before[number] = before[parent];
            halvings[number] = static_cast<std::uint8_t>(of_parent + more);
        });
    }
};

}  // namespace octetra::distributed
