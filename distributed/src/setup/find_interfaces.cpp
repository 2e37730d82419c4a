#include "setup/find_interfaces.hpp"

#include <algorithm>
#include <map>

#include "setup/sharers.hpp"

namespace octetra::distributed {
namespace {

/// The processes that share each vertex, ascending, as pieces of one array.
class VertexSharers {
public:
    /// Collective.
    VertexSharers(const DistributedMesh& mesh, std::span<const std::uint8_t> may_be_shared,
                  LocalFailure& failure) {
        std::vector<std::array<std::uint64_t, 1>> keys;
        std::vector<std::uint32_t> vertex_of;
        failure.attempt([&] {
            for (std::uint32_t v = 0; v < mesh.input_vertices.size(); ++v) {
                if (!may_be_shared.empty() && may_be_shared[v] == 0) continue;
                keys.push_back({static_cast<std::uint64_t>(mesh.input_vertices[v])});
                vertex_of.push_back(v);
            }
        });
        sharers_ = find_sharers(mesh.processes, keys, failure);
        failure.attempt([&] {
            for (Sharer& s : sharers_) s.key = vertex_of[s.key];  // the order stays
            begin_.assign(mesh.points.size() + 1, 0);
            for (const Sharer& s : sharers_) ++begin_[s.key + 1];
            for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
            find_cells(mesh);
        });
    }

    /// Those with two vertices or more that other processes have, ascending.
    [[nodiscard]] std::span<const CellVertices> cells() const { return cells_; }

    /// Is there another process that has all of these vertices?
    template <std::size_t N>
    [[nodiscard]] bool may_be_shared(const std::array<VertexIndex, N>& vertices) const {
        return std::ranges::any_of(of(vertices.front()), [&](const Sharer& first) {
            return std::ranges::all_of(vertices, [&](VertexIndex v) {
                return std::ranges::binary_search(of(v), first.rank, {}, &Sharer::rank);
            });
        });
    }

private:
    [[nodiscard]] std::span<const Sharer> of(VertexIndex v) const {
        return std::span(sharers_).subspan(begin_[v.value()],
                                           begin_[v.value() + 1U] - begin_[v.value()]);
    }
    void find_cells(const DistributedMesh& mesh) {
        IndexVector<VertexIndex, std::uint8_t> is_shared;  // small enough for a cache
        is_shared.resize(mesh.points.size());
        for (const Sharer& s : sharers_) is_shared[VertexIndex{s.key}] = 1;
        for (const CellVertices& cell : mesh.cells) {
            const auto& [a, b, c, d] = cell;
            if (is_shared[a] + is_shared[b] + is_shared[c] + is_shared[d] < 2) continue;
            cells_.push_back(cell);
        }
    }

    std::vector<Sharer> sharers_;
    std::vector<std::size_t> begin_;
    std::vector<CellVertices> cells_;
};

template <std::size_t N>
using VertexLists = std::vector<std::array<VertexIndex, N>>;

/// The sides (edges or faces) of the cells, each as often as cells have it, that another process
/// may have, too; their vertices ascending.
template <std::size_t N, std::size_t Sides>
VertexLists<N> candidates(const VertexSharers& sharers,
                          const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    VertexLists<N> found;
    for (const CellVertices& cell : sharers.cells()) {
        for (const auto& side : sides) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
            if (!sharers.may_be_shared(vertices)) continue;
            std::ranges::sort(vertices);
            found.push_back(vertices);
        }
    }
    return found;
}

/// Collective. Calls share(rank, vertices) for each of the sides that other processes really have,
/// in ascending order of the vertices, which is the order of their global numbers.
template <std::size_t N, std::size_t Sides>
void find_shared(const DistributedMesh& mesh, const VertexSharers& sharers,
                 const std::array<std::array<std::uint8_t, N>, Sides>& sides, LocalFailure& failure,
                 auto&& share) {
    VertexLists<N> found;
    std::vector<std::array<std::uint64_t, N>> keys;
    failure.attempt([&] {
        found = candidates(sharers, sides);
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        for (const auto& vertices : found) {
            auto& key = keys.emplace_back();
            std::ranges::transform(vertices, key.begin(), [&](VertexIndex v) {
                return static_cast<std::uint64_t>(mesh.input_vertices[v.value()]);
            });
        }
    });
    const auto shared = find_sharers(mesh.processes, keys, failure);
    failure.attempt([&] {
        for (const Sharer& s : shared) share(s.rank, found[s.key]);
    });
}

}  // namespace

std::vector<Interface> find_interfaces(const DistributedMesh& mesh,
                                       std::span<const std::uint8_t> may_be_shared) {
    if (mesh.processes.size() == 1) return {};
    LocalFailure failure;
    const VertexSharers sharers(mesh, may_be_shared, failure);
    std::map<int, Interface> by_rank;
    find_shared(mesh, sharers, cell_edges, failure,
                [&](int rank, const EdgeVertices& edge) { by_rank[rank].edges.push_back(edge); });
    find_shared(mesh, sharers, cell_faces, failure,
                [&](int rank, const FacetVertices& face) { by_rank[rank].faces.push_back(face); });
    std::vector<Interface> interfaces;
    failure.attempt([&] {
        for (auto& [rank, interface] : by_rank) {
            interface.rank = rank;
            interfaces.push_back(std::move(interface));
        }
    });
    failure.agree(mesh.processes);
    return interfaces;
}

}  // namespace octetra::distributed
