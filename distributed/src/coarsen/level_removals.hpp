#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "coarsen/kept_vertices.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {

/// Records for each level whether all vertices are kept, all are removed, or neither.
class LevelRemovals {
public:
    LevelRemovals(const VertexLevels& levels, const KeptVertices& kept)
        : has_kept_(levels.count() + 1, 1), has_removed_(levels.count() + 1, 0) {
        for (std::uint32_t level = 1; level <= levels.count(); ++level) {
            const std::size_t begin = levels.begin(level).value();
            const std::size_t end = std::min<std::size_t>(levels.end(level).value(), kept.size());
            has_kept_[level] = has(1, kept, begin, end);
            has_removed_[level] = has(0, kept, begin, end);
        }
    }
    [[nodiscard]] bool all_kept(std::uint32_t level) const { return has_removed_[level] == 0; }
    [[nodiscard]] bool all_removed(std::uint32_t level) const { return has_kept_[level] == 0; }
    [[nodiscard]] bool is_divided(std::uint32_t level) const {
        return has_kept_[level] != 0 && has_removed_[level] != 0;
    }

private:
    static std::uint8_t has(int value, const KeptVertices& kept, std::size_t begin,
                            std::size_t end) {
        if (begin >= end) return 0;
        return std::memchr(kept.data() + begin, value, end - begin) == nullptr ? 0 : 1;
    }

    std::vector<std::uint8_t> has_kept_;
    std::vector<std::uint8_t> has_removed_;
};

}  // namespace octetra::distributed
