#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/background.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// The values of a mesh that expressions may use.
struct FieldsToUse {
    std::span<const Field> fields;  ///< they match the mesh, and are the same on all processes
    // of the mesh, if there are fields
    const Sharing<VertexIndex>* sharing = nullptr;
    const CanonicalNumbers* numbers = nullptr;
    std::span<const Background> backgrounds = {};  ///< the same on all processes
};

/// Collective, within a transaction. Returns a byte for each cell of this process: 1 if the
/// selection, which must be the same on all processes, marks it, else 0. See
/// AdaptiveMesh::marked_cells() for the errors.
[[nodiscard]] std::vector<std::uint8_t> select_cells(const DistributedMesh& mesh,
                                                     const Selection& selection,
                                                     const FieldsToUse& fields = {});

/// Collective, within a transaction. Returns the value of an expression, which must be the same on
/// all processes, in each cell of this process. See AdaptiveMesh::cell_values() for the errors.
[[nodiscard]] std::vector<double> evaluate_cells(const DistributedMesh& mesh,
                                                 const Expression& expression,
                                                 const FieldsToUse& fields = {});

}  // namespace octetra::distributed
