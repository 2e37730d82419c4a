#include "migrate/departures.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <octetra/core/vertex_buckets.hpp>

#include "history/steps_of.hpp"

namespace octetra::distributed {
namespace {

template <class I, std::size_t N, std::size_t Sides>
std::vector<int> ranks_of_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list,
                                 const DistributedMesh& input, std::span<const int> rank_of_root,
                                 const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::vector<int> ranks(list.size(), -1);
    if (list.empty()) return ranks;
    const VertexBuckets<I, N> buckets(list, input.points.size());
    IndexVector<VertexIndex, std::uint8_t> is_tagged;  // small enough to stay in the cache
    is_tagged.assign(input.points.size(), 0);
    for (const auto& vertices : list) {
        for (const VertexIndex v : vertices) is_tagged[v] = 1;
    }
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
        const auto& [p, q, r, s] = input.cells[c];
        if (is_tagged[p] + is_tagged[q] + is_tagged[r] + is_tagged[s] < static_cast<int>(N)) {
            continue;
        }
        for (const auto& side : sides) {
            std::array<VertexIndex, N> corners;
            for (std::size_t k = 0; k < N; ++k) corners[k] = input.cells[c][side[k]];
            buckets.find(corners, [&](I i) {
                if (ranks[i.value()] < 0) ranks[i.value()] = rank_of_root[c.value()];
            });
        }
    }
    return ranks;
}

/// For each rank, indices in a list of the input.
using IndicesByRank = std::vector<std::vector<std::uint32_t>>;

IndicesByRank by_rank(const std::vector<int>& ranks, std::size_t process_count) {
    IndicesByRank indices(process_count);
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        indices[static_cast<std::size_t>(ranks[i])].push_back(static_cast<std::uint32_t>(i));
    }
    return indices;
}

class MessageMaker {
public:
    explicit MessageMaker(const Departures& departures)
        : input_(&departures.input),
          cuts_(&departures.cuts.bytes),
          cut_begin_(input_->cells.size() + 1, 0),
          index_(input_->points.size()),
          last_message_(input_->points.size(), -1) {
        for (const CutRoots::Root& root : departures.cuts.roots) {
            cut_begin_[root.index + std::size_t{1}] = root.bytes;
        }
        for (std::size_t r = 1; r < cut_begin_.size(); ++r) cut_begin_[r] += cut_begin_[r - 1];
    }

    [[nodiscard]] RootMessage message(int rank, const std::vector<std::uint32_t>& roots,
                                      const std::vector<std::uint32_t>& facets,
                                      const std::vector<std::uint32_t>& edges) {
        RootMessage message;
        put_vertices(rank, roots, message);
        put_roots(roots, message);
        message.facets = tagged(facets, input_->facets, input_->facet_ancestors);
        message.edges = tagged(edges, input_->edges, input_->edge_ancestors);
        return message;
    }

private:
    void put_vertices(int rank, const std::vector<std::uint32_t>& roots, RootMessage& message) {
        std::vector<VertexIndex> vertices;
        for (const std::uint32_t r : roots) {
            for (const VertexIndex v : input_->cells[CellIndex{r}]) {
                if (std::exchange(last_message_[v.value()], rank) != rank) vertices.push_back(v);
            }
        }
        std::ranges::sort(vertices);
        const std::size_t attributes = input_->attributes_per_point;
        for (const VertexIndex v : vertices) {
            index_[v.value()] = static_cast<std::uint32_t>(message.vertices.size());
            message.vertices.push_back(input_->input_vertices[v.value()]);
            message.points.push_back(input_->points[v]);
            if (!input_->input_vertex_markers.empty()) {
                message.point_markers.push_back(input_->input_vertex_markers[v.value()]);
            }
            for (std::size_t k = 0; k < attributes; ++k) {
                message.point_attributes.push_back(
                    input_->point_attributes[v.value() * attributes + k]);
            }
        }
    }

    void put_roots(const std::vector<std::uint32_t>& roots, RootMessage& message) const {
        const AncestorMap& ancestors = input_->cell_ancestors;
        for (const std::uint32_t r : roots) {
            const auto cuts =
                std::span(*cuts_).subspan(cut_begin_[r], cut_begin_[r + 1] - cut_begin_[r]);
            message.cuts.insert(message.cuts.end(), cuts.begin(), cuts.end());
            message.roots.push_back(
                {.number = ancestors.roots[r],
                 .corners = indices_of(input_->cells[CellIndex{r}]),
                 .region = ancestors.markers.empty() ? Marker{0} : ancestors.markers[r],
                 .cut_bytes = static_cast<std::uint32_t>(cuts.size())});
        }
    }

    template <class I, std::size_t N>
    std::vector<RootMessage::Tagged<N>> tagged(
        const std::vector<std::uint32_t>& indices,
        const IndexVector<I, std::array<VertexIndex, N>>& list,
        const AncestorMap& ancestors) const {
        std::vector<RootMessage::Tagged<N>> tagged;
        for (const std::uint32_t i : indices) {
            tagged.push_back(
                {.number = ancestors.roots[i],
                 .vertices = indices_of(list[I{i}]),
                 .marker = ancestors.markers.empty() ? Marker{0} : ancestors.markers[i]});
        }
        return tagged;
    }

    template <std::size_t N>
    [[nodiscard]] std::array<std::uint32_t, N> indices_of(
        const std::array<VertexIndex, N>& vertices) const {
        std::array<std::uint32_t, N> indices;
        for (std::size_t k = 0; k < N; ++k) indices[k] = index_[vertices[k].value()];
        return indices;
    }

    const DistributedMesh* input_;
    const std::vector<std::uint8_t>* cuts_;
    std::vector<std::size_t> cut_begin_;  ///< offset for each root, and the end
    std::vector<std::uint32_t> index_;    ///< index of each vertex in the current message
    std::vector<int> last_message_;       ///< the last message that contains the vertex
};

}  // namespace

Departures departures_of(const DistributedMesh& mesh, std::span<const int> rank_of_root) {
    Departures departures;
    departures.input = input_of(mesh);
    departures.cuts = cut_roots_of(steps_of(mesh), mesh.cell_ancestors.first);
    departures.rank_of_root.assign(rank_of_root.begin(), rank_of_root.end());
    departures.rank_of_facet =
        ranks_of_tagged(departures.input.facets, departures.input, rank_of_root, cell_faces);
    departures.rank_of_edge =
        ranks_of_tagged(departures.input.edges, departures.input, rank_of_root, cell_edges);
    return departures;
}

std::vector<std::vector<std::byte>> packed_messages(const Departures& departures) {
    const Communicator& processes = departures.input.processes;
    const auto process_count = static_cast<std::size_t>(processes.size());
    const IndicesByRank roots = by_rank(departures.rank_of_root, process_count);
    const IndicesByRank facets = by_rank(departures.rank_of_facet, process_count);
    const IndicesByRank edges = by_rank(departures.rank_of_edge, process_count);
    MessageMaker maker(departures);
    std::vector<std::vector<std::byte>> packed(process_count);
    for (int rank = 0; rank < processes.size(); ++rank) {
        const auto r = static_cast<std::size_t>(rank);
        if (rank == processes.rank() || roots[r].empty()) continue;
        packed[r] = maker.message(rank, roots[r], facets[r], edges[r]).packed();
    }
    return packed;
}

}  // namespace octetra::distributed
