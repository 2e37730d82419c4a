#include "history/tagged_to_history.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "assemble/has_lists.hpp"
#include "history/recall_history.hpp"
#include "level/known_marker.hpp"

namespace octetra::distributed {
namespace {

using NumbersOfVertices = IndexVector<VertexIndex, GlobalVertex>;

struct MovedRoot {
    std::uint64_t number = 0;
    std::uint32_t descendants = 0;
    Marker marker = 0;
};

/// A vertex of a root's descendant. A process without a tagged entity at the vertex may not know
/// its marker, so the marker is sent as well.
struct MovedVertex {
    GlobalVertex number{};
    MidpointMarker known;
};

/// Adopts the received marker of a midpoint if it has priority over the known one.
void adopt_marker(DistributedMesh& mesh, VertexIndex v, const MidpointMarker& received) {
    const std::size_t input_count = mesh.input_vertices.size();
    if (v.value() < input_count) return;
    MidpointMarker& known = mesh.midpoint_markers[v.value() - input_count];
    if (has_priority_over(received, known)) known = received;
}

/// Moves the entities of one list of tagged facets or edges.
template <class I, std::size_t N>
class TaggedMove {
public:
    using List = IndexVector<I, std::array<VertexIndex, N>>;
    using Vertices = std::vector<std::vector<MovedVertex>>;

    TaggedMove(DistributedMesh& mesh, const NumbersOfVertices& numbers, List& list,
               AncestorMap& ancestors, bool has_markers)
        : mesh_(&mesh),
          numbers_(&numbers),
          list_(&list),
          ancestors_(&ancestors),
          has_markers_(has_markers),
          has_vertex_markers_(!mesh.input_vertex_markers.empty() ||
                              !mesh.midpoint_markers.empty()) {}

    /// Collective, within a transaction.
    void move(const std::vector<int>& rank_of_root) {
        const Communicator& processes = mesh_->processes;
        const auto stays = [&](int rank) { return rank == processes.rank(); };
        if (processes.max(std::ranges::all_of(rank_of_root, stays) ? 0 : 1) == 0) return;
        std::vector<std::vector<MovedRoot>> roots(static_cast<std::size_t>(processes.size()));
        std::vector<std::vector<MovedVertex>> vertices(roots.size());
        for (std::size_t r = 0; r < rank_of_root.size(); ++r) {
            if (stays(rank_of_root[r])) continue;
            const auto to = static_cast<std::size_t>(rank_of_root[r]);
            put(r, roots[to], vertices[to]);
        }
        const auto received_roots = processes.all_to_all(roots);
        Vertices received_vertices = processes.all_to_all(vertices);
        merge(rank_of_root, in_order(received_roots, std::move(received_vertices)));
    }

private:
    struct Arrival {
        MovedRoot root;
        const MovedVertex* vertices = nullptr;
    };
    void put(std::size_t r, std::vector<MovedRoot>& roots,
             std::vector<MovedVertex>& vertices) const {
        const std::uint32_t begin = ancestors_->first[r];
        const std::uint32_t end = ancestors_->first[r + 1];
        roots.push_back(
            {ancestors_->roots[r], end - begin, has_markers_ ? ancestors_->markers[r] : Marker{0}});
        for (I i{begin}; i < I{end}; ++i) {
            for (const VertexIndex v : (*list_)[i]) {
                vertices.push_back({(*numbers_)[v], has_vertex_markers_ ? known_marker(*mesh_, v)
                                                                        : MidpointMarker{}});
            }
        }
    }

    /// Returns the received roots, sorted by global number.
    [[nodiscard]] std::vector<Arrival> in_order(
        const std::vector<std::vector<MovedRoot>>& received_roots, Vertices received_vertices) {
        received_vertices_ = std::move(received_vertices);
        std::vector<Arrival> arrivals;
        for (std::size_t rank = 0; rank < received_roots.size(); ++rank) {
            const MovedVertex* next = received_vertices_[rank].data();
            for (const MovedRoot& root : received_roots[rank]) {
                arrivals.push_back({root, next});
                next += std::size_t{root.descendants} * N;
            }
        }
        std::ranges::sort(arrivals, {}, [](const Arrival& a) { return a.root.number; });
        return arrivals;
    }

    void merge(const std::vector<int>& rank_of_root, const std::vector<Arrival>& arrivals) {
        List list;
        AncestorMap ancestors;
        const auto end_root = [&](std::uint64_t number, Marker marker) {
            ancestors.roots.push_back(number);
            ancestors.first.push_back(list.end_index().value());
            if (has_markers_) ancestors.markers.push_back(marker);
        };
        auto next = arrivals.begin();
        const auto take_before = [&](std::uint64_t number) {
            for (; next != arrivals.end() && next->root.number < number; ++next) {
                for (std::uint32_t k = 0; k < next->root.descendants; ++k) {
                    list.push_back(entity_of(next->vertices + std::size_t{k} * N));
                }
                end_root(next->root.number, next->root.marker);
            }
        };
        for (std::size_t r = 0; r < rank_of_root.size(); ++r) {
            if (rank_of_root[r] != mesh_->processes.rank()) continue;
            take_before(ancestors_->roots[r]);
            for (I i{ancestors_->first[r]}; i < I{ancestors_->first[r + 1]}; ++i) {
                list.push_back((*list_)[i]);
            }
            end_root(ancestors_->roots[r], has_markers_ ? ancestors_->markers[r] : Marker{0});
        }
        take_before(~std::uint64_t{0});
        *list_ = std::move(list);
        *ancestors_ = std::move(ancestors);
    }

    [[nodiscard]] std::array<VertexIndex, N> entity_of(const MovedVertex* vertices) {
        std::array<VertexIndex, N> entity;
        for (std::size_t k = 0; k < N; ++k) {
            const auto found = std::ranges::lower_bound(*numbers_, vertices[k].number);
            entity[k] = VertexIndex{static_cast<std::size_t>(found - numbers_->begin())};
            if (has_vertex_markers_) adopt_marker(*mesh_, entity[k], vertices[k].known);
        }
        return entity;
    }

    DistributedMesh* mesh_;
    const NumbersOfVertices* numbers_;
    List* list_;
    AncestorMap* ancestors_;
    bool has_markers_;
    bool has_vertex_markers_;
    Vertices received_vertices_;
};

}  // namespace

void move_tagged_to_history(DistributedMesh& mesh, const NumbersOfVertices& numbers,
                            const History& before) {
    const Communicator& processes = mesh.processes;
    const HasLists has(mesh);
    const auto facet_ranks =
        ranks_of_roots(processes, before.facet_ancestors, mesh.facet_ancestors.roots);
    const auto edge_ranks =
        ranks_of_roots(processes, before.edge_ancestors, mesh.edge_ancestors.roots);
    processes.transaction([&] {
        TaggedMove<FacetIndex, 3>(mesh, numbers, mesh.facets, mesh.facet_ancestors,
                                  has.facet_markers)
            .move(facet_ranks);
        TaggedMove<EdgeIndex, 2>(mesh, numbers, mesh.edges, mesh.edge_ancestors, has.edge_markers)
            .move(edge_ranks);
    });
}

}  // namespace octetra::distributed
