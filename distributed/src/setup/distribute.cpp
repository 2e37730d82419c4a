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

#include "assemble/ancestors_of_roots.hpp"
#include "assemble/arrivals.hpp"
#include "assemble/departures.hpp"
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
        const std::size_t end = bytes.size();
        bytes.resize(end + size);
        std::memcpy(bytes.data() + end, data, size);
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

/// Moves the whole mesh to a part.
void move_mesh(Mesh mesh, DistributedMesh& part) {
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
    part.cell_ancestors = ancestors_of_roots(all(mesh.cells.size()), std::move(mesh.regions));
    part.facet_ancestors =
        ancestors_of_roots(all(mesh.facets.size()), std::move(mesh.facet_markers));
    part.edge_ancestors = ancestors_of_roots(all(mesh.edges.size()), std::move(mesh.edge_markers));
    part.points = std::move(mesh.points);
    part.cells = std::move(mesh.cells);
    part.facets = std::move(mesh.facets);
    part.edges = std::move(mesh.edges);
}

/// Returns the vertices that no cell has, ascending.
std::vector<VertexIndex> unused_vertices(const DistributedMesh& mesh) {
    std::vector<bool> is_used(mesh.points.size(), false);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) is_used[v.value()] = true;
    }
    std::vector<VertexIndex> unused;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (!is_used[v.value()]) unused.push_back(v);
    }
    return unused;
}

/// Collective. The first process sends each part of the mesh, and keeps its own with the vertices
/// that no cell has. It holds at most one message at a time in addition to the mesh.
RootMessage send_parts(const Communicator& processes, DistributedMesh whole,
                       const std::vector<int>& cell_to_rank) {
    std::optional<Departures> departures;
    std::optional<MessageMaker> maker;
    if (processes.is_first()) {
        departures.emplace(departures_of(std::move(whole), {}, cell_to_rank));
        maker.emplace(*departures);
    }
    RootMessage own;
    for (int rank = 1; rank < processes.size(); ++rank) {
        // Only the first process and the receiver have a neighbour in this exchange.
        std::vector<int> neighbour;
        std::vector<std::vector<std::byte>> sent;
        if (maker) {
            neighbour.push_back(rank);
            sent.push_back(maker->message_to(rank).packed());
        } else if (processes.rank() == rank) {
            neighbour.push_back(0);
            sent.emplace_back();
        }
        const auto received = processes.exchange_with(neighbour, sent);
        if (processes.rank() == rank) own = RootMessage::unpacked(received.front());
    }
    return maker ? maker->message_to(0, unused_vertices(departures->input)) : std::move(own);
}

/// Collective, within a transaction.
DistributedMesh parts_of(const Communicator& processes, Mesh mesh,
                         const std::vector<int>& cell_to_rank) {
    const Phase phase(processes, "distribute");
    if (processes.is_first() && processes.size() > 1) {
        check_ranks(mesh, cell_to_rank, processes.size());
    }
    auto [facts, group_names] = broadcast_facts(processes, mesh);

    const bool has_features = facts.has_features != 0;
    SharedFeatures features;
    if (has_features) features = std::make_shared<const FeatureLists>(std::move(mesh.features));
    DistributedMesh part;
    part.processes = processes;
    if (processes.is_first()) move_mesh(std::move(mesh), part);
    if (processes.size() > 1) {
        const HasLists has(part);
        part = arrivals_of({send_parts(processes, std::move(part), cell_to_rank)}, has,
                           facts.attributes_per_point)
                   .part;
        part.processes = processes;
    }
    part.attributes_per_point = facts.attributes_per_point;
    part.input_vertex_count = facts.vertices;
    part.input_cell_count = facts.cells;
    part.index_base = facts.index_base;
    part.group_names = SharedGroupNames(std::move(group_names));
    part.features = std::move(features);
    if (processes.size() == 1) return part;
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
