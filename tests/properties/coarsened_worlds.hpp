#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/reference/history.hpp>

#include "properties/draw.hpp"
#include "properties/order_classes.hpp"

/// Coarsening of the smallest meshes, held against its laws. All points are exact.
namespace octetra::properties {

/// What coarsening these cells breaks: that the edges left of each step are a closed set, that the
/// rules force the vertices that stay, and no other; that the old mesh refines the new one, by one
/// generation at most, and has its unmarked cells there; that the new one conforms. Nothing if it
/// breaks no law.
[[nodiscard]] std::string fault_of_coarsening(const reference::History& history,
                                              const reference::CellMarks& may_go);

/// The first step of a mesh of one cell: all sets of its edges that are closed, but the empty one.
[[nodiscard]] std::vector<reference::History> histories_of_one_step(const Mesh& cell);

/// What is wrong if the first history makes something of one cell in a step that the second, whose
/// step has fewer edges or no step at all, does not contain: cells that lie in none of its, or that
/// have no midpoint of the edges that are missing and are not there. Or nothing.
[[nodiscard]] std::string fault_of_fewer_edges(const reference::History& more,
                                               const reference::History& fewer);

/// One step more, of random cells by a random scheme.
[[nodiscard]] reference::History refined_at_random(const reference::History& history, Draw& draw);

/// Each cell of the history's mesh, or not.
[[nodiscard]] reference::CellMarks random_marks(const reference::History& history, Draw& draw);

}  // namespace octetra::properties
