#include "sharing/vertex_sharing.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sharing/sharers.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {

Sharing<VertexIndex> find_vertex_sharing(const DistributedMesh& mesh,
                                         std::span<const std::uint8_t> may_be_shared) {
    return mesh.processes.transaction([&] {
        Sharing<VertexIndex> sharing;
        SharingBuilder<VertexIndex> builder(sharing, mesh.processes.rank());
        if (mesh.processes.size() == 1) return sharing;
        std::vector<std::array<std::uint64_t, 1>> keys;
        std::vector<VertexIndex> vertex_of;
        for (std::size_t v = 0; v < mesh.input_vertices.size(); ++v) {
            if (!may_be_shared.empty() && may_be_shared[v] == 0) continue;
            keys.push_back({static_cast<std::uint64_t>(mesh.input_vertices[v])});
            vertex_of.emplace_back(v);
        }
        // Ordered by key, so both sides list the vertices of a pair of ranks in the same order.
        std::map<int, std::vector<VertexIndex>> by_rank;
        for (const Sharer& s : find_sharers(mesh.processes, keys)) {
            by_rank[s.rank].push_back(vertex_of[s.key]);
        }
        for (auto& [rank, vertices] : by_rank) builder.share(rank, std::move(vertices));
        builder.prepare([&](VertexIndex v) {
            return static_cast<std::uint64_t>(mesh.input_vertices[v.value()]);
        });
        builder.commit();
        return sharing;
    });
}

}  // namespace octetra::distributed
