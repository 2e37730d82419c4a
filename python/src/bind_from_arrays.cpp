#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include <octetra/distributed/mesh_part.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// Attributes of shape (n,) or (n, k), into a part that has its points.
void take_attributes(od::MeshPart& part, const py::object& given) {
    if (given.is_none()) return;
    const Values values = values_for(given, part.points.size(), "points");
    part.attributes_per_point = values.components;
    part.point_attributes = values_of<double>("point_attributes", values.array.attr("ravel")());
}

/// Numbers of vertices: as given, or as the points stand.
std::vector<std::uint64_t> numbers_of_points(const py::object& given, std::size_t count) {
    if (!given.is_none()) return values_of<std::uint64_t>("vertex_numbers", given);
    std::vector<std::uint64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// As the function of Python takes them.
struct Given {
    py::object points, cells;
    py::object regions, facets, facet_markers, edges, edge_markers;
    py::object vertex_numbers, point_markers, point_attributes;
    py::object cell_numbers, facet_numbers, edge_numbers;
};

od::MeshPart part_of(const Given& given) {
    od::MeshPart part;
    part.points = values_of<Point>("points", given.points);
    part.vertex_numbers = numbers_of_points(given.vertex_numbers, part.points.size());
    part.point_markers = values_of<Marker>("point_markers", given.point_markers);
    take_attributes(part, given.point_attributes);
    part.cells = values_of<std::array<std::uint64_t, 4>>("cells", given.cells);
    part.regions = values_of<Marker>("regions", given.regions);
    part.cell_numbers = values_of<std::uint64_t>("cell_numbers", given.cell_numbers);
    part.facets = values_of<std::array<std::uint64_t, 3>>("facets", given.facets);
    part.facet_markers = values_of<Marker>("facet_markers", given.facet_markers);
    part.facet_numbers = values_of<std::uint64_t>("facet_numbers", given.facet_numbers);
    part.edges = values_of<std::array<std::uint64_t, 2>>("edges", given.edges);
    part.edge_markers = values_of<Marker>("edge_markers", given.edge_markers);
    part.edge_numbers = values_of<std::uint64_t>("edge_numbers", given.edge_numbers);
    return part;
}

/// A hash of the points; 0 for no points.
std::uint64_t hash_of(const std::vector<Point>& points) {
    if (points.empty()) return 0;
    const auto* const bytes = reinterpret_cast<const char*>(points.data());
    return std::hash<std::string_view>{}({bytes, points.size() * sizeof(Point)});
}

/// Collective. Are there two ranks with different hashes, but for 0?
bool have_different_points(const od::Communicator& processes, std::uint64_t hash) {
    const std::uint64_t greatest = processes.max(hash);
    return greatest != ~processes.max(hash == 0 ? ~greatest : ~hash);
}

MeshPointer mesh_of(const Given& given, std::uint32_t index_base, const py::object& comm) {
    const od::Communicator processes = processes_of(comm);
    od::MeshPart part;
    convert_on_each(processes, [&] {
        part = part_of(given);
        part.index_base = index_base;
    });
    const std::uint64_t hash = given.vertex_numbers.is_none() ? hash_of(part.points) : 0;
    return without_gil([&] {
        try {
            return std::make_shared<Mesh>(od::AdaptiveMesh::from_parts(processes, std::move(part)));
        } catch (const InputError& error) {  // the same on all ranks
            if (!have_different_points(processes, hash)) throw;
            throw InputError(fmt::format(
                "{}; vertex_numbers is None, which numbers the points of each rank from 0, and "
                "ranks pass different points: a part of a mesh is passed with "
                "vertex_numbers=mesh.vertex_numbers and mesh.vertex_numbers[mesh.cells]",
                error.what()));
        }
    });
}

}  // namespace

void bind_from_arrays(py::module_& module) {
    const auto optional = [](const char* name) { return py::arg(name) = py::none(); };
    module.def(
        "from_arrays",
        [](py::object points, py::object cells, py::object regions, py::object facets,
           py::object facet_markers, py::object edges, py::object edge_markers,
           py::object vertex_numbers, py::object point_markers, py::object point_attributes,
           py::object cell_numbers, py::object facet_numbers, py::object edge_numbers,
           std::uint32_t index_base, const py::object& comm) {
            return mesh_of(
                {std::move(points), std::move(cells), std::move(regions), std::move(facets),
                 std::move(facet_markers), std::move(edges), std::move(edge_markers),
                 std::move(vertex_numbers), std::move(point_markers), std::move(point_attributes),
                 std::move(cell_numbers), std::move(facet_numbers), std::move(edge_numbers)},
                index_base, comm);
        },
        py::arg("points"), py::arg("cells"), py::kw_only(), optional("regions"), optional("facets"),
        optional("facet_markers"), optional("edges"), optional("edge_markers"),
        optional("vertex_numbers"), optional("point_markers"), optional("point_attributes"),
        optional("cell_numbers"), optional("facet_numbers"), optional("edge_numbers"),
        py::arg("index_base") = 0, optional("comm"),
        "Collective. A mesh of which each rank of comm passes a part; cells stay where they "
        "are.\n\n"
        "points: (n, 3). cells: (m, 4), by number of the whole mesh, positively oriented. regions: "
        "(m,). facets, edges: tagged ones of this rank's cells, (k, 3) and (k, 2), with their "
        "markers, (k,). vertex_numbers: (n,), of the whole mesh, of `points`; None: as they stand, "
        "0 .. n-1, where all ranks pass all points or there is one rank. point_markers: (n,). "
        "point_attributes: (n,) or (n, a). cell_numbers, facet_numbers, edge_numbers: of the whole "
        "mesh, ascending; None on all ranks: the first rank's come first. index_base: what files "
        "call the first vertex, 0 or 1. A rank without a part passes empty arrays. InputError "
        "where "
        "ranks contradict each other, also in points, markers and attributes of a vertex; not "
        "checked is whether two ranks pass the same cell, which verify() finds.");
}

}  // namespace octetra::python
