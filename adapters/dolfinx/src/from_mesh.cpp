#include <algorithm>
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

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/mpi.hpp>
#include <octetra/dolfinx/convert.hpp>

namespace octetra::dolfinx {
namespace {

namespace od = distributed;
using Mesh = ::dolfinx::mesh::Mesh;

/// Checks properties that are the same on all ranks.
void check_kind(const Mesh& mesh, const MarkerTags* cell_tags, const MarkerTags* facet_tags) {
    if (mesh.topology().cell_type() != ::dolfinx::mesh::CellType::tetrahedron) {
        throw InputError("the cells of the DOLFINx mesh are not tetrahedra");
    }
    if (mesh.geometry().cmap().degree() != 1 || mesh.geometry().dim() != 3) {
        throw InputError("the cells of the DOLFINx mesh are not affine tetrahedra in space");
    }
    if (cell_tags != nullptr && cell_tags->dim() != 3) {
        throw InputError("cell_tags are not of cells");
    }
    if (facet_tags != nullptr && facet_tags->dim() != 2) {
        throw InputError("facet_tags are not of facets");
    }
    if (facet_tags != nullptr && !mesh.topology().connectivity(2, 0)) {
        throw InputError("facet_tags: the DOLFINx mesh has no facets");
    }
}

/// The part of a rank, read from the DOLFINx mesh.
class Part {
public:
    explicit Part(const Mesh& mesh)
        : mesh_(mesh),
          cell_map_(*mesh.topology().index_map(3)),
          vertex_map_(*mesh.topology().index_map(0)) {}

    [[nodiscard]] std::size_t cell_count() const {
        return static_cast<std::size_t>(cell_map_.size_local());
    }
    [[nodiscard]] std::size_t node_count() const { return mesh_.geometry().x().size() / 3; }
    [[nodiscard]] Point point(std::size_t node) const {
        const double* x = mesh_.geometry().x().data() + 3 * node;
        return {x[0], x[1], x[2]};
    }
    /// Returns the nodes of a cell, with the last two exchanged if it is inverted.
    [[nodiscard]] std::array<std::size_t, 4> nodes(std::size_t cell) const {
        std::array<std::size_t, 4> nodes{};
        std::array<Point, 4> points;
        for (std::size_t k = 0; k < 4; ++k) {
            nodes[k] = node(static_cast<std::int32_t>(cell), k);
            points[k] = point(nodes[k]);
        }
        if (orientation(points[0], points[1], points[2], points[3]) < 0) {
            std::swap(nodes[2], nodes[3]);
        }
        return nodes;
    }

    /// Returns whether the mesh has the original numbers of its vertices and cells.
    [[nodiscard]] bool knows_input() const {
        const auto& vertices = mesh_.geometry().input_global_indices();
        const auto& cells = mesh_.topology().original_cell_index;
        const auto is_within = [](std::int64_t count) {
            return [count](std::int64_t number) { return number >= 0 && number < count; };
        };
        return vertices.size() == node_count() && cells.size() >= cell_count() &&
               std::ranges::all_of(vertices, is_within(vertex_map_.size_global())) &&
               std::ranges::all_of(std::span(cells).first(cell_count()),
                                   is_within(cell_map_.size_global()));
    }
    /// Returns the global vertex numbers, by node.
    [[nodiscard]] std::vector<std::uint64_t> vertex_numbers(bool of_input) const {
        std::vector<std::uint64_t> numbers(node_count());
        if (of_input) {
            std::ranges::copy(mesh_.geometry().input_global_indices(), numbers.begin());
            return numbers;
        }
        const std::vector<std::int64_t> of_vertices = vertex_map_.global_indices();
        const auto& topology = *mesh_.topology().connectivity(3, 0);
        for (std::int32_t c = 0; c < topology.num_nodes(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                numbers[node(c, k)] = static_cast<std::uint64_t>(
                    of_vertices[static_cast<std::size_t>(topology.links(c)[k])]);
            }
        }
        return numbers;
    }
    /// Returns the rank's own cells in the order of their numbers.
    [[nodiscard]] std::vector<std::size_t> ordered_cells(bool of_input) const {
        std::vector<std::size_t> cells(cell_count());
        std::iota(cells.begin(), cells.end(), std::size_t{0});
        const auto number = [&](std::size_t c) { return mesh_.topology().original_cell_index[c]; };
        if (of_input) std::ranges::sort(cells, {}, number);
        return cells;
    }

    [[nodiscard]] std::vector<std::size_t> nodes_of_vertices() const {
        std::vector<std::size_t> nodes(static_cast<std::size_t>(vertex_map_.size_local()) +
                                       static_cast<std::size_t>(vertex_map_.num_ghosts()));
        const auto& topology = *mesh_.topology().connectivity(3, 0);
        for (std::int32_t c = 0; c < topology.num_nodes(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                nodes[static_cast<std::size_t>(topology.links(c)[k])] = node(c, k);
            }
        }
        return nodes;
    }
    /// Returns, for each facet of this rank, whether it belongs to a cell owned by this rank.
    [[nodiscard]] std::vector<std::uint8_t> facets_of_own_cells(std::int32_t facet_count) const {
        std::vector<std::uint8_t> is_own(static_cast<std::size_t>(facet_count), 0);
        const auto& facets = *mesh_.topology().connectivity(3, 2);
        for (std::int32_t c = 0; c < cell_map_.size_local(); ++c) {
            for (const std::int32_t f : facets.links(c)) is_own[static_cast<std::size_t>(f)] = 1;
        }
        return is_own;
    }

private:
    [[nodiscard]] std::size_t node(std::int32_t cell, std::size_t k) const {
        return static_cast<std::size_t>(mesh_.geometry().dofmap().links(cell)[k]);
    }

