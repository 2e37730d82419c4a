#include "setup/find_interfaces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace octetra::distributed {
namespace {

/// The processes that share each vertex, ascending, as ranges of one array.
class VertexSharers {
public:
    VertexSharers(const DistributedMesh& mesh, const Sharing<VertexIndex>& sharing)
        : begin_(mesh.points.size() + 1, 0) {
        for (const VertexIndex v : sharing.shared()) {
            begin_[v.value() + 1U] = static_cast<std::uint32_t>(sharing.sharers(v).size());
        }
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        ranks_.reserve(begin_.back());
        for (const VertexIndex v : sharing.shared()) {
            const auto sharers = sharing.sharers(v);
            ranks_.insert(ranks_.end(), sharers.begin(), sharers.end());
        }
    }

    [[nodiscard]] bool is_shared(VertexIndex v) const { return !of(v).empty(); }
    /// Calls meet(rank) for each process that has all of these vertices.
    template <std::size_t N>
    void for_each_with_all(const std::array<VertexIndex, N>& vertices, auto&& meet) const {
        for (const int rank : of(vertices.front())) {
            const auto has = [&](VertexIndex v) { return std::ranges::binary_search(of(v), rank); };
            if (std::ranges::all_of(vertices, has)) meet(rank);
        }
    }

private:
    [[nodiscard]] std::span<const int> of(VertexIndex v) const {
        return std::span(ranks_).subspan(begin_[v.value()],
                                         begin_[v.value() + 1U] - begin_[v.value()]);
    }

    std::vector<std::uint32_t> begin_;
    std::vector<int> ranks_;
};

/// Returns the cells with two or more shared vertices.
std::vector<CellVertices> cells_at_border(const DistributedMesh& mesh,
                                          const VertexSharers& sharers) {
    IndexVector<VertexIndex, std::uint8_t> is_shared;  // small enough to stay in the cache
    is_shared.resize(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        is_shared[v] = sharers.is_shared(v) ? 1 : 0;
    }
    std::vector<CellVertices> cells;
    for (const CellVertices& cell : mesh.cells) {
        const auto& [a, b, c, d] = cell;
        if (is_shared[a] + is_shared[b] + is_shared[c] + is_shared[d] >= 2) cells.push_back(cell);
    }
    return cells;
}

template <std::size_t N>
using VertexLists = std::vector<std::array<VertexIndex, N>>;

/// The edges and faces of this process all of whose vertices another process has, so that it may
/// have them, too. Lists and their entries are in ascending order of vertices.
struct Candidates {
    const std::vector<VertexIndex>* shared = nullptr;  ///< all vertices that both processes have
    VertexLists<2> edges;
    VertexLists<3> faces;
};

class CandidatesOfAll {
public:
    CandidatesOfAll(const DistributedMesh& mesh, const Sharing<VertexIndex>& sharing) {
        for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
            if (with.entities.size() < 2) continue;  // the count is the same on the other process
            ranks.push_back(with.rank);
            of_rank.push_back({&with.entities, {}, {}});
        }
        const VertexSharers sharers(mesh, sharing);
        const std::vector<CellVertices> cells = cells_at_border(mesh, sharers);
        find(cells, sharers, cell_edges, &Candidates::edges);
        find(cells, sharers, cell_faces, &Candidates::faces);
    }

    std::vector<int> ranks;
    std::vector<Candidates> of_rank;

private:
    /// Adds the sides (edges or faces) of these cells to a list of the candidates.
    template <std::size_t N, std::size_t Sides>
    void find(const std::vector<CellVertices>& cells, const VertexSharers& sharers,
              const std::array<std::array<std::uint8_t, N>, Sides>& sides,
              VertexLists<N> Candidates::*list) {
        VertexLists<N> found;
        for (const CellVertices& cell : cells) {
            for (const auto& side : sides) {
                std::array<VertexIndex, N> vertices;
                for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
                if (!std::ranges::all_of(vertices,
                                         [&](VertexIndex v) { return sharers.is_shared(v); })) {
                    continue;
                }
                std::ranges::sort(vertices);
                found.push_back(vertices);
            }
        }
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        for (const auto& vertices : found) {
            sharers.for_each_with_all(vertices, [&](int rank) {
                const auto at = std::ranges::lower_bound(ranks, rank) - ranks.begin();
                (of_rank[static_cast<std::size_t>(at)].*list).push_back(vertices);
            });
        }
    }
};

