#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/core/vertex_buckets.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "setup/ancestors_of_roots.hpp"
#include "setup/find_interfaces.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

/// Global properties of the mesh that every process needs.
struct Facts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t attributes_per_point = 0;
    std::uint32_t index_base = 0;
    std::uint32_t has_features = 0;
};

Facts facts_of(const Mesh& mesh) {
    return {mesh.points.size(), mesh.cells.size(), mesh.attributes_per_point, mesh.index_base,
            has_any(mesh.features) ? 1U : 0U};
}

/// Collective. Broadcasts the facts and group names of the first process's mesh in one message.
std::pair<Facts, std::vector<GroupName>> broadcast_facts(const Communicator& processes,
                                                         const Mesh& mesh) {
    std::vector<char> bytes;
    const auto put = [&](const void* data, std::size_t size) {
        const auto* first = static_cast<const char*>(data);
        bytes.insert(bytes.end(), first, first + size);
    };
    struct NameHead {
        std::int32_t dimension;
        Marker tag;
        std::uint64_t length;
    };
    const Facts own = facts_of(mesh);
    put(&own, sizeof own);
    for (const GroupName& group : mesh.group_names) {
        const NameHead head{group.dimension, group.tag, group.name.size()};
        put(&head, sizeof head);
        put(group.name.data(), group.name.size());
    }
    processes.broadcast(bytes);

    std::size_t at = 0;
    const auto take = [&](void* data, std::size_t size) {
        std::memcpy(data, bytes.data() + at, size);
        at += size;
    };
    std::pair<Facts, std::vector<GroupName>> shared;
    take(&shared.first, sizeof shared.first);
    while (at < bytes.size()) {
        NameHead head{};
        take(&head, sizeof head);
        shared.second.push_back({head.dimension, head.tag, std::string(head.length, '\0')});
        take(shared.second.back().name.data(), head.length);
    }
    return shared;
}

/// The entities of one kind that one process receives.
template <std::size_t N>
struct ListShare {
    std::vector<std::uint64_t> numbers;                ///< global numbers, ascending
    std::vector<std::array<VertexIndex, N>> vertices;  ///< local indices
    std::vector<Marker> markers;                       ///< may be empty
};

/// All data that one process receives.
struct Share {
    std::vector<GlobalVertex> vertices;  ///< ascending
    std::vector<Point> points;
    std::vector<Marker> point_markers;
    std::vector<double> point_attributes;
    ListShare<4> cells;
    ListShare<3> facets;
    ListShare<2> edges;

    /// Calls f on each array, in the same order on all processes.
    void for_each_array(auto&& f) {
        f(vertices), f(points), f(point_markers), f(point_attributes);
        const auto list = [&](auto& l) { f(l.numbers), f(l.vertices), f(l.markers); };
        list(cells), list(facets), list(edges);
    }
};

/// The entities of a list, grouped by receiving rank.
class ByRank {
public:
    ByRank() = default;
    ByRank(const std::vector<int>& ranks, int rank_count)
        : begin_(static_cast<std::size_t>(rank_count) + 1, 0), numbers_(ranks.size()) {
        for (const int rank : ranks) ++begin_[static_cast<std::size_t>(rank) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        auto next = begin_;
        for (std::uint32_t i = 0; i < ranks.size(); ++i) {
            numbers_[next[static_cast<std::size_t>(ranks[i])]++] = i;
        }
    }
    [[nodiscard]] std::span<const std::uint32_t> of(int rank) const {
        const auto r = static_cast<std::size_t>(rank);
        return std::span(numbers_).subspan(begin_[r], begin_[r + 1] - begin_[r]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> numbers_;
};

/// Returns the rank of each entity of a list: that of the first cell that has it among its `sides`.
template <class I, std::size_t N, std::size_t Sides>
std::vector<int> ranks_of(const Mesh& mesh, const std::vector<int>& cell_to_rank,
                          const IndexVector<I, std::array<VertexIndex, N>>& list,
                          const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::vector<int> ranks(list.size(), 0);
    if (list.empty()) return ranks;
    const VertexBuckets<I, N> buckets(list, mesh.points.size());
    // descending, so the first cell is written last
    for (CellIndex c{mesh.cells.size()}; c > CellIndex{0};) {
        c = CellIndex{c.value() - 1U};
        for (const auto& side : sides) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) vertices[k] = mesh.cells[c][side[k]];
            buckets.find(vertices, [&](I i) { ranks[i.value()] = cell_to_rank[c.value()]; });
        }
    }
    return ranks;
}

/// Extracts one process's share of a mesh at a time. The first process's share must be extracted
/// last: it also contains the vertices that no cell has.
class ShareExtractor {
public:
    ShareExtractor(const Mesh& mesh, const std::vector<int>& cell_to_rank, int rank_count)
        : mesh_(&mesh),
          cells_(cell_to_rank, rank_count),
          facets_(ranks_of(mesh, cell_to_rank, mesh.facets, cell_faces), rank_count),
          edges_(ranks_of(mesh, cell_to_rank, mesh.edges, cell_edges), rank_count),
          received_by_(mesh.points.size(), no_rank),
          local_(mesh.points.size()) {}

