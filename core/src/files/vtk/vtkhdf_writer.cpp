#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "files/hdf5/hdf5_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/vtk/vtkhdf_arrays.hpp"
#include "files/vtk/vtu.hpp"

namespace octetra {
namespace {

FilledDataset described(const VtkhdfArray& one) {
    const VtuArray& array = one.array;
    FilledDataset filled{{fmt::format("{}/{}", vtkhdf_root, one.name), array.type, {}}, array, {}};
    filled.dataset.extents.push_back(array.entities * array.values_per_entity / array.components);
    if (array.components > 1) filled.dataset.extents.push_back(array.components);
    if (one.begins_with_0) {
        ++filled.dataset.extents[0];
        filled.values = {0};
    }
    return filled;
}

FilledDataset number(const std::string& name, std::uint64_t value) {
    return {{fmt::format("{}/{}", vtkhdf_root, name), "Int64", {1}},
            {},
            {static_cast<std::int64_t>(value)}};
}

/// Returns the datasets of a single piece, in version 1.0 of the format.
std::vector<FilledDataset> all_datasets(MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    std::vector<FilledDataset> all{number("NumberOfPoints", facts.vertices),
                                   number("NumberOfCells", facts.cells),
                                   number("NumberOfConnectivityIds", 4 * facts.cells)};
    for (const VtkhdfArray& array : vtkhdf_arrays(mesh)) all.push_back(described(array));
    return all;
}

}  // namespace

std::string write_vtkhdf(MeshSource& mesh, const std::filesystem::path& path) {
    OutputFile out(path, mesh.group());
    put_hdf5(out, path,
             {{vtkhdf_root,
               {{"Version", std::vector<std::int64_t>{1, 0}}, {"Type", "UnstructuredGrid"}}},
              {vtkhdf_root + "/PointData"},
              {vtkhdf_root + "/CellData"},
              {vtkhdf_root + "/FieldData"}},
             all_datasets(mesh), mesh.group());
    out.commit();
    return lists_left_out(path, mesh.facts().facets, mesh.facts().edges);
}

}  // namespace octetra
