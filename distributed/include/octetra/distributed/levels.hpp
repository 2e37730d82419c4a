#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

/// The levels of a refined mesh, for multigrid solvers, and the transfer of values between them.
namespace octetra::distributed {

/// Options of AdaptiveMesh::levels(), the same on all processes.
struct LevelOptions {
    /// Each level has at least this many times the vertices of the previous one, except the second
    /// level, because the first one is always the input. A finite number from 1 on.
    double growth = 1.7;
};

/// The entities of a level on this process, by local numbers of vertices: those of the last level
/// in the order of the mesh, those of others in canonical order.
struct LevelLists {
    IndexVector<CellIndex, CellVertices> cells;
    std::vector<Marker> regions;  ///< one per cell; empty if the input has none
    IndexVector<FacetIndex, FacetVertices> facets;
    std::vector<Marker> facet_markers;  ///< one per facet; empty if the input has none
    IndexVector<EdgeIndex, EdgeVertices> edges;
    std::vector<Marker> edge_markers;  ///< one per tagged edge; empty if the input has none
};

/// For each cell of a level on this process, the cell of the previous level that contains it.
struct LevelParents {
    std::vector<CellIndex> parents;      ///< positions in the cells of the previous level
    std::vector<std::uint8_t> halvings;  ///< h: the cell has 2^-h of the volume of its parent
};

/// The rows of a sparse matrix that this process owns. Row i has the entries row_begin[i] ..
/// row_begin[i + 1] - 1; its columns are distinct and ascending.
struct SparseRows {
    std::vector<std::uint64_t> row_begin{0};
    std::vector<std::uint64_t> columns;  ///< numbers in the whole mesh
    std::vector<double> values;
};

/// Nested meshes T(0), T(1), ... from the input of a mesh to its state at the time of
/// AdaptiveMesh::levels(); 0 is the coarsest. The levels remain valid when the mesh is refined,
/// coarsened or migrated later. Copies refer to the same levels.
///
/// A process has the same roots on all levels, so the cells of a level that descend from one cell
/// are on one process. The vertices of a level are the first local vertices of the next one, with
/// the same local and global numbers, sharers and owner. So no message is needed for the transfer
/// of values, apart from sums over sharers, and injection takes the first values.
///
/// Functions throw InputError for a level that does not exist.
class Levels {
public:
    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] const Communicator& processes() const;

    /// Returns how many steps of the mesh's history made the level. After coarsening, and with
    /// Closure::regular, a step of the history can differ from the refinements that were called.
    [[nodiscard]] std::size_t step(std::size_t level) const;
    /// Returns the number of vertices of the whole level.
    [[nodiscard]] std::uint64_t vertex_count(std::size_t level) const;
    /// Return the coordinates, global numbers, sharers and owners of this process's vertices.
    [[nodiscard]] std::span<const Point> points(std::size_t level) const;
    [[nodiscard]] std::span<const GlobalVertex> vertex_numbers(std::size_t level) const;
    [[nodiscard]] const Sharing<VertexIndex>& vertex_sharing(std::size_t level) const;

    /// Computes the entities of a level, in time proportional to the finest level. Not collective.
    [[nodiscard]] LevelLists lists(std::size_t level) const;
    /// Computes the parents, in the previous level, of the cells of a level from 1 on, in time
    /// proportional to the finest level. Not collective.
    [[nodiscard]] LevelParents parents(std::size_t level) const;

    /// Collective. Returns the matrix by which values of P1 elements on a level are interpolated to
    /// the next one: a row for each vertex of the next level that this process owns, in the order
    /// of its IndexMap, and columns numbered by the IndexMap of the level (see make_index_map()).
    /// Entries are powers of 1/2 or sums of them, exact; each row sums to 1. Throws InputError on
    /// all processes if they pass different levels or the last one.
    [[nodiscard]] SparseRows prolongation(std::size_t level) const;
    /// Interpolates values on a level to the next one. `values` has `components` numbers for each
    /// vertex of this process; a midpoint gets the mean of the ends of its edge. Not collective:
    /// if the values of all sharers of a vertex are equal, so are the results.
    [[nodiscard]] std::vector<double> prolong(std::size_t level, std::span<const double> values,
                                              std::size_t components = 1) const;
    /// Collective. Multiplies by the transpose of prolongation(level - 1), as residuals and load
    /// vectors are restricted to the previous level. Of a shared vertex, the values of its owner
    /// are used; the result is the same on all sharers.
    [[nodiscard]] std::vector<double> restrict_residual(std::size_t level,
                                                        std::span<const double> values,
                                                        std::size_t components = 1) const;

    struct Data;
    /// Used by AdaptiveMesh::levels().
    explicit Levels(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

private:
    std::shared_ptr<const Data> data_;
};

}  // namespace octetra::distributed
