#include "rivals/ranks/number_midpoints.hpp"

#include <algorithm>
#include <array>

#include "rivals/ranks/exchange.hpp"
#include "rivals/vertex_levels.hpp"

namespace octetra::rivals {
namespace {

using Ends = std::array<std::uint64_t, 2>;

/// Collective. Returns the numbers of the midpoints of edges, from `first` in the order of their
/// ends, and advances `first` behind the last.
std::vector<std::uint64_t> numbers_of(const ProcessGroup& ranks, const std::vector<Ends>& edges,
                                      std::uint64_t& first) {
    const auto size = static_cast<std::size_t>(ranks.size());
    const std::uint64_t block = (first + size - 1) / size;  // lower ends per rank
    std::vector<std::vector<Ends>> asked(size);
    for (const Ends& ends : edges) asked[ends[0] / block].push_back(ends);
    const auto questions = all_to_all(ranks, asked);

    std::vector<Ends> all;
    for (const auto& list : questions) all.insert(all.end(), list.begin(), list.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const std::uint64_t first_here = first + ranks.sum_before(all.size());
    first += ranks.sum(all.size());

    std::vector<std::vector<std::uint64_t>> answers(size);
    for (std::size_t r = 0; r < size; ++r) {
        for (const Ends& ends : questions[r]) {
            const auto place = std::ranges::lower_bound(all, ends) - all.begin();
            answers[r].push_back(first_here + static_cast<std::uint64_t>(place));
        }
    }
    const auto heard = all_to_all(ranks, answers);
    std::vector<std::uint64_t> numbers;
    std::vector<std::size_t> at(size, 0);
    for (const Ends& ends : edges) {
        const std::size_t r = ends[0] / block;
        numbers.push_back(heard[r][at[r]++]);
    }
    return numbers;
}

}  // namespace

void number_midpoints(const ProcessGroup& ranks, std::uint64_t input_points,
                      const std::vector<EdgeVertices>& midpoint_to_edge,
                      IndexVector<VertexIndex, std::uint64_t>& numbers) {
    const std::size_t own = numbers.size();
    const auto levels = vertex_levels(midpoint_to_edge, own);
    numbers.resize(levels.size());
    std::uint64_t left = midpoint_to_edge.size();
    std::uint64_t first = input_points;
    for (std::uint32_t level = 1; ranks.sum(left) > 0; ++level) {
        std::vector<Ends> edges;
        std::vector<VertexIndex> midpoints;
        for (std::size_t i = 0; i < midpoint_to_edge.size(); ++i) {
            const VertexIndex midpoint{own + i};
            if (levels[midpoint] != level) continue;
            const auto& [a, b] = midpoint_to_edge[i];
            edges.push_back({std::min(numbers[a], numbers[b]), std::max(numbers[a], numbers[b])});
            midpoints.push_back(midpoint);
        }
        const auto made = numbers_of(ranks, edges, first);
        for (std::size_t i = 0; i < made.size(); ++i) numbers[midpoints[i]] = made[i];
        left -= made.size();
    }
}

}  // namespace octetra::rivals
