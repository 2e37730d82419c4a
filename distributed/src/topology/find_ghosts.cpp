#include "topology/find_ghosts.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/vertex_buckets.hpp>

#include "comm/value_kinds.hpp"

namespace octetra::distributed {
namespace {

/// A cell as a message to a neighbour.
struct SentCell {
    std::array<std::uint64_t, 4> vertices{};
    std::array<Point, 4> points{};
    CellIndex cell;
    Marker region = 0;
};

/// Appends a cell once, even if it shares several entities with a neighbour.
void add_once(std::vector<CellIndex>& sent, CellIndex c) {
    if (sent.empty() || sent.back() != c) sent.push_back(c);
}

/// Returns the cells that are ghosts on each neighbour, ascending.
std::vector<GhostLayer::Exchange> ghosts_by_vertex(const DistributedMesh& mesh,
                                                   const Sharing<VertexIndex>& sharing) {
    const std::vector<SharedWith<VertexIndex>>& neighbours = sharing.neighbours();
    // The neighbours that have vertex v are at[begin[v]] .. at[begin[v + 1] - 1].
    std::vector<std::uint32_t> begin(mesh.points.size() + 1);
    for (const auto& with : neighbours) {
        for (const VertexIndex v : with.entities) ++begin[v.value()];
    }
    std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> at(begin.back());
    std::vector<GhostLayer::Exchange> exchanges;
    for (std::uint32_t n = 0; n < neighbours.size(); ++n) {
        for (const VertexIndex v : neighbours[n].entities) at[--begin[v.value()]] = n;
        exchanges.push_back({.rank = neighbours[n].rank, .sent = {}});
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const VertexIndex v : mesh.cells[c]) {
            for (std::uint32_t k = begin[v.value()]; k < begin[v.value() + 1]; ++k) {
                add_once(exchanges[at[k]].sent, c);
            }
        }
    }
    return exchanges;
}

/// The same for cells with a common face. Searches only for the shared faces of the part.
std::vector<GhostLayer::Exchange> ghosts_by_face(const DistributedMesh& mesh) {
    std::vector<GhostLayer::Exchange> exchanges;
    IndexVector<FacetIndex, FacetVertices> faces;
    std::vector<std::size_t> exchange_of_face;
    for (const Interface& interface : mesh.interfaces) {
        for (const FacetVertices& face : interface.faces) {
            faces.push_back(face);
            exchange_of_face.push_back(exchanges.size());
        }
        exchanges.push_back({.rank = interface.rank, .sent = {}});
    }
    const VertexBuckets<FacetIndex, 3> shared(faces, mesh.points.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const CellVertices& cell = mesh.cells[c];
        for (const auto& [i, j, k] : cell_faces) {
            shared.find({cell[i], cell[j], cell[k]}, [&](FacetIndex face) {
                add_once(exchanges[exchange_of_face[face.value()]].sent, c);
            });
        }
    }
    return exchanges;
}

/// Adds received cells to the layer; vertices that are new to this process are numbered after its
/// own.
void take(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
          const std::vector<std::vector<SentCell>>& inboxes, bool with_regions, GhostLayer& layer) {
    const auto own = [&](std::uint64_t number) {
        const auto found = std::ranges::lower_bound(numbers.of_vertex, GlobalVertex{number});
        const bool is_own = found != numbers.of_vertex.end() && *found == GlobalVertex{number};
        return is_own ? VertexIndex{static_cast<std::size_t>(found - numbers.of_vertex.begin())}
                      : VertexIndex::none();
    };
    std::vector<std::pair<std::uint64_t, Point>> foreign;
    for (const auto& inbox : inboxes) {
        for (const SentCell& sent : inbox) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (own(sent.vertices[k]).is_none()) {
                    foreign.emplace_back(sent.vertices[k], sent.points[k]);
                }
            }
        }
    }
    std::ranges::sort(foreign, {}, [](const auto& entry) { return entry.first; });
    for (const auto& [number, point] : foreign) {
        if (!layer.vertex_numbers.empty() && layer.vertex_numbers.back() == GlobalVertex{number}) {
            continue;
        }
        layer.vertex_numbers.push_back(GlobalVertex{number});
        layer.points.push_back(point);
    }
    const auto local = [&](std::uint64_t number) {
        const VertexIndex v = own(number);
        if (!v.is_none()) return v;
        const auto found = std::ranges::lower_bound(layer.vertex_numbers, GlobalVertex{number});
        return VertexIndex{mesh.points.size() +
                           static_cast<std::size_t>(found - layer.vertex_numbers.begin())};
    };
    for (std::size_t i = 0; i < inboxes.size(); ++i) {
        layer.exchanges[i].received = inboxes[i].size();
        for (const SentCell& sent : inboxes[i]) {
            CellVertices cell;
            std::ranges::transform(sent.vertices, cell.begin(), local);
            layer.cells.push_back(cell);
            layer.owners.push_back({layer.exchanges[i].rank, sent.cell});
            if (with_regions) layer.regions.push_back(sent.region);
        }
    }
}

}  // namespace

