#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>

#include "files/gmsh/intake/node_numbers.hpp"

namespace octetra::gmsh {

/// Maps node tags to vertex numbers if no process has all nodes. Consecutive tags are mapped by
/// subtraction; others are sent, with their numbers, to an owner that the tag determines, which
/// answers requests.
class NodeTags {
public:
    /// Collective, within a transaction. `here`: the nodes of this process, which follow those of
    /// lower ranks. Throws if a tag occurs twice, or if the range of tags is too large.
    NodeTags(const ProcessGroup& group, const NodeNumbers& here);

    /// Returns a map of tags to provisional indices; it has each tag of a node, but also others.
    [[nodiscard]] NodeNumbers provisional() const { return {least_, tag_span_}; }

    /// Collective, within a transaction. Replaces provisional indices by vertex numbers. Throws if
    /// one of them has no node.
    template <class I, std::size_t N>
    void number(IndexVector<I, std::array<VertexIndex, N>>& list) const;

private:
    using Offset = std::uint32_t;  // of a tag from the least one

    [[nodiscard]] std::size_t owner_of(Offset offset) const {
        if (!is_dense_) {  // tags may have a common divisor, or be concentrated
            constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15;
            return (offset * golden >> 32U) % processes_;
        }
        return offset / block_;
    }
    void send_to_owners(const NodeNumbers& here);
    void answer(ProcessGroup::Bytes& offsets) const;

    const ProcessGroup* group_;
    std::uint64_t least_ = 0;
    std::uint64_t tag_span_ = 0;  // the greatest tag minus the least one, plus 1
    bool are_consecutive_ = true;
    bool is_dense_ = false;
    std::uint32_t processes_;
    Offset block_ = 1;                    // offsets per owner, if tags are dense
    NodeNumbers tags_here_;               // the tags that this process owns
    std::vector<std::uint32_t> numbers_;  // their vertex numbers
};

}  // namespace octetra::gmsh
