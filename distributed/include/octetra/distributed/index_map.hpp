#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// A numbering in which the entities that a process owns have consecutive numbers, rank by rank, as
/// in the distributed vectors and matrices of PETSc, MFEM and DOLFINx. It depends on the partition,
/// unlike the numbers in files.
template <class I>
struct IndexMap {
    /// Local numbers of the entities of this process: first those that it owns, ascending, then the
    /// copies, by the rank of their owner.
    std::vector<I> entities;
    std::size_t owned_count = 0;  ///< number of entities that this process owns
    /// The owner of each copy, entities[owned_count + k].
    std::vector<int> copy_owners;
    /// The number of each entity of this process in this numbering, by local number.
    std::vector<std::uint64_t> numbers;
    /// Rank r owns the numbers rank_begin[r] .. rank_begin[r + 1] - 1. The last of the size() + 1
    /// entries is the number of entities of the whole mesh. The same on all processes.
    std::vector<std::uint64_t> rank_begin;
};

/// Collective. Returns the numbering of the `entity_count` vertices, edges or faces of this process
/// with this sharing; for cells, which are never shared, see AdaptiveMesh::cell_index_map().
/// Defined for VertexIndex, EdgeIndex, FaceIndex and CellIndex. Throws the same on all processes.
template <class I>
[[nodiscard]] IndexMap<I> make_index_map(const Communicator& processes, const Sharing<I>& sharing,
                                         std::size_t entity_count);

}  // namespace octetra::distributed