    [[nodiscard]] Share share_of(int rank) {
        Share share;
        share.vertices = vertices_of(rank);
        share.points.reserve(share.vertices.size());
        for (std::size_t i = 0; i < share.vertices.size(); ++i) {
            const VertexIndex v{static_cast<std::uint64_t>(share.vertices[i])};
            local_[v] = VertexIndex{i};
            share.points.push_back(mesh_->points[v]);
            if (!mesh_->point_markers.empty()) {
                share.point_markers.push_back(mesh_->point_markers[v]);
            }
            const std::size_t count = mesh_->attributes_per_point;
            const auto begin =
                mesh_->point_attributes.begin() + static_cast<std::ptrdiff_t>(v.value() * count);
            share.point_attributes.insert(share.point_attributes.end(), begin,
                                          begin + static_cast<std::ptrdiff_t>(count));
        }
        share.cells = list_share(cells_.of(rank), mesh_->cells, mesh_->regions);
        share.facets = list_share(facets_.of(rank), mesh_->facets, mesh_->facet_markers);
        share.edges = list_share(edges_.of(rank), mesh_->edges, mesh_->edge_markers);
        return share;
    }

private:
    static constexpr int no_rank = -1;

    std::vector<GlobalVertex> vertices_of(int rank) {
        std::vector<GlobalVertex> vertices;
        for (const std::uint32_t c : cells_.of(rank)) {
            for (const VertexIndex v : mesh_->cells[CellIndex{c}]) {
                if (received_by_[v] == rank) continue;
                received_by_[v] = rank;
                vertices.push_back(GlobalVertex{v.value()});
            }
        }
        if (rank == 0) {
            for (VertexIndex v{0}; v < mesh_->points.end_index(); ++v) {
                if (received_by_[v] == no_rank) vertices.push_back(GlobalVertex{v.value()});
            }
        }
        std::ranges::sort(vertices);
        return vertices;
    }

    template <class I, std::size_t N>
    [[nodiscard]] ListShare<N> list_share(std::span<const std::uint32_t> numbers,
                                          const IndexVector<I, std::array<VertexIndex, N>>& list,
                                          const IndexVector<I, Marker>& markers) const {
        ListShare<N> share;
        share.numbers.assign(numbers.begin(), numbers.end());
        share.vertices.reserve(numbers.size());
        for (const std::uint32_t i : numbers) {
            auto vertices = list[I{i}];
            for (VertexIndex& v : vertices) v = local_[v];
            share.vertices.push_back(vertices);
            if (!markers.empty()) share.markers.push_back(markers[I{i}]);
        }
        return share;
    }

