#include "cell_groups.hpp"

#include <algorithm>

namespace octetra::distributed {
namespace {

std::size_t number(std::int32_t group) { return static_cast<std::size_t>(group); }

std::vector<std::uint32_t> sizes_of(const std::vector<std::int32_t>& cell_to_group) {
    std::vector<std::uint32_t> sizes;
    for (const std::int32_t group : cell_to_group) {
        if (number(group) >= sizes.size()) sizes.resize(number(group) + 1, 0);
        ++sizes[number(group)];
    }
    return sizes;
}

/// Closes the gaps that empty groups have left.
void renumber(const std::vector<std::uint32_t>& sizes, std::vector<std::int32_t>& cell_to_group) {
    std::vector<std::int32_t> renumbered(sizes.size());
    std::int32_t count = 0;
    for (std::size_t group = 0; group < sizes.size(); ++group) {
        renumbered[group] = count;
        if (sizes[group] > 0) ++count;
    }
    for (std::int32_t& group : cell_to_group) group = renumbered[number(group)];
}

}  // namespace

std::vector<std::int32_t> groups_of_longest_edges(const LongestEdges& edges,
                                                  std::size_t most_cells) {
    std::vector<std::int32_t> cell_to_group(edges.cell_count());
    std::int32_t group = 0;
    for (EdgeIndex e{0}; e < edges.end_index(); ++e) {
        const bool together = edges.cells_of(e).size() <= most_cells;
        for (const CellIndex c : edges.cells_of(e)) {
            cell_to_group[c.value()] = group;
            if (!together) ++group;
        }
        if (together) ++group;
    }
    return cell_to_group;
}

void join_lone_cells(const Neighbours& neighbours, std::size_t most_cells,
                     std::vector<std::int32_t>& cell_to_group) {
    auto sizes = sizes_of(cell_to_group);
    for (CellIndex c{0}; c < neighbours.end_index(); ++c) {
        std::int32_t& group = cell_to_group[c.value()];
        if (sizes[number(group)] > 1) continue;
        std::int32_t best = group;
        std::uint32_t best_paths = 0;
        for (const Neighbour neighbour : neighbours[c]) {
            if (neighbour.cell == Neighbour::none) break;
            const std::int32_t other = cell_to_group[neighbour.cell];
            if (sizes[number(other)] >= most_cells) continue;
            const bool is_better =
                best == group || neighbour.paths > best_paths ||
                (neighbour.paths == best_paths && sizes[number(other)] < sizes[number(best)]);
            if (!is_better) continue;
            best = other;
            best_paths = neighbour.paths;
        }
        --sizes[number(group)];
        ++sizes[number(best)];
        group = best;
    }
    renumber(sizes, cell_to_group);
}

}  // namespace octetra::distributed
