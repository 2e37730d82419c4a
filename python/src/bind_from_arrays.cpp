#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/mesh_part.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// Sets the attributes, of shape (n,) or (n, k), of a part whose points are set.
void take_attributes(od::MeshPart& part, const py::object& given) {
    if (given.is_none()) return;
    const Values values = values_for(given, part.points.size(), "points");
    part.attributes_per_point = values.components;
    part.point_attributes = values_of<double>("point_attributes", values.array.attr("ravel")());
}

/// The numbers of the vertices; the indices of the points for None.
std::vector<std::uint64_t> numbers_of_points(const py::object& given, std::size_t count) {
    if (!given.is_none()) return values_of<std::uint64_t>("vertex_numbers", given);
    std::vector<std::uint64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

od::MeshPart part_of(const Arguments& arguments) {
    const auto [points, cells, regions, facets, facet_markers, edges, edge_markers, vertex_numbers,
                point_markers, point_attributes, cell_numbers, facet_numbers, edge_numbers,
                index_base, comm] = arguments.values<15>();
    if (points.is_none()) refuse("points", "numbers of shape (n, 3)", points);
    if (cells.is_none()) refuse("cells", "integers of shape (m, 4), numbers of points", cells);
    od::MeshPart part;
    part.points = values_of<Point>("points", points);
    part.vertex_numbers = numbers_of_points(vertex_numbers, part.points.size());
    part.point_markers = values_of<Marker>("point_markers", point_markers);
    take_attributes(part, point_attributes);
    part.cells = values_of<std::array<std::uint64_t, 4>>("cells", cells);
    part.regions = values_of<Marker>("regions", regions);
    part.cell_numbers = values_of<std::uint64_t>("cell_numbers", cell_numbers);
    part.facets = values_of<std::array<std::uint64_t, 3>>("facets", facets);
    part.facet_markers = values_of<Marker>("facet_markers", facet_markers);
    part.facet_numbers = values_of<std::uint64_t>("facet_numbers", facet_numbers);
    part.edges = values_of<std::array<std::uint64_t, 2>>("edges", edges);
    part.edge_markers = values_of<Marker>("edge_markers", edge_markers);
    part.edge_numbers = values_of<std::uint64_t>("edge_numbers", edge_numbers);
    part.index_base = integer_from<std::uint32_t>("index_base", index_base);
    return part;
}

/// A hash of the points; 0 for no points.
std::uint64_t hash_of(const std::vector<Point>& points) {
    if (points.empty()) return 0;
    const auto* const bytes = reinterpret_cast<const char*>(points.data());
    return std::hash<std::string_view>{}({bytes, points.size() * sizeof(Point)});
}

/// Collective. Do two ranks have different hashes, apart from 0?
bool have_different_points(const od::Communicator& processes, std::uint64_t hash) {
    const std::uint64_t greatest = processes.max(hash);
    return greatest != ~processes.max(hash == 0 ? ~greatest : ~hash);
}

MeshPointer mesh_of(const Arguments& arguments) {
    constexpr std::size_t no_position = ~std::size_t{0};  // a keyword alone
    const od::Communicator processes = processes_of(arguments.find("comm", no_position));
    od::MeshPart part;
    convert_on_each(processes, [&] { part = part_of(arguments); });
    const bool are_numbered = !arguments.find("vertex_numbers", no_position).is_none();
    const std::uint64_t hash = are_numbered ? 0 : hash_of(part.points);
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

/// The orientations of cells, given by rows in an array of points.
py::array orientations(const Arguments& arguments) {
    const auto [given_points, given_cells] = arguments.values<2>();
    const auto points = values_of<Point>("points", given_points);
    const auto cells = values_of<std::array<std::uint64_t, 4>>("cells", given_cells);
    std::vector<std::int8_t> signs;
    signs.reserve(cells.size());
    const StandardArithmetic standard;
    for (const auto& cell : cells) {
        std::array<Point, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            if (cell[k] >= points.size()) {
                throw InputError(fmt::format("cells: no point {}, there are {} points",
                                             static_cast<std::int64_t>(cell[k]), points.size()));
            }
            corners[k] = points[cell[k]];
        }
        signs.push_back(
            static_cast<std::int8_t>(orientation(corners[0], corners[1], corners[2], corners[3])));
    }
    return array_of(std::move(signs));
}

}  // namespace

void bind_from_arrays(py::module_& module) {
    def_function(
        module, "from_arrays",
        "points, cells, *, regions=None, facets=None, facet_markers=None, edges=None, "
        "edge_markers=None, vertex_numbers=None, point_markers=None, point_attributes=None, "
        "cell_numbers=None, facet_numbers=None, edge_numbers=None, index_base=0, comm=None",
        &mesh_of,
        "Collective. Creates a Mesh from arrays, of which each rank of comm passes its part. Every "
        "cell stays on the rank that passes it; a rank without cells passes empty arrays.\n\n"
        "points: (n, 3). cells: (m, 4), numbers of vertices in the whole mesh, positively "
        "oriented. regions: (m,). facets, edges: the tagged ones of this rank's cells, (k, 3) and "
        "(k, 2). facet_markers, edge_markers: (k,). vertex_numbers: (n,), the numbers of `points` "
        "in the whole mesh; None means 0 to n - 1, for one rank, or if all ranks pass all points. "
        "point_markers: (n,). point_attributes: (n,) or (n, a). cell_numbers, facet_numbers, "
        "edge_numbers: numbers in the whole mesh, ascending; None on all ranks numbers them in the "
        "order of ranks. index_base: the number of the first vertex in files, 0 or 1. comm: an "
        "mpi4py communicator; None means all ranks.\n\n"
        "Raises InputError if ranks contradict each other, also in the coordinates, marker or "
        "attributes of a vertex. Not detected is a cell that two ranks pass; Mesh.verify() detects "
        "it.");
    def_function(
        module, "orientations", "points, cells", orientations,
        "Returns the orientation of cells, int8 (cells,): 1 for a positively oriented cell, -1 for "
        "an inverted one, 0 for a flat one. points: (n, 3). cells: (cells, 4), rows of points. The "
        "result is exact: it does not depend on rounding.");
}

}  // namespace octetra::python
