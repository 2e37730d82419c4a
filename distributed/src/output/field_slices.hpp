#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"
#include "numbering/canonical_runs.hpp"

namespace octetra::distributed {

/// Where the values of a process are, and what numbers they have in the whole mesh.
struct FieldsOfPart {
    std::span<const Field> fields;
    const Communicator* processes = nullptr;
    const CanonicalNumbers* numbers = nullptr;
    const Sharing<VertexIndex>* sharing = nullptr;
    /// Of the cells in canonical order; `cells_before` are the numbers by which fields have them,
    /// or empty where these are the same.
    const AncestorMap* cell_ancestors = nullptr;
    std::span<const CellIndex> cells_before;
    const CanonicalRuns* cell_runs = nullptr;
};

/// The values of fields in canonical order, those of a vertex from its owner; see MeshSource.
class FieldSlices {
public:
    /// Refers to what the part refers to.
    explicit FieldSlices(const FieldsOfPart& part);

    [[nodiscard]] std::span<const FieldFacts> facts() const { return facts_; }
    /// Collective. Valid until the next call.
    [[nodiscard]] std::span<const std::byte> values(std::size_t field, const Window& window);

private:
    FieldsOfPart part_;
    std::vector<FieldFacts> facts_;
    std::vector<std::byte> slice_;
};

}  // namespace octetra::distributed
