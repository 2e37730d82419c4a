#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra {

/// An index of a list of entities (facets, edges) by their vertices in any order: entities are
/// placed in buckets by smallest vertex and sorted within a bucket, because thousands may meet at
/// the hub of a fan. Keeps a pointer to the list. Memory: 4 bytes per vertex and entity.
template <class I, std::size_t N>
class VertexBuckets {
public:
    using Vertices = std::array<VertexIndex, N>;

    /// Precondition: vertex numbers are less than `vertex_count`.
    VertexBuckets(const IndexVector<I, Vertices>& list, std::size_t vertex_count)
        : list_(&list), bucket_begin_(vertex_count + 1, 0), members_(list.size()) {
        for (const Vertices& vertices : list) ++bucket_begin_[smallest(vertices)];
        std::exclusive_scan(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin(), 0U);
        auto next = bucket_begin_;
        for (I i{0}; i < list.end_index(); ++i) members_[next[smallest(list[i])]++] = i;
        for (std::size_t bucket = 0; bucket < vertex_count; ++bucket) {
            std::ranges::sort(members_.begin() + bucket_begin_[bucket],
                              members_.begin() + bucket_begin_[bucket + 1], {},
                              [&](I i) { return std::pair(sorted(list[i]), i); });
        }
    }

    /// Calls found(i) for each entity i of the list with these vertices.
    void find(const Vertices& vertices, auto&& found) const {
        const std::uint32_t bucket = smallest(vertices);
        const auto begin = members_.begin() + bucket_begin_[bucket];
        const auto end = members_.begin() + bucket_begin_[bucket + 1];
        if (begin == end) return;  // true for most vertices in the interior
        const Vertices wanted = sorted(vertices);
        auto member = std::ranges::lower_bound(begin, end, wanted, {},
                                               [&](I i) { return sorted((*list_)[i]); });
        for (; member != end && sorted((*list_)[*member]) == wanted; ++member) found(*member);
    }

    /// Calls repeated(first, i) for each entity i of the list with the same vertices as an earlier
    /// one; `first` is the first of these.
    void for_each_repeated(auto&& repeated) const {
        for (std::size_t begin = 0, k = 1; k < members_.size(); ++k) {
            const I first = members_[begin];
            if (sorted((*list_)[first]) == sorted((*list_)[members_[k]])) {
                repeated(first, members_[k]);
            } else {
                begin = k;
            }
        }
    }

private:
    static Vertices sorted(Vertices vertices) {
        std::ranges::sort(vertices);
        return vertices;
    }
    static std::uint32_t smallest(const Vertices& vertices) {
        return std::ranges::min(vertices).value();
    }

    const IndexVector<I, Vertices>* list_;
    std::vector<std::uint32_t> bucket_begin_;
    std::vector<I> members_;
};

}  // namespace octetra
