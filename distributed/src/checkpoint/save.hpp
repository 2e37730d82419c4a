#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <octetra/core/cut_runs.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// The data that a checkpoint stores.
struct SavedMesh {
    /// In canonical order. `cells_before` maps canonical local indices to the indices of field
    /// values; if it is empty, they are the same.
    const DistributedMesh* mesh = nullptr;
    std::span<const CellIndex> cells_before;
    const CanonicalNumbers* numbers = nullptr;
    const Sharing<VertexIndex>* sharing = nullptr;
    const DistributedMesh* input = nullptr;
    const std::optional<SavedState>* state = nullptr;
    std::span<const CutRuns> steps;  ///< each in the canonical order of the cells before it
};

/// Collective. Writes a checkpoint; see AdaptiveMesh::save().
/// Each block is written by one process: the input as slices of its canonical order; the steps root
/// by root, sent by the processes that have the roots to the process that writes the block.
void save(const SavedMesh& saved, std::span<const Field> fields, const std::filesystem::path& path);

}  // namespace octetra::distributed