    const Mesh& mesh_;
    const ::dolfinx::common::IndexMap& cell_map_;
    const ::dolfinx::common::IndexMap& vertex_map_;
};

void take_cells(const Part& dolfinx, const std::vector<std::size_t>& order, od::MeshPart& part) {
    part.cells.reserve(order.size());
    for (const std::size_t c : order) {
        auto& corners = part.cells.emplace_back();
        std::ranges::transform(dolfinx.nodes(c), corners.begin(),
                               [&](std::size_t node) { return part.vertex_numbers[node]; });
    }
}

void take_cell_tags(const MarkerTags& tags, const std::vector<std::size_t>& order,
                    od::MeshPart& part) {
    std::vector<Marker> of_cells(order.size(), 0);
    for (std::size_t i = 0; i < tags.indices().size(); ++i) {
        const std::int32_t cell = tags.indices()[i];
        if (cell < 0) throw InputError("cell_tags: a negative cell index");
        if (static_cast<std::size_t>(cell) < of_cells.size()) {  // otherwise a ghost
            of_cells[static_cast<std::size_t>(cell)] = tags.values()[i];
        }
    }
    part.regions.reserve(order.size());
    for (const std::size_t c : order) part.regions.push_back(of_cells[c]);
}

void take_facet_tags(const Mesh& mesh, const Part& dolfinx, const MarkerTags& tags,
                     od::MeshPart& part) {
    const auto corners = mesh.topology().connectivity(2, 0);
    const std::vector<std::uint8_t> is_own = dolfinx.facets_of_own_cells(corners->num_nodes());
    const std::vector<std::size_t> nodes = dolfinx.nodes_of_vertices();
    for (std::size_t i = 0; i < tags.indices().size(); ++i) {
        const std::int32_t facet = tags.indices()[i];
        if (facet < 0 || facet >= corners->num_nodes()) {
            throw InputError("facet_tags: no such facet");
        }
        if (is_own[static_cast<std::size_t>(facet)] == 0) continue;
        auto& vertices = part.facets.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(corners->links(facet)[k]);
            vertices[k] = part.vertex_numbers[nodes[vertex]];
        }
        part.facet_markers.push_back(tags.values()[i]);
    }
}

od::MeshPart part_of(const Mesh& mesh, const Part& dolfinx, bool of_input,
                     const std::vector<std::size_t>& order, const MarkerTags* cell_tags,
                     const MarkerTags* facet_tags) {
    od::MeshPart part;
    part.vertex_numbers = dolfinx.vertex_numbers(of_input);
    part.points.reserve(dolfinx.node_count());
    for (std::size_t n = 0; n < dolfinx.node_count(); ++n) part.points.push_back(dolfinx.point(n));
    take_cells(dolfinx, order, part);
    if (of_input) {
        for (const std::size_t c : order) {
            part.cell_numbers.push_back(
                static_cast<std::uint64_t>(mesh.topology().original_cell_index[c]));
        }
    }
    if (cell_tags != nullptr) take_cell_tags(*cell_tags, order, part);
    if (facet_tags != nullptr) take_facet_tags(mesh, dolfinx, *facet_tags, part);
    return part;
}

/// Sets the correspondence: cells of the AdaptiveMesh are in this order, each with its original
/// corners.
void take_numbers(const od::AdaptiveMesh& made, const Part& dolfinx,
                  const std::vector<std::size_t>& order, Handover& handover) {
    handover.cells.resize(order.size());
    handover.vertices.assign(dolfinx.node_count(), VertexIndex::none());
    for (std::size_t i = 0; i < order.size(); ++i) {
        handover.cells[order[i]] = CellIndex{i};
        const auto nodes = dolfinx.nodes(order[i]);
        for (std::size_t k = 0; k < 4; ++k) handover.vertices[nodes[k]] = made.cells()[i][k];
    }
}

}  // namespace

std::pair<od::AdaptiveMesh, Handover> from_mesh(std::shared_ptr<const Mesh> mesh,
                                                const MarkerTags* cell_tags,
                                                const MarkerTags* facet_tags) {
    check_kind(*mesh, cell_tags, facet_tags);
    const od::Communicator processes = od::communicator_of(mesh->comm());
    const Part dolfinx(*mesh);
    const bool of_input = processes.max(std::uint64_t{dolfinx.knows_input() ? 0U : 1U}) == 0;
    std::vector<std::size_t> order;
    od::MeshPart part;
    processes.transaction([&] {
        order = dolfinx.ordered_cells(of_input);
        part = part_of(*mesh, dolfinx, of_input, order, cell_tags, facet_tags);
    });
    auto made = od::AdaptiveMesh::from_parts(processes, std::move(part));
    Handover handover{.mesh = std::move(mesh)};
    processes.transaction([&] { take_numbers(made, dolfinx, order, handover); });
    if (cell_tags != nullptr) handover.cell_tags = *cell_tags;
    if (facet_tags != nullptr) handover.facet_tags = *facet_tags;
    return {std::move(made), std::move(handover)};
}

}  // namespace octetra::dolfinx
