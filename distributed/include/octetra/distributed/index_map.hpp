#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// A numbering in which the entities that a process owns have consecutive numbers, rank by rank:
/// what the vectors and matrices of PETSc, MFEM and DOLFINx are distributed by. It depends on the
/// partition, unlike the numbers of files.
template <class I>
struct IndexMap {
    /// The entities of this process: first those that it owns, ascending, then the copies, by rank
    /// of their owner.
    std::vector<I> entities;
    std::size_t owned_count = 0;
    /// The owner of each copy, entities[owned_count + k].
    std::vector<int> copy_owners;
    /// The number of each entity of this process, by local number.
    std::vector<std::uint64_t> numbers;
    /// Rank r owns the numbers rank_begin[r] .. rank_begin[r + 1] - 1; one entry more than ranks,
    /// the last of which is the number of entities of the whole mesh. The same on all processes.
    std::vector<std::uint64_t> rank_begin;
};

/// Collective. The numbering of the vertices, edges or faces of this process, `entity_count` many,
/// with this sharing; for cells, which are never shared, see AdaptiveMesh::cell_index_map().
/// Defined for VertexIndex, EdgeIndex, FaceIndex and CellIndex. Throws alike on all processes.
template <class I>
[[nodiscard]] IndexMap<I> make_index_map(const Communicator& processes, const Sharing<I>& sharing,
                                         std::size_t entity_count);

}  // namespace octetra::distributed
