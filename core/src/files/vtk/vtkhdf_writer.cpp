#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/hdf5/hdf5_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/vtk/vtu.hpp"
#include "files/vtk/vtu_arrays.hpp"

namespace octetra {
namespace {

const std::string root = "/VTKHDF";

Hdf5Dataset described(const std::string& name, const VtuArray& array) {
    Hdf5Dataset dataset{fmt::format("{}/{}", root, name), array.type, {}};
    dataset.extents.push_back(array.entities * array.values_per_entity / array.components);
    if (array.components > 1) dataset.extents.push_back(array.components);
    return dataset;
}

FilledDataset number(const std::string& name, std::uint64_t value) {
    return {
        {fmt::format("{}/{}", root, name), "Int64", {1}}, {}, {static_cast<std::int64_t>(value)}};
}

/// HDF5 would take a slash for the end of a group's name, and "." for the group.
std::string name_in_group(const VtuArray& array) {
    std::string name = array.name;
    std::ranges::replace(name, '/', '|');
    return name == "." || name.empty() ? name + "_field" : name;
}

/// One piece, as version 1.0 of the format has it.
std::vector<FilledDataset> all_datasets(MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    std::vector<FilledDataset> all{number("NumberOfPoints", facts.vertices),
                                   number("NumberOfCells", facts.cells),
                                   number("NumberOfConnectivityIds", 4 * facts.cells)};
    const auto add = [&](const std::string& name, VtuArray array) {
        all.push_back({described(name, array), std::move(array), {}});
    };
    add("Points", vtu_coordinates(mesh));
    const std::vector<VtuArray> cells = vtu_cells(mesh);
    add("Connectivity", cells[0]);
    add("Offsets", cells[1]);
    ++all.back().dataset.extents[0];  // it begins with 0
    all.back().values = {0};
    add("Types", cells[2]);
    const VtuData data = vtu_data(mesh);
    const auto add_all = [&](const std::string& group, const std::vector<VtuArray>& arrays) {
        std::set<std::string> names;
        for (const VtuArray& array : arrays) {
            std::string name = name_in_group(array);
            while (!names.insert(name).second) name += "_field";
            add(group + name, array);
        }
    };
    add_all("PointData/", data.of_points);
    add_all("CellData/", data.of_cells);
    return all;
}

}  // namespace

std::string write_vtkhdf(MeshSource& mesh, const std::filesystem::path& path) {
    OutputFile out(path, mesh.group());
    put_hdf5(out, path,
             {{root, {{"Version", std::vector<std::int64_t>{1, 0}}, {"Type", "UnstructuredGrid"}}},
              {root + "/PointData"},
              {root + "/CellData"},
              {root + "/FieldData"}},
             all_datasets(mesh), mesh.group());
    out.commit();
    return lists_left_out(path, mesh.facts().facets, mesh.facts().edges);
}

}  // namespace octetra
