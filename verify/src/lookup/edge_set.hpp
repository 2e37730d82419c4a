#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// The distinct edges of cells, searchable by their ends, in ascending order of (lower, higher)
/// end. Memory: 8 bytes per vertex and 4 per edge. Built in passes over ranges of lower ends,
/// because every edge is visited once for each of its cells; a single pass would take five times
/// the memory, and each pass takes time.
class EdgeSet {
public:
    EdgeSet() = default;

    /// `for_each(visit)` calls visit(edge) for each edge, possibly repeatedly; it is called once,
    /// and then once per pass. Precondition: vertices are less than `vertex_count`.
    EdgeSet(std::size_t vertex_count, auto&& for_each) : begin_(vertex_count + 1, 0) {
        // The number of visited edges, with repetitions, for each lower end.
        std::vector<std::uint32_t> room(vertex_count, 0);
        std::uint64_t total = 0;
        for_each([&](const EdgeVertices& edge) {
            ++room[lower(edge)];
            ++total;
        });
        const std::uint64_t most = std::max(total / pass_count, min_pass_size);
        for (std::size_t first = 0; first < vertex_count;) {
            std::size_t last = first;
            std::uint64_t count = 0;
            while (last < vertex_count && (last == first || count + room[last] <= most)) {
                count += room[last++];
            }
            append(first, last, room, count, for_each);
            first = last;
        }
        highs_.shrink_to_fit();
    }

    [[nodiscard]] bool contains(const EdgeVertices& edge) const {
        const auto [low, high] = std::minmax(edge[0], edge[1]);
        return std::binary_search(highs_.begin() + offset(begin_[low.value()]),
                                  highs_.begin() + offset(begin_[low.value() + 1U]), high);
    }

    [[nodiscard]] std::size_t size() const { return highs_.size(); }

    /// Calls visit(edge) for each edge, in ascending order, lower end first.
    void for_each(auto&& visit) const {
        for (std::size_t low = 0; low + 1 < begin_.size(); ++low) {
            for (std::uint64_t i = begin_[low]; i < begin_[low + 1]; ++i) {
                visit(EdgeVertices{VertexIndex{low}, highs_[i]});
            }
        }
    }

private:
    static constexpr std::uint64_t pass_count = 3;
    static constexpr std::uint64_t min_pass_size = 1U << 16U;

    static std::ptrdiff_t offset(std::uint64_t i) { return static_cast<std::ptrdiff_t>(i); }
    static std::uint32_t lower(const EdgeVertices& edge) {
        return std::min(edge[0], edge[1]).value();
    }

    /// Appends the distinct edges with lower ends first .. last-1, which are visited `count` times.
    void append(std::size_t first, std::size_t last, const std::vector<std::uint32_t>& room,
                std::uint64_t count, auto&& for_each) {
        std::vector<VertexIndex> highs(count);
        std::vector<std::uint64_t> end(last - first, 0);  // end of the range of each lower end
        for (std::size_t v = first + 1; v < last; ++v) {
            end[v - first] = end[v - first - 1] + room[v - 1];
        }
        for_each([&](const EdgeVertices& edge) {
            const std::uint32_t low = lower(edge);
            if (low < first || low >= last) return;
            highs[end[low - first]++] = std::max(edge[0], edge[1]);
        });
        auto begin = highs.begin();
        for (std::size_t v = first; v < last; ++v) {
            const auto stop = highs.begin() + offset(end[v - first]);
            std::sort(begin, stop);
            highs_.insert(highs_.end(), begin, std::unique(begin, stop));
            begin_[v + 1] = highs_.size();
            begin = stop;
        }
    }

    std::vector<std::uint64_t> begin_;
    std::vector<VertexIndex> highs_;
};

}  // namespace octetra::verify
