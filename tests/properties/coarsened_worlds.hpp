#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/reference/history.hpp>

#include "properties/draw.hpp"
#include "properties/order_classes.hpp"

/// Coarsening of the smallest meshes, compared with its laws. All points are exact.
namespace octetra::properties {

/// Describes the law that coarsening these cells breaks, or returns an empty string. The laws: the
/// remaining edges of each step are a closed set; exactly the vertices required by the rules stay;
/// the old mesh refines the new one, by at most one generation, and the new one contains the
/// unmarked cells of the old one; the new mesh conforms.
[[nodiscard]] std::string fault_of_coarsening(const reference::History& history,
                                              const reference::CellMarks& may_coarsen);

/// Histories of one step on a mesh of one cell: one for each nonempty closed set of its edges.
[[nodiscard]] std::vector<reference::History> histories_of_one_step(const Mesh& cell);

/// Compares two histories of one cell; the step of the second has fewer edges, or there is no step.
/// Describes a cell of the first mesh that lies in no cell of the second, or that has no midpoint
/// of a removed edge and is missing in the second. Empty if there is none.
[[nodiscard]] std::string fault_of_fewer_edges(const reference::History& more,
                                               const reference::History& fewer);

/// Adds a step that refines random cells by a random scheme.
[[nodiscard]] reference::History refined_at_random(const reference::History& history, Draw& draw);

/// Random marks for the cells of the history's mesh.
[[nodiscard]] reference::CellMarks random_marks(const reference::History& history, Draw& draw);

}  // namespace octetra::properties
