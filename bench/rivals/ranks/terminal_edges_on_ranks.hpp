#pragma once

#include <cstdint>
#include <memory>

#include <octetra/core/process_group.hpp>

#include "rivals/ranks/part_of_mesh.hpp"
#include "rivals/terminal_edges.hpp"

/// Terminal-edge bisection on ranks that have one part of the mesh each.
namespace octetra::rivals {

/// The communication needed to reach a goal.
struct Traffic {
    std::uint64_t rounds = 0;    ///< rounds with messages of any rank
    std::uint64_t messages = 0;  ///< sent by this rank; none are empty
    std::uint64_t bytes = 0;     ///< in these messages: four for each edge
    std::uint64_t asked = 0;     ///< notifications of this rank that it wants an edge
    std::uint64_t ready = 0;     ///< notifications that it has no cell in the way of an edge
    std::uint64_t shared_edges_bisected = 0;  ///< on this rank
};

/// In a round every rank does everything that needs no communication: it repeatedly follows paths,
/// and bisects terminal edges that it does not share. A shared edge is bisected by all sharers in
/// the round after the last of them has announced that it has no cell in its way. A rank that wants
/// an edge notifies the others, which follow the path from it in the next round. Stars are
/// disjoint, and the set of bisections does not depend on their order, so the result is that of
/// TerminalEdgeBisection for any partition.
///
/// All functions are collective, and throw the same on all ranks.
class TerminalEdgesOnRanks {
public:
    /// Each cell of the whole mesh, and each of its `vertex_count` vertices, is in some part; a
    /// vertex may be in several. Throws like TerminalEdgeBisection.
    TerminalEdgesOnRanks(const ProcessGroup& ranks, PartOfMesh part, std::uint64_t vertex_count);
    ~TerminalEdgesOnRanks();
    TerminalEdgesOnRanks(const TerminalEdgesOnRanks&) = delete;
    TerminalEdgesOnRanks& operator=(const TerminalEdgesOnRanks&) = delete;

    /// The targets are cells of this part. May be called repeatedly with different goals. Throws
    /// like TerminalEdgeBisection.
    Traffic refine(const Goal& goal);

    /// This rank's part of the refined mesh, with vertices numbered as in TerminalEdgeMesh. Cells
    /// are in the same order as there; all descendants of a root are on one rank.
    [[nodiscard]] PartOfMesh result() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace octetra::rivals
