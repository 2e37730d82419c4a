#include "numbering/vertex_markers.hpp"

#include "level/known_marker.hpp"

namespace octetra::distributed {
namespace {

/// The marker of a vertex as derived from the entities of one process.
struct Known {
    std::uint64_t number;
    MidpointMarker marker;
};

/// Merges the markers of a block of vertex numbers and returns the replies to all senders.
std::vector<std::vector<Marker>> replies_to(const std::vector<std::vector<Known>>& inboxes,
                                            std::uint64_t first, std::uint64_t block) {
    std::vector<MidpointMarker> merged(block);
    std::vector<bool> met(block, false);
    for (const auto& inbox : inboxes) {
        for (const auto& [number, marker] : inbox) {
            const std::uint64_t i = number - first;
            if (!met[i] || has_priority_over(marker, merged[i])) merged[i] = marker;
            met[i] = true;
        }
    }
    std::vector<std::vector<Marker>> replies(inboxes.size());
    for (std::size_t r = 0; r < inboxes.size(); ++r) {
        replies[r].reserve(inboxes[r].size());
        for (const Known& known : inboxes[r]) {
            replies[r].push_back(merged[known.number - first].marker);
        }
    }
    return replies;
}

}  // namespace

/// The markers of a vertex are merged at a rendezvous process determined by its number.
std::vector<Marker> vertex_markers(const DistributedMesh& mesh, const CanonicalNumbers& numbers) {
    const Communicator& processes = mesh.processes;
    return processes.transaction([&]() -> std::vector<Marker> {
        // A process without vertices has no markers, so the presence of markers is reduced over
        // all.
        const bool has_markers =
            !mesh.input_vertex_markers.empty() || !mesh.midpoint_markers.empty();
        if (processes.max(has_markers ? 1 : 0) == 0) return {};
        const auto process_count = static_cast<std::size_t>(processes.size());
        const std::uint64_t block = numbers.vertex_count / process_count + 1;
        std::vector<std::vector<Known>> known(process_count);
        for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
            const auto number = static_cast<std::uint64_t>(numbers.of_vertex[v]);
            known[number / block].push_back({number, known_marker(mesh, v)});
        }
        const auto replies =
            replies_to(processes.all_to_all(known),
                       block * static_cast<std::uint64_t>(processes.rank()), block);
        // Vertices are in canonical order, so the concatenated answers are in their order.
        std::vector<Marker> markers;
        for (const auto& answers : processes.all_to_all(replies)) {
            markers.insert(markers.end(), answers.begin(), answers.end());
        }
        return markers;
    });
}

}  // namespace octetra::distributed
