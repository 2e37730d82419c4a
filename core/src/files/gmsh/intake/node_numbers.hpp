#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::gmsh {

/// Maps node tags to vertices, which are numbered in file order. Consecutive tags take no memory;
/// other tags take 16 bytes per node, and up to twice that while they are added.
class NodeNumbers {
public:
    NodeNumbers() = default;
    /// Nodes with `count` consecutive tags.
    NodeNumbers(std::uint64_t first, std::uint64_t count) : first_(first), count_(count) {}

    /// Adds the next node.
    void add(std::uint64_t tag) {
        if (others_.empty() && (count_ == 0 || tag == first_ + count_)) {
            if (count_ == 0) first_ = tag;
        } else {
            add_other(tag);
        }
        ++count_;
    }

    /// Completes the map after all nodes have been added. Returns a node whose tag an earlier node
    /// has, if any: its number and the tag.
    struct Repeated {
        std::uint64_t node;
        std::uint64_t tag;
    };
    [[nodiscard]] std::optional<Repeated> complete();

    /// Returns none() if there is no node with this tag.
    [[nodiscard]] VertexIndex find(std::uint64_t tag) const {
        if (is_consecutive_) {
            // A tag below first_ wraps around.
            return tag - first_ < count_ ? VertexIndex{tag - first_} : VertexIndex::none();
        }
        if (!table_.empty()) {
            return tag - first_ < table_.size() ? table_[tag - first_] : VertexIndex::none();
        }
        return search(tag);
    }

    [[nodiscard]] std::uint64_t size() const { return count_; }
    [[nodiscard]] bool are_consecutive() const { return is_consecutive_; }
    /// Returns the tag of a node, before complete().
    [[nodiscard]] std::uint64_t tag(std::uint64_t node) const {
        return is_consecutive_ ? first_ + node : others_[node].first;
    }

private:
    using TaggedVertex = std::pair<std::uint64_t, VertexIndex>;

    void add_other(std::uint64_t tag);
    [[nodiscard]] std::optional<Repeated> make_table(std::uint64_t last);
    [[nodiscard]] VertexIndex search(std::uint64_t tag) const;

    std::uint64_t first_ = 0;  // the least tag, once complete
    std::uint64_t count_ = 0;
    bool is_consecutive_ = true;
    std::vector<TaggedVertex> others_;  // all nodes, unless tags are consecutive
    std::vector<VertexIndex> table_;    // by tag - first_
};

}  // namespace octetra::gmsh
