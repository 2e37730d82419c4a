#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "rivals/terminal_edges.hpp"

/// A model, in one process, of what terminal-edge bisection on ranks would have to tell.
namespace octetra::rivals {

/// Of all parts together.
struct PartsCounts {
    std::uint64_t rounds = 0;    ///< in which any part has something to say
    std::uint64_t messages = 0;  ///< from a part to another in a round, if it has anything to say
    std::uint64_t bytes = 0;     ///< four for an edge that a message names
    std::uint64_t asked = 0;     ///< times that a part tells another that it wants an edge
    std::uint64_t ready = 0;     ///< times that a part tells another that it has no cell in its way
    std::uint64_t shared_edges_bisected = 0;
    std::uint64_t cells = 0;  ///< of the refined mesh
};

/// In a round every part does all that it can by itself: it follows paths, and bisects terminal
/// edges that it has alone, over and over. An edge that several have is bisected by all of them in
/// the round after the last of them has said that nothing is in its way; and a part that wants one
/// tells the others, who follow the path from it in the next round. What becomes of the border is
/// then the same on both sides, without a message. Cells stay with the part of their root; a
/// partition has a part for each cell, from 0.
///
/// Throws what TerminalEdgeBisection does.
[[nodiscard]] PartsCounts count_on_parts(const Mesh& mesh, const Goal& goal,
                                         const std::vector<int>& part_of_cell);

}  // namespace octetra::rivals
