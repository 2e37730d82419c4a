#pragma once

#include <cstdint>
#include <utility>

#include <octetra/distributed/distributed_mesh.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// The cells of a part that regular refinement does not bisect by themselves: the children of a
/// cell of which one to five edges are bisected. See Closure::regular. Vertices and cells of the
/// part have generations: that of an input vertex is 0, that of a midpoint is one more than that of
/// the regular cells that have its edge, and that of a cell is the greatest of its vertices.
class TransitionCells {
public:
    /// Siblings are contiguous.
    enum class Kind : std::uint8_t { regular, first_sibling, further_sibling };
    using Kinds = IndexVector<CellIndex, Kind>;
    using Generations = IndexVector<VertexIndex, std::uint32_t>;

    /// Keeps a pointer to the mesh.
    TransitionCells(const DistributedMesh& mesh, Kinds kinds, Generations generations)
        : mesh_(&mesh), kinds_(std::move(kinds)), generations_(std::move(generations)) {}

    [[nodiscard]] bool contains(CellIndex cell) const { return kinds_[cell] != Kind::regular; }
    [[nodiscard]] std::uint32_t generation_of(VertexIndex v) const { return generations_[v]; }
    [[nodiscard]] std::uint32_t generation_of(CellIndex cell) const;

    /// The cells begin .. end-1.
    struct Family {
        CellIndex begin;
        CellIndex end;
    };
    /// Returns the siblings of a transition cell, itself included.
    [[nodiscard]] Family family_of(CellIndex cell) const;

    /// Returns the edges of a transition cell that are edges of its parent; they are not bisected.
    [[nodiscard]] EdgeMask edges_of_parent(CellIndex cell) const;

    /// Returns the edges of a cell of this generation. All edges of a regular cell have its own; an
    /// edge of a transition cell has that of the parent, if it is an edge of the parent, or else
    /// the cell's own.
    [[nodiscard]] EdgeMask edges_of_generation(CellIndex cell, std::uint32_t generation) const;

    /// Returns the set of edges of a transition cell that has `marked` and the longest edge of the
    /// face, if any, that is a face of the parent and has a marked edge.
    [[nodiscard]] EdgeMask closure(CellIndex cell, EdgeMask marked) const;

    /// Updates the generations after a level that has bisected edges of this generation.
    void add_midpoints(std::uint32_t generation);
    /// Replaces the kinds after a level.
    void set_kinds(Kinds kinds) { kinds_ = std::move(kinds); }
    [[nodiscard]] const Generations& generations() const { return generations_; }

private:
    const DistributedMesh* mesh_;
    Kinds kinds_;
    Generations generations_;
};

}  // namespace octetra::distributed
