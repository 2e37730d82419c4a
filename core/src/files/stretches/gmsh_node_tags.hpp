#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "files/gmsh/node_numbers.hpp"
#include "files/stretches/progress.hpp"

namespace octetra::gmsh {

/// Which vertex a node's tag means, where no process has all nodes. Consecutive tags tell it
/// themselves; others are brought, with the numbers, to a process that the tag decides, which is
/// asked.
class NodeTags {
public:
    /// Collective. `tags` of this process's nodes, of which the first has the number `first`.
    /// Nothing, on all processes, if a tag is there twice or they are too far apart.
    [[nodiscard]] static std::optional<NodeTags> make(Progress& progress,
                                                      const std::vector<std::uint64_t>& tags,
                                                      std::uint64_t first);

    /// What stands for a tag until it has its number; none if there is no such node for sure.
    [[nodiscard]] VertexIndex stand_in(std::uint64_t tag) const {
        // A lower tag wraps round.
        return tag - least_ < tag_span_ ? VertexIndex{tag - least_} : VertexIndex::none();
    }

    /// Collective. Numbers in place of what stands for tags. False, on all processes, if there is
    /// no such node.
    template <class I, std::size_t N>
    [[nodiscard]] bool number(Progress& progress,
                              IndexVector<I, std::array<VertexIndex, N>>& list) const;

private:
    using Offset = std::uint32_t;  // of a tag from the least

    NodeTags(std::uint64_t least, std::uint64_t tag_span) : least_(least), tag_span_(tag_span) {}

    [[nodiscard]] std::size_t home_of(Offset offset) const {
        if (!is_dense_) {  // tags may have a common divisor, or stand in few places
            constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15;
            return (offset * golden >> 32U) % processes_;
        }
        return offset / block_;
    }
    [[nodiscard]] bool find_homes(Progress& progress, const std::vector<std::uint64_t>& tags,
                                  std::uint64_t first);
    void answer(ProcessGroup::Bytes& offsets) const;

    std::uint64_t least_ = 0;
    std::uint64_t tag_span_ = 0;  // the largest tag is one less above the least
    bool are_consecutive_ = false;
    bool is_dense_ = false;
    std::uint32_t processes_ = 1;
    Offset block_ = 1;                    // of offsets that have one home, where tags are dense
    NodeNumbers tags_here_;               // whose home this process is
    std::vector<std::uint32_t> numbers_;  // of these
};

}  // namespace octetra::gmsh
