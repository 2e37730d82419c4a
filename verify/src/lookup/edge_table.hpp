#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// A hash table from unordered pairs of vertices to 32-bit values. Open addressing, at most half
/// full.
class EdgeTable {
public:
    static constexpr std::uint32_t absent = 0xffffffffU;

    explicit EdgeTable(std::size_t expected) {
        std::size_t size = 16;
        while (size < 2 * expected) size *= 2;
        slots_.resize(size);
    }

    /// Returns a reference to the value of an edge; `absent` if it is new.
    [[nodiscard]] std::uint32_t& at(VertexIndex a, VertexIndex b) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = slots_[place(slots_, key(a, b))];
        if (slot.key == empty) {
            slot.key = key(a, b);
            ++count_;
        }
        return slot.value;
    }

    /// Returns the value of an edge, or `absent`.
    [[nodiscard]] std::uint32_t find(VertexIndex a, VertexIndex b) const {
        const Slot& slot = slots_[place(slots_, key(a, b))];
        return slot.key == empty ? absent : slot.value;
    }

private:
    static constexpr std::uint64_t empty = 0xffffffffffffffffU;  // no edge joins "none" with "none"
    struct Slot {
        std::uint64_t key = empty;
        std::uint32_t value = absent;
    };

    static std::uint64_t key(VertexIndex a, VertexIndex b) {
        const std::uint64_t low = a < b ? a.value() : b.value();
        const std::uint64_t high = a < b ? b.value() : a.value();
        return low << 32U | high;
    }
    static std::size_t place(const std::vector<Slot>& slots, std::uint64_t key) {
        std::uint64_t h = key * 0x9e3779b97f4a7c15U;  // Fibonacci hashing
        h ^= h >> 32U;
        std::size_t i = h & (slots.size() - 1);
        while (slots[i].key != empty && slots[i].key != key) i = (i + 1) & (slots.size() - 1);
        return i;
    }
    void grow() {
        std::vector<Slot> larger(2 * slots_.size());
        for (const Slot& slot : slots_) {
            if (slot.key != empty) larger[place(larger, slot.key)] = slot;
        }
        slots_ = std::move(larger);
    }

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
};

}  // namespace octetra::verify
