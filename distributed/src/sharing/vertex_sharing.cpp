#include "sharing/vertex_sharing.hpp"

#include <map>
#include <optional>

#include "setup/sharers.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {

Sharing<VertexIndex> find_vertex_sharing(const DistributedMesh& mesh) {
    LocalFailure failure;
    std::optional<Sharing<VertexIndex>> sharing;  // made, even of nothing, it takes memory
    std::optional<SharingBuilder<VertexIndex>> builder;
    std::vector<std::array<std::uint64_t, 1>> keys;
    failure.attempt([&] {
        builder.emplace(sharing.emplace(), mesh.processes.rank());
        if (mesh.processes.size() == 1) return;
        for (const GlobalVertex v : mesh.input_vertices) {
            keys.push_back({static_cast<std::uint64_t>(v)});
        }
    });
    failure.agree(mesh.processes);
    if (mesh.processes.size() == 1) return *std::move(sharing);
    const auto sharers = find_sharers(mesh.processes, keys, failure);
    failure.attempt([&] {
        // By key, so the vertices of each process ascend, here as there.
        std::map<int, std::vector<VertexIndex>> by_rank;
        for (const Sharer& s : sharers) by_rank[s.rank].push_back(VertexIndex{s.key});
        for (auto& [rank, vertices] : by_rank) builder->share(rank, std::move(vertices));
        builder->prepare([&](VertexIndex v) {
            return static_cast<std::uint64_t>(mesh.input_vertices[v.value()]);
        });
    });
    failure.agree(mesh.processes);
    builder->commit();
    return *std::move(sharing);
}

}  // namespace octetra::distributed
