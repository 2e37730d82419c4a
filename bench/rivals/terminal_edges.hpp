#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>

/// Refinement by bisection of terminal edges (Rivara, Pizarro, Chrisochoides), to be compared with
/// 8T-LE. It stands on core alone.
///
/// An edge is terminal if it is the longest edge of every cell around it, of its star; longest in
/// the strict order of core. A cell to be cut wants its longest edge bisected. An edge that is
/// wanted, and not terminal, wants the longest edges of the cells in its way bisected first, and so
/// on: the longest-edge propagation path, which branches, to edges that are longer and longer, so
/// that it ends. Rounds bisect all terminal edges that are wanted, each with its whole star, at the
/// midpoint; after each the mesh conforms. Cells are only ever cut at their longest edges, so what
/// becomes of a cell is always the same, and all that is cut has to be: the result does not depend
/// on the order in which terminal edges are bisected.
namespace octetra::rivals {

/// Which cells are to be cut: those of the input that are `targets`, and their descendants, as long
/// as they have an edge longer than `longest_edge`, or more volume than `volume`. Without either,
/// each target that has not been cut yet is cut once.
struct Goal {
    std::vector<std::uint8_t> targets;  ///< not 0: a target; one for each cell of the input, or
                                        ///< empty: all are
    std::optional<double> longest_edge;
    std::optional<double> volume;
};

/// What the rounds of one goal did.
struct Rounds {
    std::vector<std::uint64_t> edges_bisected;  ///< in each round
    std::uint64_t cells_cut = 0;
};

/// Cells stand where their parents stood, as a preorder of halves; the first half has the end of
/// the bisected edge that comes first in the cell. Input vertices keep their numbers; midpoints
/// follow level by level, in each by their ends' (smaller, larger) number; the level of a midpoint
/// is one above the higher one of its ends, that of the input's vertices is 0. So the numbers, too,
/// do not depend on the order of bisections.
struct TerminalEdgeMesh {
    Mesh mesh;  ///< points, cells and region tags: this carries nothing else along
    RefinementMaps maps;
};

class TerminalEdgeBisection {
public:
    /// The mesh must satisfy the invariants of struct Mesh. Throws InputError where three cells
    /// have a face in common.
    explicit TerminalEdgeBisection(const Mesh& mesh);
    ~TerminalEdgeBisection();
    TerminalEdgeBisection(const TerminalEdgeBisection&) = delete;
    TerminalEdgeBisection& operator=(const TerminalEdgeBisection&) = delete;

    /// Rounds, until the goal is reached. May be called again, for another goal.
    ///
    /// Throws InputError where a midpoint, rounded to binary64, would flatten or invert a cell,
    /// where there would be more than `max_cells` cells, and for a goal that makes no sense. What
    /// is left then is of no use.
    Rounds refine(const Goal& goal,
                  std::size_t max_cells = std::numeric_limits<std::size_t>::max());

    [[nodiscard]] std::size_t cell_count() const;
    [[nodiscard]] TerminalEdgeMesh result() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace octetra::rivals
