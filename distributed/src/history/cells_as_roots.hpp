#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/history.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// A mesh as an input of its own for as long as this lives: its cells, tagged facets and edges are
/// roots, and it has no history. Then it is again as it was, unless it is to be kept so; see
/// recall_history.hpp.
///
/// A root's descendants stand together in the canonical order, and vertices come before those that
/// are made of them. So all numbers are what they were, and what is refined from here on gets those
/// that it would have got; only where it comes from is forgotten.
class CellsAsRoots {
public:
    CellsAsRoots() = default;
    ~CellsAsRoots();
    CellsAsRoots(const CellsAsRoots&) = delete;
    CellsAsRoots& operator=(const CellsAsRoots&) = delete;
    CellsAsRoots(CellsAsRoots&&) = delete;
    CellsAsRoots& operator=(CellsAsRoots&&) = delete;

    /// Collective. From now on. The mesh must be in canonical order, and stay so. `known`: the
    /// numbers of its vertices, or null. What fails on one process throws alike on all; the mesh is
    /// then as it was.
    void begin(DistributedMesh& mesh, const CanonicalNumbers* known);
    /// The mesh stays so. What it has not any more.
    [[nodiscard]] History keep() noexcept;

private:
    DistributedMesh* mesh_ = nullptr;
    History forgotten_;
};

}  // namespace octetra::distributed
