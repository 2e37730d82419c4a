#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "lookup/box_tree.hpp"
#include "parts/domain.hpp"
#include "parts/numbers.hpp"

namespace octetra::verify {

/// The part of a mesh that a process holds in order to verify its domain: every cell, tagged facet
/// and edge that meets its view, a box, with their vertices and all vertices in the view.
struct MeshPart {
    Mesh mesh;        ///< with local numbers, in the order of the whole mesh
    Numbers numbers;  ///< numbers in the whole mesh
};

/// The parts of a process.
struct Parts {
    MeshPart coarse;
    MeshPart fine;
    Domain domain;
    /// For each process, a box around the coarse cells in its view; empty for a single mesh.
    std::vector<Bounds> coarse_in_view;
};

/// Collective. Returns the part for verifying a single mesh. A view that meets the domain suffices:
/// every entity with a point in the domain is held together with all cells that contain this point.
[[nodiscard]] Parts part_of(MeshSlice mesh, const ProcessGroup& group);

/// Collective. Returns the parts for verifying a refinement. A process also verifies the coarse
/// cells of its domain. Its view contains all cells that these touch, so that shared entities look
/// the same to all processes that verify them; and all entities of the fine mesh that meet a coarse
/// cell in its view.
[[nodiscard]] Parts parts_of(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group);

}  // namespace octetra::verify
