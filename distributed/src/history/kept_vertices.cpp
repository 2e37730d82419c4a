#include "history/kept_vertices.hpp"

#include <algorithm>

namespace octetra::distributed {
namespace {

/// The vertices of an interface's edges, each once. Midpoints are shared along edges only.
std::vector<VertexIndex> vertices_of(const Interface& interface, std::vector<bool>& met) {
    std::vector<VertexIndex> vertices;
    for (const EdgeVertices& edge : interface.edges) {
        for (const VertexIndex v : edge) {
            if (!met[v.value()]) vertices.push_back(v);
            met[v.value()] = true;
        }
    }
    for (const VertexIndex v : vertices) met[v.value()] = false;
    return vertices;
}

}  // namespace

KeptVertices::KeptVertices(const DistributedMesh& mesh) : kept_(mesh.points.size(), 0) {
    std::fill_n(kept_.begin(), mesh.input_vertices.size(), std::uint8_t{1});
    std::vector<bool> met(mesh.points.size(), false);
    for (const Interface& interface : mesh.interfaces) {
        Shared& shared = shared_.emplace_back();
        shared.vertices = vertices_of(interface, met);
        shared.told.assign(shared.vertices.size(), 0);
    }
}

EdgeMask KeptVertices::kept_edges(const CollapsedCell& cell) const {
    unsigned edges = 0;
    for (std::size_t e = 0; e < 6; ++e) {
        const VertexIndex midpoint = cell.midpoints[e];
        if (!midpoint.is_none() && has(midpoint)) edges |= 1U << e;
    }
    return static_cast<EdgeMask>(edges);
}

void KeptVertices::close(const std::vector<CollapsedCell>& cut) {
    const PatternTable& table = PatternTable::get();
    bool changed = true;
    for (bool backwards = false; changed; backwards = !backwards) {
        changed = false;
        for (std::size_t k = 0; k < cut.size(); ++k) {
            const CollapsedCell& cell = cut[backwards ? cut.size() - 1 - k : k];
            const EdgeMask edges = kept_edges(cell);
            const auto missing =
                static_cast<EdgeMask>(table.closure(cell.order, edges) & ~unsigned{edges});
            for (std::size_t e = 0; missing >> e != 0; ++e) {
                if ((unsigned{missing} >> e & 1U) == 0) continue;
                kept_[cell.midpoints[e]] = 1;
                changed = true;
            }
        }
    }
}

std::vector<std::vector<std::uint32_t>> KeptVertices::take_outboxes() {
    std::vector<std::vector<std::uint32_t>> outboxes(shared_.size());
    for (std::size_t i = 0; i < shared_.size(); ++i) {
        auto& [vertices, told] = shared_[i];
        for (std::size_t k = 0; k < vertices.size(); ++k) {
            if (told[k] != 0 || !has(vertices[k])) continue;
            outboxes[i].push_back(static_cast<std::uint32_t>(k));
            told[k] = 1;
        }
    }
    return outboxes;
}

void KeptVertices::keep_from(std::size_t interface, std::uint32_t position) {
    kept_[shared_[interface].vertices[position]] = 1;
    shared_[interface].told[position] = 1;
}

bool close_together(KeptVertices* kept, const std::vector<CollapsedCell>& cut,
                    const DistributedMesh& mesh, LocalFailure& failure) {
    std::vector<int> ranks;
    failure.attempt([&] {
        for (const Interface& interface : mesh.interfaces) ranks.push_back(interface.rank);
    });
    while (true) {
        std::vector<std::vector<std::uint32_t>> outboxes;
        std::uint64_t count = 0;
        failure.attempt([&] {
            kept->close(cut);
            outboxes = kept->take_outboxes();
            for (const auto& outbox : outboxes) count += outbox.size();
        });
        const std::uint64_t most = failure.max_unless_failed(mesh.processes, count);
        if (most == LocalFailure::somewhere) return false;
        if (most == 0) return true;
        failure.attempt([&] {
            const auto inboxes = mesh.processes.exchange_with<std::uint32_t>(ranks, outboxes);
            for (std::size_t i = 0; i < inboxes.size(); ++i) {
                for (const std::uint32_t position : inboxes[i]) kept->keep_from(i, position);
            }
        });
    }
}

}  // namespace octetra::distributed
