#include "nodes.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/distributed/index_map.hpp>

namespace octetra::dolfinx {
namespace {

namespace od = distributed;

/// A cell as sent to the ranks that have it as a ghost.
struct SentCell {
    std::int64_t cell = 0;
    std::array<std::int64_t, 4> nodes{};  ///< global numbers
    std::array<std::int32_t, 4> owners{};
};

void check_counts(const od::AdaptiveMesh& mesh, const od::GhostLayer* ghosts) {
    const std::size_t ghost_cells = ghosts == nullptr ? 0 : ghosts->cells.size();
    const std::size_t corners = 4 * (mesh.cells().size() + ghost_cells);
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (corners > most || mesh.points().size() > most / 2) {
        throw InputError("a rank has more cells than DOLFINx can number, 536,870,911");
    }
}

/// Numbers the vertices owned by this rank first, then the others, with the numbers assigned by
/// their owners.
void number_vertices(const od::AdaptiveMesh& mesh, od::IndexMap<VertexIndex> map, Nodes& nodes) {
    Numbering& numbering = nodes.numbering;
    for (const auto& with : mesh.vertex_sharing().neighbours()) {
        if (!with.received.empty()) numbering.sources.push_back(with.rank);
        if (!with.owned.empty()) numbering.destinations.push_back(with.rank);
    }
    numbering.own_count = static_cast<std::int32_t>(map.owned_count);
    numbering.first = static_cast<std::int64_t>(
        map.rank_begin[static_cast<std::size_t>(mesh.processes().rank())]);
    nodes.vertices = std::move(map.entities);
    nodes.of_vertex.resize(nodes.vertices.size());
    for (std::size_t node = 0; node < nodes.vertices.size(); ++node) {
        const std::size_t vertex = nodes.vertices[node].value();
        nodes.of_vertex[vertex] = static_cast<std::int32_t>(node);
        if (node >= map.owned_count) {
            numbering.ghosts.push_back(static_cast<std::int64_t>(map.numbers[vertex]));
        }
    }
    numbering.owners = std::move(map.copy_owners);
}

SentCell sent_cell(const od::AdaptiveMesh& mesh, const Nodes& nodes, CellIndex cell) {
    SentCell sent;
    sent.cell = nodes.cell_numbering.first + static_cast<std::int64_t>(cell.value());
    for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t node = nodes.of_vertex[mesh.cells()[cell.value()][k].value()];
        const bool is_own = node < nodes.numbering.own_count;
        const auto ghost = static_cast<std::size_t>(node - nodes.numbering.own_count);
        sent.nodes[k] = is_own ? nodes.numbering.first + node : nodes.numbering.ghosts[ghost];
        sent.owners[k] = is_own ? mesh.processes().rank() : nodes.numbering.owners[ghost];
    }
    return sent;
}

/// Adds the ghost cells received from other ranks, in order, to the numberings.
void take_cells(const od::AdaptiveMesh& mesh, const od::GhostLayer& ghosts,
                const std::vector<std::vector<SentCell>>& inboxes, Nodes& nodes) {
    const std::size_t vertex_count = mesh.points().size();
    Numbering& numbering = nodes.numbering;
    const std::size_t known = numbering.ghosts.size();
    numbering.ghosts.resize(known + ghosts.points.size());
    numbering.owners.resize(known + ghosts.points.size());
    nodes.vertices.resize(vertex_count + ghosts.points.size(), VertexIndex::none());
    nodes.ghost_cells.reserve(4 * ghosts.cells.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < inboxes.size(); ++i) {
        for (const SentCell& received_cell : inboxes[i]) {
            nodes.cell_numbering.ghosts.push_back(received_cell.cell);
            nodes.cell_numbering.owners.push_back(ghosts.exchanges[i].rank);
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t vertex = ghosts.cells[at][k].value();
                if (vertex < vertex_count) {
                    nodes.ghost_cells.push_back(nodes.of_vertex[vertex]);
                    continue;
                }
                nodes.ghost_cells.push_back(static_cast<std::int32_t>(vertex));
                numbering.ghosts[known + vertex - vertex_count] = received_cell.nodes[k];
                numbering.owners[known + vertex - vertex_count] = received_cell.owners[k];
            }
            ++at;
        }
    }
}

/// Collective. Numbers ghost cells and the vertices that belong only to them.
void number_ghost_cells(const od::AdaptiveMesh& mesh, const od::GhostLayer& ghosts, Nodes& nodes) {
    std::vector<int> ranks;
    std::vector<std::vector<SentCell>> outboxes;
    mesh.processes().transaction([&] {
        for (const auto& exchange : ghosts.exchanges) {
            ranks.push_back(exchange.rank);
            auto& outbox = outboxes.emplace_back();
            outbox.reserve(exchange.sent.size());
            for (const CellIndex c : exchange.sent) outbox.push_back(sent_cell(mesh, nodes, c));
            if (exchange.received > 0) nodes.cell_numbering.sources.push_back(exchange.rank);
            if (!exchange.sent.empty()) {
                nodes.cell_numbering.destinations.push_back(exchange.rank);
            }
        }
    });
    const auto inboxes = mesh.processes().exchange_with(ranks, outboxes);
    mesh.processes().transaction([&] { take_cells(mesh, ghosts, inboxes, nodes); });
    nodes.numbering.knows_destinations = false;
}

}  // namespace

Nodes number_nodes(const od::AdaptiveMesh& mesh, const od::GhostLayer* ghosts) {
    Nodes nodes;
    mesh.processes().transaction([&] {
        check_counts(mesh, ghosts);
        nodes.cell_numbering.own_count = static_cast<std::int32_t>(mesh.cells().size());
    });
    od::IndexMap<VertexIndex> map =
        od::make_index_map(mesh.processes(), mesh.vertex_sharing(), mesh.points().size());
    mesh.processes().transaction([&] { number_vertices(mesh, std::move(map), nodes); });
    nodes.cell_numbering.first =
        static_cast<std::int64_t>(mesh.processes().sum_before(mesh.cells().size()));
    if (ghosts != nullptr) number_ghost_cells(mesh, *ghosts, nodes);
    return nodes;
}

}  // namespace octetra::dolfinx