GhostLayer find_ghosts(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                       const Sharing<VertexIndex>& sharing, const std::vector<Marker>& regions,
                       GhostsBy by) {
    const Communicator& processes = mesh.processes;
    processes.check_same("argument by", by == GhostsBy::face ? "face" : "vertex");
    const bool with_regions = processes.max(mesh.cell_ancestors.markers.empty() ? 0 : 1) == 1;
    GhostLayer layer;
    layer.own_cell_count = mesh.cells.size();
    layer.exchanges = by == GhostsBy::face ? ghosts_by_face(mesh) : ghosts_by_vertex(mesh, sharing);
    std::vector<int> ranks;
    std::vector<std::vector<SentCell>> outboxes;
    for (const GhostLayer::Exchange& exchange : layer.exchanges) {
        ranks.push_back(exchange.rank);
        auto& outbox = outboxes.emplace_back();
        for (const CellIndex c : exchange.sent) {
            SentCell& sent = outbox.emplace_back();
            sent.cell = c;
            if (!regions.empty()) sent.region = regions[c.value()];
            for (std::size_t k = 0; k < 4; ++k) {
                const VertexIndex v = mesh.cells[c][k];
                sent.vertices[k] = static_cast<std::uint64_t>(numbers.of_vertex[v]);
                sent.points[k] = mesh.points[v];
            }
        }
    }
    take(mesh, numbers, processes.exchange_with(ranks, outboxes), with_regions, layer);
    return layer;
}

void GhostLayer::exchange(const Communicator& processes, std::span<const std::byte> own,
                          const detail::ValueKind& kind,
                          const std::function<std::byte*()>& allocate) const {
    const std::size_t entry_size = kind.entry_size();
    processes.transaction([&] {
        if (own.size() != own_cell_count * entry_size) {
            throw InputError(fmt::format("rank {}: {} values for cells, and {} are needed",
                                         processes.rank(), own.size() / kind.size,
                                         own_cell_count * kind.components));
        }
        std::byte* ghosts = allocate();
        std::vector<int> ranks;
        std::vector<std::vector<std::byte>> outboxes;
        for (const Exchange& with : exchanges) {
            ranks.push_back(with.rank);
            auto& outbox = outboxes.emplace_back(with.sent.size() * entry_size);
            for (std::size_t k = 0; k < with.sent.size(); ++k) {
                std::memcpy(outbox.data() + k * entry_size,
                            own.data() + with.sent[k].value() * entry_size, entry_size);
            }
        }
        agree_on_kind(processes, kind);
        const auto inboxes = processes.exchange_with(ranks, outboxes);
        agree_on_sizes(processes, ranks, inboxes,
                       [&](std::size_t n) { return exchanges[n].received * entry_size; });
        for (const auto& inbox : inboxes) {
            if (!inbox.empty()) std::memcpy(ghosts, inbox.data(), inbox.size());
            ghosts += inbox.size();
        }
    });
}

}  // namespace octetra::distributed
