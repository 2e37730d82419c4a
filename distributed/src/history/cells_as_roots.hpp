#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Makes a mesh an input for its lifetime: its cells, tagged facets and edges become roots, and its
/// history is set aside. The destructor restores the history, unless keep() was called; see
/// recall_history.hpp.
///
/// The descendants of a root are contiguous in the canonical order, and a vertex precedes the
/// midpoints derived from it. Therefore all numbers are unchanged, and further refinement assigns
/// the same numbers as without this; only the origin of the entities is set aside.
class CellsAsRoots {
public:
    CellsAsRoots() = default;
    ~CellsAsRoots();
    CellsAsRoots(const CellsAsRoots&) = delete;
    CellsAsRoots& operator=(const CellsAsRoots&) = delete;
    CellsAsRoots(CellsAsRoots&&) = delete;
    CellsAsRoots& operator=(CellsAsRoots&&) = delete;

    /// Collective. The mesh must be in canonical order, and stay so. `known`: the global numbers of
    /// its vertices, or null. A failure of one process is thrown on all; the mesh is then
    /// unchanged.
    void begin(DistributedMesh& mesh, const CanonicalNumbers* known);
    /// Makes the change permanent and returns the history that was set aside.
    [[nodiscard]] History keep() noexcept;

private:
    DistributedMesh* mesh_ = nullptr;
    History set_aside_;
};

}  // namespace octetra::distributed
