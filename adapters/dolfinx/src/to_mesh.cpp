#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <dolfinx/common/IndexMap.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/graph/AdjacencyList.h>
#include <dolfinx/mesh/cell_types.h>

#include <octetra/distributed/mpi.hpp>
#include <octetra/dolfinx/convert.hpp>

#include "facet_tags.hpp"
#include "nodes.hpp"

// DOLFINx's create_mesh determines shared entities, owners of vertices and an order of cells. All
// this is known here, so the mesh is constructed from its parts instead.

namespace octetra::dolfinx {
namespace {

namespace od = distributed;
using IndexMap = ::dolfinx::common::IndexMap;
using Lists = ::dolfinx::graph::AdjacencyList<std::int32_t>;

/// The arrays of a mesh on this rank in the format of DOLFINx.
struct Arrays {
    std::vector<std::int32_t> corners;  ///< four nodes of each cell, owned cells first
    std::vector<std::int32_t> offsets;  ///< 0, 4, 8 ...
    std::vector<std::int64_t> cell_numbers;
    std::vector<double> points;
    std::vector<std::int64_t> vertex_numbers;
};

void take_cells(const od::AdaptiveMesh& mesh, const Nodes& nodes, Arrays& arrays) {
    arrays.corners.reserve(4 * mesh.cells().size() + nodes.ghost_cells.size());
    for (const CellVertices& cell : mesh.cells()) {
        for (const VertexIndex v : cell) arrays.corners.push_back(nodes.of_vertex[v.value()]);
    }
    arrays.corners.insert(arrays.corners.end(), nodes.ghost_cells.begin(), nodes.ghost_cells.end());
    arrays.offsets.resize(arrays.corners.size() / 4 + 1);
    for (std::size_t c = 0; c < arrays.offsets.size(); ++c) {
        arrays.offsets[c] = static_cast<std::int32_t>(4 * c);
    }
    const Numbering& cells = nodes.cell_numbering;
    arrays.cell_numbers.resize(mesh.cells().size());
    std::iota(arrays.cell_numbers.begin(), arrays.cell_numbers.end(), cells.first);
    arrays.cell_numbers.insert(arrays.cell_numbers.end(), cells.ghosts.begin(), cells.ghosts.end());
}

void take_points(const od::AdaptiveMesh& mesh, const od::GhostLayer* ghosts, const Nodes& nodes,
                 Arrays& arrays) {
    arrays.points.reserve(3 * nodes.vertices.size());
    arrays.vertex_numbers.reserve(nodes.vertices.size());
    const auto append = [&](const Point& p, od::GlobalVertex number) {
        arrays.points.insert(arrays.points.end(), {p.x, p.y, p.z});
        arrays.vertex_numbers.push_back(static_cast<std::int64_t>(number));
    };
    for (std::size_t i = 0; i < mesh.points().size(); ++i) {
        const std::size_t v = nodes.vertices[i].value();
        append(mesh.points()[v], mesh.vertex_numbers()[v]);
    }
    if (ghosts == nullptr) return;
    for (std::size_t k = 0; k < ghosts->points.size(); ++k) {
        append(ghosts->points[k], ghosts->vertex_numbers[k]);
    }
}

/// Collective.
std::shared_ptr<const IndexMap> index_map(MPI_Comm comm, const Numbering& numbering) {
    if (!numbering.knows_destinations) {
        return std::make_shared<IndexMap>(comm, numbering.own_count, numbering.ghosts,
                                          numbering.owners);
    }
    return std::make_shared<IndexMap>(comm, numbering.own_count,
                                      std::array{numbering.sources, numbering.destinations},
                                      numbering.ghosts, numbering.owners);
}

/// Collective.
std::shared_ptr<const ::dolfinx::mesh::Mesh> assemble(MPI_Comm comm, const Nodes& nodes,
                                                      Arrays arrays, bool has_ghosts) {
    using ::dolfinx::mesh::CellType;
    const auto node_map = index_map(comm, nodes.numbering);
    // A map with empty ghosts, instead of none, would tell DOLFINx that facets of one cell may be
    // interior.
    const auto cell_map =
        has_ghosts ? index_map(comm, nodes.cell_numbering)
                   : std::make_shared<const IndexMap>(comm, nodes.cell_numbering.own_count);
    auto corners = std::make_shared<Lists>(std::move(arrays.corners), std::move(arrays.offsets));
    ::dolfinx::mesh::Geometry geometry(
        node_map, Lists(*corners), ::dolfinx::fem::CoordinateElement(CellType::tetrahedron, 1),
        std::move(arrays.points), 3, std::move(arrays.vertex_numbers));
    ::dolfinx::mesh::Topology topology(comm, CellType::tetrahedron);
    topology.set_index_map(0, node_map);
    topology.set_index_map(3, cell_map);
    topology.set_connectivity(
        std::make_shared<Lists>(static_cast<std::int32_t>(nodes.vertices.size())), 0, 0);
    topology.set_connectivity(std::move(corners), 3, 0);
    topology.original_cell_index = std::move(arrays.cell_numbers);
    return std::make_shared<::dolfinx::mesh::Mesh>(comm, std::move(topology), std::move(geometry));
}

/// Collective. Returns the tags of owned cells and ghosts.
std::optional<MarkerTags> tag_cells(const od::AdaptiveMesh& mesh, const od::GhostLayer* ghosts,
                                    const std::shared_ptr<const ::dolfinx::mesh::Mesh>& made) {
    std::vector<Marker> values;
    std::vector<std::int32_t> cells;
    mesh.processes().transaction([&] {
        values = mesh.regions();
        if (ghosts != nullptr) {
            values.insert(values.end(), ghosts->regions.begin(), ghosts->regions.end());
        }
        cells.resize(values.size());
        std::iota(cells.begin(), cells.end(), 0);
    });
    const bool has_regions = mesh.processes().max(std::uint64_t{values.empty() ? 0U : 1U}) == 1;
    if (!has_regions) return std::nullopt;
    return MarkerTags(made, 3, std::move(cells), std::move(values));
}

}  // namespace

Handover to_mesh(const od::AdaptiveMesh& mesh, const HandoverOptions& options) {
    std::optional<od::GhostLayer> layer;
    if (options.ghosts && mesh.processes().size() > 1) layer = mesh.ghosts(*options.ghosts);
    const od::GhostLayer* ghosts = layer ? &*layer : nullptr;
    Nodes nodes = number_nodes(mesh, ghosts);
    Arrays arrays;
    Handover made;
    mesh.processes().transaction([&] {
        take_cells(mesh, nodes, arrays);
        take_points(mesh, ghosts, nodes, arrays);
        made.cells.reserve(mesh.cells().size());
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) made.cells.emplace_back(c);
    });
    made.mesh =
        assemble(od::comm_of(mesh.processes()), nodes, std::move(arrays), ghosts != nullptr);
    if (options.tags) {
        made.cell_tags = tag_cells(mesh, ghosts, made.mesh);
        made.facet_tags = tag_facets(mesh, nodes, made.mesh);
    }
    made.vertices = std::move(nodes.vertices);
    return made;
}

}  // namespace octetra::dolfinx
