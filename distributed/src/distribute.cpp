#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <octetra/core/vertex_buckets.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "interfaces.hpp"

namespace octetra::distributed {
namespace {

/// Facts about the whole mesh that every process needs.
struct Facts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t attributes_per_point = 0;
    std::uint32_t first_number = 0;
    bool has_point_markers = false;
    bool has_regions = false;
    bool has_facet_markers = false;
    bool has_edge_markers = false;
};

Facts facts_of(const Mesh& mesh) {
    return {mesh.points.size(),          mesh.cells.size(),           mesh.attributes_per_point,
            mesh.first_number,           !mesh.point_markers.empty(), !mesh.regions.empty(),
            !mesh.facet_markers.empty(), !mesh.edge_markers.empty()};
}

template <class T>
using PerRank = std::vector<std::vector<T>>;

/// The ranks of the cells at hand, taken apart: for each rank, what goes there.
class Sender {
public:
    Sender(const Communicator& processes, const Mesh& mesh, const std::vector<int>& cell_to_rank)
        : processes_(&processes), mesh_(&mesh), cell_to_rank_(&cell_to_rank) {
        if (!processes.is_first()) return;
        const auto count = static_cast<std::size_t>(processes.size());
        cells_.resize(count);
        for (std::size_t c = 0; c < cell_to_rank.size(); ++c) {
            cells_[static_cast<std::size_t>(cell_to_rank[c])].push_back(
                static_cast<std::uint32_t>(c));
        }
        vertices_.resize(count);
        for (std::size_t r = 0; r < count; ++r) {
            for (const std::uint32_t c : cells_[r]) {
                const CellVertices& cell = mesh.cells[CellIndex{c}];
                vertices_[r].insert(vertices_[r].end(), cell.begin(), cell.end());
            }
            std::ranges::sort(vertices_[r]);
            vertices_[r].erase(std::unique(vertices_[r].begin(), vertices_[r].end()),
                               vertices_[r].end());
        }
        // A vertex that no cell has belongs to the first process, so that it is not lost.
        std::vector<bool> used(mesh.points.size(), false);
        for (const CellVertices& cell : mesh.cells) {
            for (const VertexIndex v : cell) used[v.value()] = true;
        }
        for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
            if (!used[v.value()]) vertices_.front().push_back(v);
        }
        std::ranges::sort(vertices_.front());
    }

    [[nodiscard]] const PerRank<std::uint32_t>& cells() const { return cells_; }
    [[nodiscard]] const PerRank<VertexIndex>& vertices() const { return vertices_; }

    /// For each rank, value(i) for each i of the rank's list.
    template <class T, class I>
    [[nodiscard]] std::vector<T> scatter(const PerRank<I>& lists, auto&& value) const {
        PerRank<T> to_each(lists.size());
        for (std::size_t r = 0; r < lists.size(); ++r) {
            to_each[r].reserve(lists[r].size());
            for (const I i : lists[r]) to_each[r].push_back(value(i));
        }
        return processes_->scatter(to_each);
    }

    /// For each rank, the entities of a list whose cells it has: each goes to the rank of the first
    /// cell that has it among its `sides`.
    template <class I, std::size_t N, std::size_t Sides>
    [[nodiscard]] PerRank<std::uint32_t> owned(
        const IndexVector<I, std::array<VertexIndex, N>>& list,
        const std::array<std::array<std::uint8_t, N>, Sides>& sides) const {
        if (!processes_->is_first()) return {};
        PerRank<std::uint32_t> owned(cells_.size());
        const VertexBuckets<I, N> buckets(list, mesh_->points.size());
        IndexVector<I, int> owner(list.size(), 0);
        for (CellIndex c{mesh_->cells.size()}; c > CellIndex{0};) {  // the first one comes last
            c = CellIndex{c.value() - 1U};
            for (const auto& side : sides) {
                std::array<VertexIndex, N> vertices;
                for (std::size_t k = 0; k < N; ++k) vertices[k] = mesh_->cells[c][side[k]];
                buckets.find(vertices, [&](I i) { owner[i] = (*cell_to_rank_)[c.value()]; });
            }
        }
        for (I i{0}; i < list.end_index(); ++i) {
            owned[static_cast<std::size_t>(owner[i])].push_back(i.value());
        }
        return owned;
    }

private:
    const Communicator* processes_;
    const Mesh* mesh_;
    const std::vector<int>* cell_to_rank_;
    PerRank<std::uint32_t> cells_;
    PerRank<VertexIndex> vertices_;
};

/// Numbers vertices of the input locally: their positions in this process's ascending list.
template <class I, std::size_t N>
IndexVector<I, std::array<VertexIndex, N>> numbered_locally(
    const std::vector<std::array<VertexIndex, N>>& entities,
    const std::vector<GlobalVertex>& input_vertices) {
    IndexVector<I, std::array<VertexIndex, N>> result;
    result.reserve(entities.size());
    for (std::array<VertexIndex, N> vertices : entities) {
        for (VertexIndex& v : vertices) {
            const auto place = std::ranges::lower_bound(input_vertices, GlobalVertex{v.value()});
            v = VertexIndex{static_cast<std::size_t>(place - input_vertices.begin())};
        }
        result.push_back(vertices);
    }
    return result;
}

