#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/output/output_file.hpp"
#include "files/vtk/hdf5_layout.hpp"
#include "files/vtk/vtu.hpp"
#include "files/vtk/vtu_arrays.hpp"

namespace octetra {
namespace {

static_assert(std::endian::native == std::endian::little);

const std::string root = "/VTKHDF";

/// A dataset, and what is written into it: values that come slice by slice, or are there.
struct Filled {
    Hdf5Dataset dataset;
    VtuArray array;
    std::vector<std::int64_t> values;  ///< these come first
};

Hdf5Dataset described(const std::string& name, const VtuArray& array) {
    Hdf5Dataset dataset{fmt::format("{}/{}", root, name), array.type, {}};
    dataset.extents.push_back(array.entities * array.values_per_entity / array.components);
    if (array.components > 1) dataset.extents.push_back(array.components);
    return dataset;
}

Filled number(const std::string& name, std::uint64_t value) {
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
std::vector<Filled> all_datasets(MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    std::vector<Filled> all{number("NumberOfPoints", facts.vertices),
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

/// Large enough that there are few, small enough for a buffer, and of a small array an equal share.
std::uint64_t entities_of_a_slice(const VtuArray& array, const ProcessGroup& group) {
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 21U;
    const std::uint64_t share = array.entities / static_cast<std::uint64_t>(group.size()) + 1;
    return std::clamp(most_bytes / array.entity_size(), std::uint64_t{1}, share);
}

/// Collective.
void put_values(OutputFile& out, const Filled& filled, std::uint64_t offset,
                const ProcessGroup& group) {
    const std::size_t head = filled.values.size() * sizeof(std::int64_t);
    if (group.is_first() && head > 0) out.overwrite(offset, filled.values.data(), head);
    const VtuArray& array = filled.array;
    if (array.entities == 0) return;
    std::vector<char> bytes;
    const std::uint64_t length = entities_of_a_slice(array, group);
    const std::uint64_t stride = length * static_cast<std::uint64_t>(group.size());
    for (Window window{0, length, array.entities}; window.begin < window.count;
         window.begin += stride) {
        array.bytes_of_slice(window, bytes);
        const std::uint64_t before = window.begin_of(group.rank()) * array.entity_size();
        out.overwrite(offset + head + before, bytes.data(), bytes.size());
    }
}

/// Collective. The first process writes the file without the values, and tells all where each
/// dataset's belong.
std::vector<std::uint64_t> put_skeleton(OutputFile& out, const std::filesystem::path& path,
                                        const std::vector<Filled>& all, const ProcessGroup& group) {
    std::vector<std::uint64_t> values_at(all.size());
    group.on_first([&] {
        std::vector<Hdf5Dataset> datasets;
        for (const Filled& filled : all) datasets.push_back(filled.dataset);
        Hdf5Skeleton skeleton;
        try {
            skeleton = make_hdf5_skeleton(
                {.path = root, .type = "UnstructuredGrid", .version = {1, 0}},
                {root + "/PointData", root + "/CellData", root + "/FieldData"}, datasets);
        } catch (const SystemError& error) {
            throw SystemError(fmt::format("{}: writing failed: {}", path.native(), error.what()));
        }
        values_at = std::move(skeleton.values_at);
        for (const auto& [position, bytes] : skeleton.rest) {
            out.overwrite(position, bytes.data(), bytes.size());
        }
    });
    for (std::uint64_t& position : values_at) position = group.of_first(position);
    return values_at;
}

}  // namespace

std::string write_vtkhdf(MeshSource& mesh, const std::filesystem::path& path) {
    const ProcessGroup& group = mesh.group();
    OutputFile out(path, group);
    const std::vector<Filled> all = all_datasets(mesh);
    const std::vector<std::uint64_t> values_at = put_skeleton(out, path, all, group);
    for (std::size_t k = 0; k < all.size(); ++k) put_values(out, all[k], values_at[k], group);
    out.commit();
    return lists_left_out(path, mesh.facts().facets, mesh.facts().edges);
}

}  // namespace octetra
