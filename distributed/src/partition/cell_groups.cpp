#include "partition/cell_groups.hpp"

#include <algorithm>

namespace octetra::distributed {
namespace {

std::size_t number(std::int32_t group) { return static_cast<std::size_t>(group); }

struct Size {
    std::uint32_t cells = 0;
    std::int32_t weight = 0;  ///< the sum over all groups is less than 2^31
};

std::vector<Size> sizes_of(const std::vector<std::int32_t>& cell_to_group,
                           const CellWeights& weights) {
    std::vector<Size> sizes;
    for (std::size_t c = 0; c < cell_to_group.size(); ++c) {
        const std::size_t group = number(cell_to_group[c]);
        if (group >= sizes.size()) sizes.resize(group + 1);
        ++sizes[group].cells;
        sizes[group].weight += weights.of(CellIndex{c});
    }
    return sizes;
}

/// Renumbers the groups without empty ones.
void renumber(const std::vector<Size>& sizes, std::vector<std::int32_t>& cell_to_group) {
    std::vector<std::int32_t> renumbered(sizes.size());
    std::int32_t count = 0;
    for (std::size_t group = 0; group < sizes.size(); ++group) {
        renumbered[group] = count;
        if (sizes[group].cells > 0) ++count;
    }
    for (std::int32_t& group : cell_to_group) group = renumbered[number(group)];
}

}  // namespace

std::vector<std::int32_t> groups_of_longest_edges(const LongestEdges& edges,
                                                  const CellWeights& weights, std::int64_t most) {
    std::vector<std::int32_t> cell_to_group(edges.cell_count());
    std::int32_t group = 0;
    for (EdgeIndex e{0}; e < edges.end_index(); ++e) {
        const bool together = weights.of_all(edges.cells_of(e)) <= most;
        for (const CellIndex c : edges.cells_of(e)) {
            cell_to_group[c.value()] = group;
            if (!together) ++group;
        }
        if (together) ++group;
    }
    return cell_to_group;
}

void join_single_cells(const Neighbours& neighbours, const CellWeights& weights, std::int64_t most,
                       std::vector<std::int32_t>& cell_to_group) {
    constexpr std::uint32_t max_group_cells = 6;
    auto sizes = sizes_of(cell_to_group, weights);
    for (CellIndex c{0}; c < neighbours.end_index(); ++c) {
        std::int32_t& group = cell_to_group[c.value()];
        if (sizes[number(group)].cells > 1) continue;
        const std::int32_t weight = weights.of(c);
        std::int32_t best = group;
        std::uint32_t best_paths = 0;
        for (const Neighbour neighbour : neighbours[c]) {
            if (neighbour.cell == Neighbour::none) break;
            const std::int32_t other = cell_to_group[neighbour.cell];
            const Size& size = sizes[number(other)];
            if (size.cells >= max_group_cells || std::int64_t{size.weight} + weight > most)
                continue;
            const bool is_better =
                best == group || neighbour.paths > best_paths ||
                (neighbour.paths == best_paths && size.cells < sizes[number(best)].cells);
            if (!is_better) continue;
            best = other;
            best_paths = neighbour.paths;
        }
        if (best == group) continue;
        sizes[number(group)] = {};
        ++sizes[number(best)].cells;
        sizes[number(best)].weight += weight;
        group = best;
    }
    renumber(sizes, cell_to_group);
}

}  // namespace octetra::distributed
