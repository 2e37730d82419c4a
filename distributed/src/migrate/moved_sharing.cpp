#include "migrate/moved_sharing.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

using Destinations = std::vector<VertexDestination>;

void sort_and_unite(Destinations& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Groups the destinations by the neighbour that owned the vertex before; those of this process's
/// own vertices are appended to `own`. Vertices and their numbers ascend alike.
std::vector<Destinations> by_owner(const Sharing<VertexIndex>& sharing,
                                   const std::vector<GlobalVertex>& vertices,
                                   const Destinations& destinations, std::span<const int> ranks,
                                   Destinations& own) {
    std::vector<Destinations> to_owners(ranks.size());
    std::size_t v = 0;
    for (const VertexDestination& one : destinations) {
        while (vertices[v] != one.vertex) ++v;
        const int owner = sharing.owner(VertexIndex{v});
        if (owner == sharing.rank()) {
            own.push_back(one);
        } else {
            const auto at = std::ranges::lower_bound(ranks, owner) - ranks.begin();
            to_owners[static_cast<std::size_t>(at)].push_back(one);
        }
    }
    return to_owners;
}

/// Returns for each process that receives a vertex the other processes that do.
std::vector<Destinations> to_holders(const Destinations& all, std::size_t process_count) {
    std::vector<Destinations> sent(process_count);
    for (auto begin = all.begin(); begin != all.end();) {
        const auto end = std::find_if(begin, all.end(),
                                      [&](const auto& one) { return one.vertex != begin->vertex; });
        for (auto holder = begin; holder != end; ++holder) {
            for (auto other = begin; other != end; ++other) {
                if (other != holder) sent[static_cast<std::size_t>(holder->rank)].push_back(*other);
            }
        }
        begin = end;
    }
    return sent;
}

void share(const DistributedMesh& after, Destinations others,
           SharingBuilder<VertexIndex>& builder) {
    std::ranges::sort(others);
    std::map<int, std::vector<VertexIndex>> by_rank;
    auto v = after.input_vertices.begin();
    for (const VertexDestination& one : others) {
        v = std::lower_bound(v, after.input_vertices.end(), one.vertex);
        by_rank[one.rank].emplace_back(static_cast<std::size_t>(v - after.input_vertices.begin()));
    }
    for (auto& [rank, vertices] : by_rank) builder.share(rank, std::move(vertices));
    builder.prepare([&](VertexIndex of) {
        return static_cast<std::uint64_t>(after.input_vertices[of.value()]);
    });
}

}  // namespace

Destinations vertex_destinations(const Departures& departures,
                                 const Sharing<VertexIndex>& sharing) {
    const DistributedMesh& input = departures.input;
    std::vector<bool> is_sent(input.points.size(), false);
    for (const VertexIndex v : sharing.shared()) {
        if (v < input.points.end_index()) is_sent[v.value()] = true;
    }
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
        if (departures.rank_of_root[c.value()] == sharing.rank()) continue;
        for (const VertexIndex v : input.cells[c]) is_sent[v.value()] = true;
    }
    Destinations destinations;
    std::vector<int> last_rank(input.points.size(), -1);  // most duplicates are consecutive
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
        const int rank = departures.rank_of_root[c.value()];
        for (const VertexIndex v : input.cells[c]) {
            if (!is_sent[v.value()] || std::exchange(last_rank[v.value()], rank) == rank) continue;
            destinations.push_back({input.input_vertices[v.value()], rank});
        }
    }
    sort_and_unite(destinations);
    return destinations;
}

Sharing<VertexIndex> moved_sharing(const DistributedMesh& after, const Sharing<VertexIndex>& before,
                                   const std::vector<GlobalVertex>& vertices_before,
                                   const Destinations& destinations) {
    const Communicator& processes = after.processes;
    std::vector<int> ranks;
    for (const auto& with : before.neighbours()) ranks.push_back(with.rank);
    Destinations all;
    const auto to_owners = by_owner(before, vertices_before, destinations, ranks, all);
    for (const Destinations& from_one : processes.exchange_with(ranks, to_owners)) {
        all.insert(all.end(), from_one.begin(), from_one.end());
    }
    sort_and_unite(all);
    Destinations others;
    const auto sent = to_holders(all, static_cast<std::size_t>(processes.size()));
    for (const Destinations& from_one : processes.all_to_all(sent)) {
        others.insert(others.end(), from_one.begin(), from_one.end());
    }
    Sharing<VertexIndex> sharing;
    SharingBuilder<VertexIndex> builder(sharing, processes.rank());
    share(after, std::move(others), builder);
    builder.commit();
    return sharing;
}

}  // namespace octetra::distributed
