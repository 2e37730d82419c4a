#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "files/gmsh/node_numbers.hpp"
#include "files/shares/status.hpp"

namespace octetra::gmsh {

/// Maps node tags to vertex numbers if no process has all nodes. Consecutive tags are mapped by
/// subtraction; others are sent, with their numbers, to an owner that the tag determines, which
/// answers requests.
class NodeTags {
public:
    /// Collective. `tags` are those of this process's nodes, the first of which has the number
    /// `first`. Returns nothing on all processes if a tag occurs twice, or if the range of tags is
    /// too large.
    [[nodiscard]] static std::optional<NodeTags> make(CollectiveStatus& status,
                                                      const std::vector<std::uint64_t>& tags,
                                                      std::uint64_t first);

    /// Returns a provisional index for a tag until its number is known, or none() if there is
    /// certainly no such node.
    [[nodiscard]] VertexIndex provisional_index(std::uint64_t tag) const {
        // a lower tag wraps around
        return tag - least_ < tag_span_ ? VertexIndex{tag - least_} : VertexIndex::none();
    }

    /// Collective. Replaces provisional indices by vertex numbers. Returns false on all processes
    /// if one of them has no node.
    template <class I, std::size_t N>
    [[nodiscard]] bool number(CollectiveStatus& status,
                              IndexVector<I, std::array<VertexIndex, N>>& list) const;

private:
    using Offset = std::uint32_t;  // of a tag from the least one

    NodeTags(std::uint64_t least, std::uint64_t tag_span) : least_(least), tag_span_(tag_span) {}

    [[nodiscard]] std::size_t owner_of(Offset offset) const {
        if (!is_dense_) {  // tags may have a common divisor, or be concentrated
            constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15;
            return (offset * golden >> 32U) % processes_;
        }
        return offset / block_;
    }
    [[nodiscard]] bool send_to_owners(CollectiveStatus& status,
                                      const std::vector<std::uint64_t>& tags, std::uint64_t first);
    void answer(ProcessGroup::Bytes& offsets) const;

    std::uint64_t least_ = 0;
    std::uint64_t tag_span_ = 0;  // the greatest tag minus the least one, plus 1
    bool are_consecutive_ = false;
    bool is_dense_ = false;
    std::uint32_t processes_ = 1;
    Offset block_ = 1;                    // offsets per owner, if tags are dense
    NodeNumbers tags_here_;               // the tags that this process owns
    std::vector<std::uint32_t> numbers_;  // their vertex numbers
};

}  // namespace octetra::gmsh
