#pragma once

#include <string>
#include <vector>

#include <octetra/core/mesh_source.hpp>

#include "files/output/vtk_arrays.hpp"

namespace octetra {

/// The group that contains all data.
inline const std::string vtkhdf_root = "/VTKHDF";

/// An array of a mesh and the name of its dataset in the group, prefixed with `PointData/` or
/// `CellData/` for data of points and cells.
struct VtkhdfArray {
    std::string name;
    VtuArray array;
    bool begins_with_0 = false;  ///< a 0 precedes the values
};

/// Returns Points, Connectivity, Offsets, Types, followed by data of points and cells.
[[nodiscard]] std::vector<VtkhdfArray> vtkhdf_arrays(MeshSource& mesh);

}  // namespace octetra
