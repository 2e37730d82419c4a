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

/// A mesh as its checkpoint has it.
struct SavedMesh {
    /// In canonical order; `cells_before` are the numbers that its cells had where that was not so,
    /// by which the fields go.
    const DistributedMesh* mesh = nullptr;
    std::span<const CellIndex> cells_before;
    const CanonicalNumbers* numbers = nullptr;
    const Sharing<VertexIndex>* sharing = nullptr;
    const DistributedMesh* input = nullptr;
    const std::optional<SavedState>* state = nullptr;
    std::span<const CutRuns> steps;  ///< each in the canonical order of the cells before it
};

/// Collective. Writes a checkpoint; see AdaptiveMesh::save().
void save(const SavedMesh& saved, std::span<const Field> fields, const std::filesystem::path& path);

}  // namespace octetra::distributed
