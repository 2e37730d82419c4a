#include "assemble/departures.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <octetra/core/vertex_buckets.hpp>

namespace octetra::distributed {
namespace {

template <class I, std::size_t N, std::size_t Sides>
std::vector<int> ranks_of_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list,
                                 const DistributedMesh& input, std::span<const int> rank_of_root,
                                 const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    constexpr int none = -1;
    std::vector<int> ranks(list.size(), none);
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
                if (ranks[i.value()] == none) ranks[i.value()] = rank_of_root[c.value()];
            });
        }
    }
    std::ranges::replace(ranks, none, input.processes.rank());
    return ranks;
}

/// For each rank, the indices of its entities.
std::vector<std::vector<std::uint32_t>> by_rank(const std::vector<int>& ranks,
                                                std::size_t process_count) {
    std::vector<std::vector<std::uint32_t>> indices(process_count);
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        indices[static_cast<std::size_t>(ranks[i])].push_back(static_cast<std::uint32_t>(i));
    }
    return indices;
}

template <std::size_t N>
std::array<std::uint32_t, N> indices_of(const std::array<VertexIndex, N>& vertices,
                                        const std::vector<std::uint32_t>& index) {
    std::array<std::uint32_t, N> indices;
    for (std::size_t k = 0; k < N; ++k) indices[k] = index[vertices[k].value()];
    return indices;
}

template <class I, std::size_t N>
std::vector<RootMessage::Tagged<N>> tagged(const std::vector<std::uint32_t>& entities,
                                           const IndexVector<I, std::array<VertexIndex, N>>& list,
                                           const AncestorMap& ancestors,
                                           const std::vector<std::uint32_t>& index) {
    std::vector<RootMessage::Tagged<N>> tagged;
    tagged.reserve(entities.size());
    for (const std::uint32_t i : entities) {
        tagged.push_back({.number = ancestors.roots[i],
                          .vertices = indices_of(list[I{i}], index),
                          .marker = ancestors.markers.empty() ? Marker{0} : ancestors.markers[i]});
    }
    return tagged;
}

}  // namespace

Departures departures_of(DistributedMesh input, CutRoots cuts, std::vector<int> rank_of_root) {
    Departures departures{std::move(input), std::move(cuts), std::move(rank_of_root), {}, {}};
    const DistributedMesh& of = departures.input;
    departures.rank_of_facet = ranks_of_tagged(of.facets, of, departures.rank_of_root, cell_faces);
    departures.rank_of_edge = ranks_of_tagged(of.edges, of, departures.rank_of_root, cell_edges);
    return departures;
}

MessageMaker::MessageMaker(const Departures& departures)
    : input_(&departures.input),
      cuts_(&departures.cuts.bytes),
      cut_begin_(input_->cells.size() + 1, 0),
      index_(input_->points.size()),
      last_message_(input_->points.size(), -1) {
    for (const CutRoots::Root& root : departures.cuts.roots) {
        cut_begin_[root.index + std::size_t{1}] = root.bytes;
    }
    for (std::size_t r = 1; r < cut_begin_.size(); ++r) cut_begin_[r] += cut_begin_[r - 1];
    const auto process_count = static_cast<std::size_t>(input_->processes.size());
    roots_ = by_rank(departures.rank_of_root, process_count);
    facets_ = by_rank(departures.rank_of_facet, process_count);
    edges_ = by_rank(departures.rank_of_edge, process_count);
}

RootMessage MessageMaker::message_to(int rank, std::span<const VertexIndex> further_vertices) {
    const auto r = static_cast<std::size_t>(rank);
    RootMessage message;
    put_vertices(rank, further_vertices, message);
    put_roots(roots_[r], message);
    message.facets = tagged(facets_[r], input_->facets, input_->facet_ancestors, index_);
    message.edges = tagged(edges_[r], input_->edges, input_->edge_ancestors, index_);
    return message;
}

void MessageMaker::put_vertices(int rank, std::span<const VertexIndex> further,
                                RootMessage& message) {
    std::vector<VertexIndex> vertices(further.begin(), further.end());
    for (const std::uint32_t r : roots_[static_cast<std::size_t>(rank)]) {
        for (const VertexIndex v : input_->cells[CellIndex{r}]) {
            if (std::exchange(last_message_[v.value()], rank) != rank) vertices.push_back(v);
        }
    }
    std::ranges::sort(vertices);
    const std::size_t attributes = input_->attributes_per_point;
    message.vertices.reserve(vertices.size());
    message.points.reserve(vertices.size());
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

void MessageMaker::put_roots(const Indices& roots, RootMessage& message) const {
    const AncestorMap& ancestors = input_->cell_ancestors;
    message.roots.reserve(roots.size());
    for (const std::uint32_t r : roots) {
        const auto cuts =
            std::span(*cuts_).subspan(cut_begin_[r], cut_begin_[r + 1] - cut_begin_[r]);
        message.cuts.insert(message.cuts.end(), cuts.begin(), cuts.end());
        message.roots.push_back(
            {.number = ancestors.roots[r],
             .corners = indices_of(input_->cells[CellIndex{r}], index_),
             .region = ancestors.markers.empty() ? Marker{0} : ancestors.markers[r],
             .cut_bytes = static_cast<std::uint32_t>(cuts.size())});
    }
}

std::vector<std::vector<std::byte>> packed_messages(const Departures& departures) {
    const Communicator& processes = departures.input.processes;
    MessageMaker maker(departures);
    std::vector<std::vector<std::byte>> packed(static_cast<std::size_t>(processes.size()));
    for (int rank = 0; rank < processes.size(); ++rank) {
        if (rank == processes.rank()) continue;
        packed[static_cast<std::size_t>(rank)] = maker.message_to(rank).packed();
    }
    return packed;
}

}  // namespace octetra::distributed
