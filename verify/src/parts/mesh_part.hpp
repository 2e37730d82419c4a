#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "lookup/box_tree.hpp"
#include "parts/domain.hpp"
#include "parts/numbers.hpp"

namespace octetra::verify {

/// What one process sees of a mesh in order to judge what lies in its domain: every cell, tagged
/// facet and edge that meets its view, a box, and the vertices of these and in its view.
struct MeshPart {
    Mesh mesh;        ///< numbered on its own, in the order of the whole mesh
    Numbers numbers;  ///< in the whole mesh
};

/// The parts of one process.
struct Parts {
    MeshPart coarse;
    MeshPart fine;
    Domain domain;
    /// Of each process a box around the coarse cells that it sees; of a mesh alone, none.
    std::vector<Bounds> coarse_in_view;
};

/// Collective. A view that meets the domain is enough to judge a mesh by itself: what has a point
/// of the domain is seen with all cells that have this point.
[[nodiscard]] Parts part_of(MeshSlice mesh, const ProcessGroup& group);

/// Collective. Here a process answers for the coarse cells of its domain, too. It sees all that
/// these touch, so that what is in common with others looks the same to both; and of the fine
/// mesh, what meets any coarse cell that it sees.
[[nodiscard]] Parts parts_of(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group);

}  // namespace octetra::verify