    const Mesh* mesh_;
    ByRank cells_;
    ByRank facets_;
    ByRank edges_;
    IndexVector<VertexIndex, int> received_by_;    ///< the last rank that received a vertex
    IndexVector<VertexIndex, VertexIndex> local_;  ///< its local index there
};

void check_ranks(const Mesh& mesh, const std::vector<int>& cell_to_rank, int rank_count) {
    if (cell_to_rank.size() != mesh.cells.size()) {
        throw InputError(fmt::format("{} ranks for {} cells: pass one rank for each cell",
                                     cell_to_rank.size(), mesh.cells.size()));
    }
    for (const int rank : cell_to_rank) {
        if (rank >= 0 && rank < rank_count) continue;
        throw InputError(
            fmt::format("a cell is assigned to rank {}, but there are {} ranks", rank, rank_count));
    }
}

/// Collective. The first process sends each share and keeps its own. It holds at most one share at
/// a time in addition to the mesh.
Share send_shares(const Communicator& processes, const Mesh& mesh,
                  const std::vector<int>& cell_to_rank) {
    std::optional<ShareExtractor> extractor;
    if (processes.is_first()) extractor.emplace(mesh, cell_to_rank, processes.size());
    Share own;
    for (int rank = 1; rank < processes.size(); ++rank) {
        Share share;
        if (extractor) share = extractor->share_of(rank);
        // Only the first process and the receiver have a neighbour in these exchanges.
        std::vector<int> neighbour;
        if (extractor) neighbour.push_back(rank);
        if (processes.rank() == rank) neighbour.push_back(0);
        share.for_each_array([&]<class T>(std::vector<T>& values) {
            std::vector<std::vector<T>> sent(neighbour.size());
            if (extractor) sent.front() = std::move(values);
            auto received = processes.exchange_with(neighbour, sent);
            if (processes.rank() == rank) values = std::move(received.front());
        });
        if (processes.rank() == rank) own = std::move(share);
    }
    return extractor ? extractor->share_of(0) : own;
}

template <class I, std::size_t N>
void take_list(ListShare<N> share, IndexVector<I, std::array<VertexIndex, N>>& entities,
               AncestorMap& ancestors) {
    entities.assign(share.vertices.begin(), share.vertices.end());
    ancestors = ancestors_of_roots(std::move(share.numbers), std::move(share.markers));
}

void take_share(Share share, DistributedMesh& part) {
    part.input_vertices = std::move(share.vertices);
    part.points.assign(share.points.begin(), share.points.end());
    part.input_vertex_markers = std::move(share.point_markers);
    part.point_attributes = std::move(share.point_attributes);
    take_list(std::move(share.cells), part.cells, part.cell_ancestors);
    take_list(std::move(share.facets), part.facets, part.facet_ancestors);
    take_list(std::move(share.edges), part.edges, part.edge_ancestors);
}

/// Moves the whole mesh to the part if there is only one process.
void move_mesh(Mesh mesh, DistributedMesh& part) {
    const auto all = [](std::size_t count) {
        std::vector<std::uint64_t> numbers(count);
        std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
        return numbers;
    };
    part.point_attributes = std::move(mesh.point_attributes);
    part.input_vertices.reserve(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        part.input_vertices.push_back(GlobalVertex{v.value()});
    }
    part.input_vertex_markers = std::move(mesh.point_markers);
    part.cell_ancestors = ancestors_of_roots(all(mesh.cells.size()), std::move(mesh.regions));
    part.facet_ancestors =
        ancestors_of_roots(all(mesh.facets.size()), std::move(mesh.facet_markers));
    part.edge_ancestors = ancestors_of_roots(all(mesh.edges.size()), std::move(mesh.edge_markers));
    part.points = std::move(mesh.points);
    part.cells = std::move(mesh.cells);
    part.facets = std::move(mesh.facets);
    part.edges = std::move(mesh.edges);
}

/// Collective, within a transaction.
DistributedMesh parts_of(const Communicator& processes, Mesh mesh,
                         const std::vector<int>& cell_to_rank) {
    const Phase phase(processes, "distribute");
    if (processes.is_first() && processes.size() > 1) {
        check_ranks(mesh, cell_to_rank, processes.size());
    }
    auto [facts, group_names] = broadcast_facts(processes, mesh);

    DistributedMesh part;
    part.processes = processes;
    part.attributes_per_point = facts.attributes_per_point;
    part.input_vertex_count = facts.vertices;
    part.input_cell_count = facts.cells;
    part.index_base = facts.index_base;
    part.group_names = SharedGroupNames(std::move(group_names));
    if (facts.has_features != 0) {
        part.features = std::make_shared<const FeatureLists>(std::move(mesh.features));
    }
    if (processes.size() == 1) {
        move_mesh(std::move(mesh), part);
        return part;
    }
    take_share(send_shares(processes, mesh, cell_to_rank), part);
    mesh = {};  // releases the memory
    const Phase finding(processes, "interfaces");
    part.interfaces = find_interfaces(part, find_vertex_sharing(part));
    return part;
}

}  // namespace

DistributedMesh distribute(const Communicator& processes, Mesh mesh,
                           const std::vector<int>& cell_to_rank) {
    const StandardArithmetic standard;
    return processes.transaction(
        [&] { return parts_of(processes, std::move(mesh), cell_to_rank); });
}

}  // namespace octetra::distributed
