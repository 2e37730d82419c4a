#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::gmsh {

/// Which vertex a node's tag means: vertices are numbered as nodes stand in the file. Consecutive
/// tags take no memory, others 16 bytes a node, and while they come up to twice that.
class NodeNumbers {
public:
    /// The next node.
    void add(std::uint64_t tag) {
        if (others_.empty() && (count_ == 0 || tag == first_ + count_)) {
            if (count_ == 0) first_ = tag;
        } else {
            add_other(tag);
        }
        ++count_;
    }

    /// All nodes have come. Returns one whose tag an earlier one has, if there is such a one: its
    /// number, and the tag.
    struct Repeated {
        std::uint64_t node;
        std::uint64_t tag;
    };
    [[nodiscard]] std::optional<Repeated> complete();

    /// None if there is no such node.
    [[nodiscard]] VertexIndex find(std::uint64_t tag) const {
        if (is_consecutive_) {
            // A lower tag wraps round.
            return tag - first_ < count_ ? VertexIndex{tag - first_} : VertexIndex::none();
        }
        if (!table_.empty()) {
            return tag - first_ < table_.size() ? table_[tag - first_] : VertexIndex::none();
        }
        return search(tag);
    }

    [[nodiscard]] std::uint64_t size() const { return count_; }

private:
    using TaggedVertex = std::pair<std::uint64_t, VertexIndex>;

    void add_other(std::uint64_t tag);
    [[nodiscard]] std::optional<Repeated> make_table(std::uint64_t last);
    [[nodiscard]] VertexIndex search(std::uint64_t tag) const;

    std::uint64_t first_ = 0;  // the least tag, in the end
    std::uint64_t count_ = 0;
    bool is_consecutive_ = true;
    std::vector<TaggedVertex> others_;  // all, unless they are consecutive
    std::vector<VertexIndex> table_;    // by tag - first_
};

}  // namespace octetra::gmsh