using Indices = std::vector<std::uint32_t>;

/// Maps vertices to their indices in the list of vertices shared with another process, which is the
/// same on both sides and ascending. The array is allocated once for all processes.
class SharedIndices {
public:
    explicit SharedIndices(std::size_t vertex_count) { index_.resize(vertex_count); }

    void set_list(const std::vector<VertexIndex>& shared) {
        for (std::size_t k = 0; k < shared.size(); ++k) {
            index_[shared[k]] = static_cast<std::uint32_t>(k);
        }
    }
    template <std::size_t N>
    [[nodiscard]] std::array<std::uint32_t, N> of(
        const std::array<VertexIndex, N>& vertices) const {
        std::array<std::uint32_t, N> indices;
        for (std::size_t k = 0; k < N; ++k) indices[k] = index_[vertices[k]];
        return indices;
    }

private:
    IndexVector<VertexIndex, std::uint32_t> index_;  ///< valid for the vertices of the last list
};

/// Returns the message: the number of edges, then edges and faces as indices of shared vertices.
Indices message_of(const Candidates& candidates, SharedIndices& among) {
    Indices message{static_cast<std::uint32_t>(candidates.edges.size())};
    message.reserve(1 + 2 * candidates.edges.size() + 3 * candidates.faces.size());
    among.set_list(*candidates.shared);
    const auto append = [&](const auto& list) {
        for (const auto& vertices : list) {
            const auto indices = among.of(vertices);
            message.insert(message.end(), indices.begin(), indices.end());
        }
    };
    append(candidates.edges);
    append(candidates.faces);
    return message;
}

/// Returns the entries of `own` that are also in the received list. Both lists ascend.
template <std::size_t N>
VertexLists<N> common(const VertexLists<N>& own, const SharedIndices& among,
                      std::span<const std::uint32_t> received) {
    VertexLists<N> common;
    for (const auto& vertices : own) {
        const auto indices = among.of(vertices);
        const auto is_before = [&] {
            return std::ranges::lexicographical_compare(received.first(N), indices);
        };
        while (!received.empty() && is_before()) received = received.subspan(N);
        if (received.empty()) break;
        if (std::ranges::equal(received.first(N), indices)) common.push_back(vertices);
    }
    return common;
}

}  // namespace

std::vector<Interface> find_interfaces(const DistributedMesh& mesh,
                                       const Sharing<VertexIndex>& sharing) {
    if (mesh.processes.size() == 1) return {};
    return mesh.processes.transaction([&] {
        CandidatesOfAll candidates(mesh, sharing);
        SharedIndices among(mesh.points.size());
        std::vector<Indices> outboxes;
        for (const Candidates& of_one : candidates.of_rank) {
            outboxes.push_back(message_of(of_one, among));
        }
        const auto inboxes = mesh.processes.exchange_with(candidates.ranks, outboxes);
        std::vector<Interface> interfaces;
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            const Candidates& own = candidates.of_rank[i];
            const std::span<const std::uint32_t> received(inboxes[i]);
            among.set_list(*own.shared);
            const std::size_t edges = std::size_t{2} * received.front();
            Interface interface {
                candidates.ranks[i], common(own.edges, among, received.subspan(1, edges)),
                    common(own.faces, among, received.subspan(1 + edges))
            };
            if (interface.edges.empty() && interface.faces.empty()) continue;
            interfaces.push_back(std::move(interface));
        }
        return interfaces;
    });
}

}  // namespace octetra::distributed
