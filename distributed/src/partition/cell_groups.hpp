#pragma once

#include <cstdint>
#include <vector>

#include "partition/cell_weights.hpp"
#include "partition/longest_edges.hpp"
#include "partition/neighbours.hpp"

/// Cells that are to stay together become one node of the graph that METIS cuts. Groups are
/// numbered from 0 without gaps.
namespace octetra::distributed {

/// Cells with the same longest edge are a group: whatever is marked in one of them marks that
/// edge, so that they are bisected together. But if they weigh more than `most`, as in a wheel,
/// each of them remains alone. Groups are in the order of their edges.
[[nodiscard]] std::vector<std::int32_t> groups_of_longest_edges(const LongestEdges& edges,
                                                                const CellWeights& weights,
                                                                std::int64_t most);

/// Every cell that is alone joins the group of a neighbour, if it can in a direction in which
/// selections go, and of those in that direction the smallest; none comes to weigh more than
/// `most`, nor gets more than six cells.
void join_lone_cells(const Neighbours& neighbours, const CellWeights& weights, std::int64_t most,
                     std::vector<std::int32_t>& cell_to_group);

}  // namespace octetra::distributed
