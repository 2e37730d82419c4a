#pragma once

#include <string>
#include <vector>

#include <octetra/core/mesh_source.hpp>

#include "files/vtk/vtu_arrays.hpp"

namespace octetra {

/// The group that all is in.
inline const std::string vtkhdf_root = "/VTKHDF";

/// An array of a mesh, and the name of its dataset in the group: with `PointData/` or `CellData/`
/// before it, if it is of these.
struct VtkhdfArray {
    std::string name;
    VtuArray array;
    bool begins_with_0 = false;  ///< a 0 stands before the values
};

/// Points, Connectivity, Offsets, Types; then data of points and cells.
[[nodiscard]] std::vector<VtkhdfArray> vtkhdf_arrays(MeshSource& mesh);

}  // namespace octetra
