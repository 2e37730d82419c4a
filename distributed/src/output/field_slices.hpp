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

/// The fields of a process, with the numbering of their entities in the whole mesh.
struct FieldsOfPart {
    std::span<const Field> fields;
    const Communicator* processes = nullptr;
    const CanonicalNumbers* numbers = nullptr;
    const Sharing<VertexIndex>* sharing = nullptr;
    /// The ancestors of the cells in canonical order. `cells_before` maps canonical local indices
    /// to the indices of field values; if it is empty, they are the same.
    const AncestorMap* cell_ancestors = nullptr;
    std::span<const CellIndex> cells_before;
    const CanonicalRuns* cell_runs = nullptr;
};

/// The values of fields in canonical order, as for a MeshSource. The value of a vertex is taken
/// from its owner.
class FieldSlices {
public:
    /// Refers to the objects that `part` refers to.
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
