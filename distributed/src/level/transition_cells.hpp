#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <octetra/distributed/distributed_mesh.hpp>

#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// At most eight cells that are consecutive in canonical order.
class CellRun {
public:
    void append(CellIndex cell) { cells_[count_++] = cell; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] CellIndex operator[](std::size_t k) const { return cells_[k]; }
    [[nodiscard]] const CellIndex* begin() const { return cells_.data(); }
    [[nodiscard]] const CellIndex* end() const { return cells_.data() + count_; }

private:
    std::array<CellIndex, 8> cells_;
    std::size_t count_ = 0;
};

/// The cells of a part that regular refinement does not bisect by themselves: the children of a
/// cell of which one to five edges are bisected. See Closure::regular. Vertices and cells of the
/// part have generations: that of an input vertex is 0, that of a midpoint is one more than that of
/// the regular cells that have its edge, and that of a cell is the greatest of its vertices.
class TransitionCells {
public:
    /// Siblings are consecutive in canonical order.
    enum class Kind : std::uint8_t { regular, first_sibling, further_sibling };
    using Kinds = IndexVector<CellIndex, Kind>;
    using Generations = IndexVector<VertexIndex, std::uint32_t>;

    /// Keeps a pointer to the mesh.
    TransitionCells(const DistributedMesh& mesh, Kinds kinds, Generations generations)
        : mesh_(&mesh), kinds_(std::move(kinds)), generations_(std::move(generations)) {}

    [[nodiscard]] bool contains(CellIndex cell) const { return kinds_[cell] != Kind::regular; }
    [[nodiscard]] std::uint32_t generation_of(VertexIndex v) const { return generations_[v]; }
    [[nodiscard]] std::uint32_t generation_of(CellIndex cell) const;

    /// Returns the siblings of a transition cell, itself included, in canonical order.
    [[nodiscard]] CellRun family_of(CellIndex cell) const;

    /// Returns the edges of a transition cell that are edges of its parent; they are not bisected.
    [[nodiscard]] EdgeMask edges_of_parent(CellIndex cell) const;

    /// Returns the edges of a cell of this generation. All edges of a regular cell have its own; an
    /// edge of a transition cell has that of the parent, if it is an edge of the parent, or else
    /// the cell's own.
    [[nodiscard]] EdgeMask edges_of_generation(CellIndex cell, std::uint32_t generation) const;

    /// Returns the set of edges of a transition cell that has `marked` and the longest edge of the
    /// face, if any, that is a face of the parent and has a marked edge.
    [[nodiscard]] EdgeMask closure(CellIndex cell, EdgeMask marked) const;

    /// Calls mark(cell, edges) for what the marked edges of a transition cell require: the edges of
    /// closure(), and all edges of the parent if the cell has a marked edge of its own generation.
    void close(CellIndex cell, EdgeMask marked, auto&& mark) const {
        mark(cell, closure(cell, marked));
        if ((marked & ~unsigned{edges_of_parent(cell)}) == 0) return;
        for (const CellIndex sibling : family_of(cell)) mark(sibling, edges_of_parent(sibling));
    }

    /// Updates the generations after a level that has bisected edges of this generation.
    void add_midpoints(std::uint32_t generation);
    /// The cells of a run have replaced a regular cell or a family: eight are regular, fewer are a
    /// family.
    void set_run(const CellRun& run);
    [[nodiscard]] Kinds& kinds() { return kinds_; }
    [[nodiscard]] const Generations& generations() const { return generations_; }

private:
    const DistributedMesh* mesh_;
    Kinds kinds_;
    Generations generations_;
};

}  // namespace octetra::distributed
