#pragma once

#include <cstdint>
#include <vector>

#include "partition/cell_weights.hpp"
#include "partition/longest_edges.hpp"
#include "partition/neighbours.hpp"

/// Groups of cells that stay together: each becomes one node of the graph that METIS partitions.
/// Groups are numbered from 0 without gaps.
namespace octetra::distributed {

/// Returns the group of each cell. Cells with the same longest edge form a group: any mark in one
/// of them marks that edge, so that they are bisected together. If they weigh more than `most`, as
/// in a wheel, each of them is a separate group. Groups are in the order of their edges.
[[nodiscard]] std::vector<std::int32_t> groups_of_longest_edges(const LongestEdges& edges,
                                                                const CellWeights& weights,
                                                                std::int64_t most);

/// Joins each single cell to the group of a neighbour: preferably one through a face along which
/// marks propagate, and among these the smallest. No group may exceed the weight `most` or six
/// cells.
void join_single_cells(const Neighbours& neighbours, const CellWeights& weights, std::int64_t most,
                       std::vector<std::int32_t>& cell_to_group);

}  // namespace octetra::distributed
