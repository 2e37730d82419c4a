#include "files/vtk/vtkhdf_arrays.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace octetra {
namespace {

/// Returns a valid name for HDF5, which would interpret a slash as the end of a group name, and "."
/// as the group itself.
std::string name_in_group(const VtuArray& array) {
    std::string name = array.name;
    std::ranges::replace(name, '/', '|');
    return name == "." || name.empty() ? name + "_field" : name;
}

void add_data(const std::string& group, const std::vector<VtuArray>& arrays,
              std::vector<VtkhdfArray>& all) {
    std::set<std::string> names;
    for (const VtuArray& array : arrays) {
        std::string name = name_in_group(array);
        while (!names.insert(name).second) name += "_field";
        all.push_back({group + name, array});
    }
}

}  // namespace

std::vector<VtkhdfArray> vtkhdf_arrays(MeshSource& mesh) {
    std::vector<VtuArray> cells = vtu_cells(mesh);
    std::vector<VtkhdfArray> all{{"Points", vtu_coordinates(mesh)},
                                 {"Connectivity", std::move(cells[0])},
                                 {"Offsets", std::move(cells[1]), true},
                                 {"Types", std::move(cells[2])}};
    const VtuData data = vtu_data(mesh);
    add_data("PointData/", data.of_points, all);
    add_data("CellData/", data.of_cells, all);
    return all;
}

}  // namespace octetra