Lineage lineage_of(std::vector<std::uint64_t> roots, std::vector<Marker> markers) {
    Lineage lineage{.roots = std::move(roots), .first = {}, .markers = std::move(markers)};
    lineage.first.resize(lineage.roots.size() + 1);
    std::iota(lineage.first.begin(), lineage.first.end(), 0U);
    return lineage;
}

/// Entities of one kind, their numbers in the input, and their markers.
template <class I, std::size_t N>
void scatter_entities(const Sender& sender, const PerRank<std::uint32_t>& numbers,
                      const IndexVector<I, std::array<VertexIndex, N>>& all,
                      const IndexVector<I, Marker>& all_markers, bool has_markers,
                      const std::vector<GlobalVertex>& input_vertices,
                      IndexVector<I, std::array<VertexIndex, N>>& entities, Lineage& lineage) {
    auto roots =
        sender.scatter<std::uint64_t>(numbers, [](std::uint32_t i) { return std::uint64_t{i}; });
    std::vector<Marker> markers;
    if (has_markers) {
        markers =
            sender.scatter<Marker>(numbers, [&](std::uint32_t i) { return all_markers[I{i}]; });
    }
    entities = numbered_locally<I, N>(sender.scatter<std::array<VertexIndex, N>>(
                                          numbers, [&](std::uint32_t i) { return all[I{i}]; }),
                                      input_vertices);
    lineage = lineage_of(std::move(roots), std::move(markers));
}

void scatter_vertices(const Sender& sender, const Mesh& mesh, const Facts& facts,
                      DistributedMesh& part) {
    part.input_vertices = sender.scatter<GlobalVertex>(
        sender.vertices(), [](VertexIndex v) { return GlobalVertex{v.value()}; });
    const auto points =
        sender.scatter<Point>(sender.vertices(), [&](VertexIndex v) { return mesh.points[v]; });
    part.points.assign(points.begin(), points.end());
    if (facts.has_point_markers) {
        part.input_vertex_markers = sender.scatter<Marker>(
            sender.vertices(), [&](VertexIndex v) { return mesh.point_markers[v]; });
    }
    const std::size_t count = facts.attributes_per_point;
    part.attributes_per_point = count;
    part.point_attributes.resize(count * part.points.size());
    for (std::size_t k = 0; k < count; ++k) {
        const auto attribute = sender.scatter<double>(sender.vertices(), [&](VertexIndex v) {
            return mesh.point_attributes[v.value() * count + k];
        });
        for (std::size_t v = 0; v < attribute.size(); ++v) {
            part.point_attributes[v * count + k] = attribute[v];
        }
    }
}

/// The whole mesh on one process: nothing to send, and nothing to copy.
void take_over(Mesh mesh, DistributedMesh& part) {
    const auto all = [](std::size_t count) {
        std::vector<std::uint64_t> numbers(count);
        std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
        return numbers;
    };
    part.attributes_per_point = mesh.attributes_per_point;
    part.point_attributes = std::move(mesh.point_attributes);
    part.input_vertices.reserve(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        part.input_vertices.push_back(GlobalVertex{v.value()});
    }
    part.input_vertex_markers = std::move(mesh.point_markers);
    part.cell_lineage = lineage_of(all(mesh.cells.size()), std::move(mesh.regions));
    part.facet_lineage = lineage_of(all(mesh.facets.size()), std::move(mesh.facet_markers));
    part.edge_lineage = lineage_of(all(mesh.edges.size()), std::move(mesh.edge_markers));
    part.points = std::move(mesh.points);
    part.cells = std::move(mesh.cells);
    part.facets = std::move(mesh.facets);
    part.edges = std::move(mesh.edges);
}

}  // namespace

DistributedMesh distribute(const Communicator& processes, Mesh mesh,
                           const std::vector<int>& cell_to_rank) {
    const Phase phase(processes, "distribute");
    std::vector<Facts> shared{facts_of(mesh)};
    processes.broadcast(shared);
    const Facts facts = shared.front();

    DistributedMesh part;
    part.processes = processes;
    part.input_vertex_count = facts.vertices;
    part.input_cell_count = facts.cells;
    part.first_number = facts.first_number;
    if (processes.size() == 1) {
        take_over(std::move(mesh), part);
        return part;
    }
    const Sender sender(processes, mesh, cell_to_rank);
    scatter_vertices(sender, mesh, facts, part);
    scatter_entities(sender, sender.cells(), mesh.cells, mesh.regions, facts.has_regions,
                     part.input_vertices, part.cells, part.cell_lineage);
    scatter_entities(sender, sender.owned(mesh.facets, cell_faces), mesh.facets, mesh.facet_markers,
                     facts.has_facet_markers, part.input_vertices, part.facets, part.facet_lineage);
    scatter_entities(sender, sender.owned(mesh.edges, cell_edges), mesh.edges, mesh.edge_markers,
                     facts.has_edge_markers, part.input_vertices, part.edges, part.edge_lineage);
    const Phase finding(processes, "interfaces");
    part.interfaces = find_interfaces(part);
    return part;
}

}  // namespace octetra::distributed
