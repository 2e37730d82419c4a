#pragma once

#include <cstdint>
#include <memory>

#include <octetra/core/process_group.hpp>

#include "rivals/ranks/part_of_mesh.hpp"
#include "rivals/terminal_edges.hpp"

/// Terminal-edge bisection by ranks that have a part of the mesh each, and nothing else of it.
namespace octetra::rivals {

/// What it took to reach a goal.
struct Traffic {
    std::uint64_t rounds = 0;    ///< in which any rank has something to say
    std::uint64_t messages = 0;  ///< of this rank; none to one that it has nothing to say to
    std::uint64_t bytes = 0;     ///< in them: four for an edge
    std::uint64_t asked = 0;     ///< times that this rank tells another that it wants an edge
    std::uint64_t ready = 0;     ///< times that it tells another that it has no cell in its way
    std::uint64_t shared_edges_bisected = 0;  ///< of this rank's
};

/// In a round every rank does all that it can by itself: it follows paths, and bisects terminal
/// edges that it has alone, over and over. An edge that several have is bisected by all of them in
/// the round after the last of them has said that nothing is in its way; and a rank that wants one
/// tells the others, who follow the path from it in the next round. Stars are disjoint, and what is
/// to be cut does not depend on the order, so the result is that of TerminalEdgeBisection, whatever
/// the partition.
///
/// All functions are collective, and throw the same on all ranks.
class TerminalEdgesOnRanks {
public:
    /// Each cell and each vertex of the whole mesh, of which it has so many vertices, is some
    /// part's; a vertex may be of several. Throws what TerminalEdgeBisection does.
    TerminalEdgesOnRanks(const ProcessGroup& ranks, PartOfMesh part, std::uint64_t vertex_count);
    ~TerminalEdgesOnRanks();
    TerminalEdgesOnRanks(const TerminalEdgesOnRanks&) = delete;
    TerminalEdgesOnRanks& operator=(const TerminalEdgesOnRanks&) = delete;

    /// The targets are those of this part. May be called again, for another goal. Throws what
    /// TerminalEdgeBisection does.
    Traffic refine(const Goal& goal);

    /// This rank's part of the refined mesh, vertices with the numbers that TerminalEdgeMesh says.
    /// Cells stand in the order that they have there; those of a root are all here.
    [[nodiscard]] PartOfMesh result() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace octetra::rivals
