#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>

/// Refinement by bisection of terminal edges (Rivara, Pizarro, Chrisochoides), for comparison with
/// 8T-LE. Depends on core alone.
///
/// An edge is terminal if it is the longest edge of every cell in its star, that is, of every cell
/// around it, in the strict order of core. A cell to be cut wants its longest edge to be bisected.
/// A wanted edge that is not terminal requires that the longest edges of the cells in its way be
/// bisected first, and so on: the longest-edge propagation path, which branches to longer and
/// longer edges and therefore ends. Each round bisects all wanted terminal edges with their stars
/// at the midpoint; after each round the mesh conforms. Cells are cut only at their longest edges,
/// so the descendants of a cell are determined, and every bisection is necessary: the result does
/// not depend on the order in which terminal edges are bisected.
namespace octetra::rivals {

/// The cells to be cut: those of the input in `targets`, and their descendants, as long as they
/// have an edge longer than `longest_edge`, or a volume greater than `volume`. Without either, each
/// target that has not been cut yet is cut once.
struct Goal {
    std::vector<std::uint8_t> targets;  ///< nonzero: a target; one for each cell of the input, or
                                        ///< empty: all are targets
    std::optional<double> longest_edge;
    std::optional<double> volume;
};

/// The rounds of one goal.
struct Rounds {
    std::vector<std::uint64_t> edges_bisected;  ///< in each round
    std::uint64_t cells_cut = 0;
};

/// Cells replace their parents, as a preorder of halves; the first half has the end of the bisected
/// edge that comes first in the cell. Input vertices keep their numbers; midpoints follow level by
/// level, sorted within a level by the (smaller, larger) number of their ends. The level of a
/// midpoint is one above the higher level of its ends; input vertices have level 0. Hence the
/// numbers do not depend on the order of bisections either.
struct TerminalEdgeMesh {
    Mesh mesh;  ///< points, cells and region tags; nothing else is transferred
    RefinementMaps maps;
};

class TerminalEdgeBisection {
public:
    /// The mesh must satisfy the invariants of struct Mesh. Throws InputError if a face has three
    /// cells.
    explicit TerminalEdgeBisection(const Mesh& mesh);
    ~TerminalEdgeBisection();
    TerminalEdgeBisection(const TerminalEdgeBisection&) = delete;
    TerminalEdgeBisection& operator=(const TerminalEdgeBisection&) = delete;

    /// Makes rounds until the goal is reached. May be called repeatedly with different goals.
    ///
    /// Throws InputError if a midpoint, rounded to binary64, would flatten or invert a cell, if
    /// there would be more than `max_cells` cells, and for an invalid goal. The object must not be
    /// used afterwards.
    Rounds refine(const Goal& goal,
                  std::size_t max_cells = std::numeric_limits<std::size_t>::max());

    [[nodiscard]] std::size_t cell_count() const;
    [[nodiscard]] TerminalEdgeMesh result() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace octetra::rivals
