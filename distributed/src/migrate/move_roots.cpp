#include "migrate/move_roots.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <octetra/core/vertex_buckets.hpp>
#include <octetra/distributed/profile.hpp>

#include "history/steps_of.hpp"
#include "migrate/root_message.hpp"

namespace octetra::distributed {
namespace {

/// Where each facet or edge goes: with the first of the cells that have it.
template <class I, std::size_t N, std::size_t Sides>
std::vector<int> ranks_of_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list,
                                 const DistributedMesh& input, std::span<const int> rank_of_root,
                                 const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::vector<int> ranks(list.size(), -1);
    if (list.empty()) return ranks;
    const VertexBuckets<I, N> buckets(list, input.points.size());
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
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

/// What goes to one process after the other.
class Messages {
public:
    Messages(const DistributedMesh& input, const CutRoots& cuts, std::span<const int> rank_of_root)
        : input_(&input),
          messages_(static_cast<std::size_t>(input.processes.size())),
          place_(input.points.size()),
          has_place_(input.points.size(), -1) {
        sort_out(rank_of_root);
        sort_out_cuts(cuts, rank_of_root);
        sort_out_tagged<FacetIndex>(input.facets, input.facet_ancestors, rank_of_root, cell_faces,
                                    facets_);
        sort_out_tagged<EdgeIndex>(input.edges, input.edge_ancestors, rank_of_root, cell_edges,
                                   edges_);
    }

    [[nodiscard]] std::vector<std::vector<std::byte>> packed() {
        std::vector<std::vector<std::byte>> packed(messages_.size());
        for (std::size_t rank = 0; rank < messages_.size(); ++rank) {
            take_vertices(static_cast<int>(rank));
            take_roots(rank);
            messages_[rank].facets =
                tagged_to<FacetIndex, 3>(rank, facets_, input_->facets, input_->facet_ancestors);
            messages_[rank].edges =
                tagged_to<EdgeIndex, 2>(rank, edges_, input_->edges, input_->edge_ancestors);
            packed[rank] = messages_[rank].packed();
            messages_[rank] = {};
        }
        return packed;
    }

private:
    /// By rank, places in a list of the input.
    using Lists = std::vector<std::vector<std::uint32_t>>;

    void sort_out(std::span<const int> rank_of_root) {
        roots_.resize(messages_.size());
        std::vector<bool> is_used(input_->points.size(), false);
        for (std::size_t r = 0; r < rank_of_root.size(); ++r) {
            roots_[static_cast<std::size_t>(rank_of_root[r])].push_back(
                static_cast<std::uint32_t>(r));
            for (const VertexIndex v : input_->cells[CellIndex{r}]) is_used[v.value()] = true;
        }
        for (VertexIndex v{0}; v < input_->points.end_index(); ++v) {
            if (!is_used[v.value()]) of_no_cell_.push_back(v);
        }
        cut_bytes_.assign(rank_of_root.size(), 0);
    }
    void sort_out_cuts(const CutRoots& cuts, std::span<const int> rank_of_root) {
        auto next = cuts.bytes.begin();
        for (const CutRoots::Root& root : cuts.roots) {
            auto& bytes = messages_[static_cast<std::size_t>(rank_of_root[root.place])].cuts;
            const auto end = next + root.bytes;
            bytes.insert(bytes.end(), next, end);
            next = end;
            cut_bytes_[root.place] = root.bytes;
        }
    }
    template <class I, std::size_t N, std::size_t Sides>
    void sort_out_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list,
                         const AncestorMap& ancestors, std::span<const int> rank_of_root,
                         const std::array<std::array<std::uint8_t, N>, Sides>& sides,
                         Lists& lists) {
        lists.resize(messages_.size());
        const auto ranks = ranks_of_tagged<I>(list, *input_, rank_of_root, sides);
        for (std::size_t i = 0; i < ancestors.roots.size(); ++i) {
            lists[static_cast<std::size_t>(ranks[i])].push_back(static_cast<std::uint32_t>(i));
        }
    }

    void take_vertices(int rank) {
        std::vector<VertexIndex> vertices;
        if (rank == input_->processes.rank()) vertices = of_no_cell_;
        for (const std::uint32_t r : roots_[static_cast<std::size_t>(rank)]) {
            for (const VertexIndex v : input_->cells[CellIndex{r}]) {
                if (std::exchange(has_place_[v.value()], rank) != rank) vertices.push_back(v);
            }
        }
        std::ranges::sort(vertices);
        RootMessage& message = messages_[static_cast<std::size_t>(rank)];
        const std::size_t attributes = input_->attributes_per_point;
        for (const VertexIndex v : vertices) {
            place_[v.value()] = static_cast<std::uint32_t>(message.vertices.size());
            message.vertices.push_back(
                static_cast<std::uint64_t>(input_->input_vertices[v.value()]));
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

    void take_roots(std::size_t rank) {
        const AncestorMap& ancestors = input_->cell_ancestors;
        for (const std::uint32_t r : roots_[rank]) {
            messages_[rank].roots.push_back(
                {.number = ancestors.roots[r],
                 .corners = places_of(input_->cells[CellIndex{r}]),
                 .region = ancestors.markers.empty() ? Marker{0} : ancestors.markers[r],
                 .cut_bytes = cut_bytes_[r]});
        }
    }

    template <class I, std::size_t N>
    std::vector<RootMessage::Tagged<N>> tagged_to(
        std::size_t rank, const Lists& lists,
        const IndexVector<I, std::array<VertexIndex, N>>& list, const AncestorMap& ancestors) {
        std::vector<RootMessage::Tagged<N>> tagged;
        for (const std::uint32_t i : lists[rank]) {
            tagged.push_back(
                {.number = ancestors.roots[i],
                 .vertices = places_of(list[I{i}]),
                 .marker = ancestors.markers.empty() ? Marker{0} : ancestors.markers[i]});
        }
        return tagged;
    }

    template <std::size_t N>
    [[nodiscard]] std::array<std::uint32_t, N> places_of(
        const std::array<VertexIndex, N>& vertices) const {
        std::array<std::uint32_t, N> places;
        for (std::size_t k = 0; k < N; ++k) places[k] = place_[vertices[k].value()];
        return places;
    }

    const DistributedMesh* input_;
    std::vector<RootMessage> messages_;
    Lists roots_;
    Lists facets_;
    Lists edges_;
    std::vector<std::uint32_t> cut_bytes_;  ///< of each root
    std::vector<VertexIndex> of_no_cell_;
    std::vector<std::uint32_t> place_;  ///< of each vertex in the message that is being made
    std::vector<int> has_place_;        ///< the last message in which it had one
};

/// Which lists the input has, on any process.
struct HasLists {
    bool point_markers = false;
    bool regions = false;
    bool facet_markers = false;
    bool edge_markers = false;

    /// Collective.
    explicit HasLists(const DistributedMesh& mesh) {
        std::array<std::uint64_t, 4> has{!mesh.input_vertex_markers.empty() ? 1U : 0U,
                                         !mesh.cell_ancestors.markers.empty() ? 1U : 0U,
                                         !mesh.facet_ancestors.markers.empty() ? 1U : 0U,
                                         !mesh.edge_ancestors.markers.empty() ? 1U : 0U};
        mesh.processes.max(std::span<std::uint64_t>(has));
        point_markers = has[0] != 0;
        regions = has[1] != 0;
        facet_markers = has[2] != 0;
        edge_markers = has[3] != 0;
    }
};

/// An entry of a list of one of the messages that have come.
struct Arrival {
    std::uint64_t number = 0;
    std::uint32_t message = 0;
    std::uint32_t place = 0;

    friend auto operator<=>(const Arrival&, const Arrival&) = default;
};

/// All entries of a list of the messages, by number.
std::vector<Arrival> arrivals(const std::vector<RootMessage>& messages, auto&& list_of,
                              auto&& number_of) {
    std::vector<Arrival> all;
    for (std::size_t m = 0; m < messages.size(); ++m) {
        const auto& list = list_of(messages[m]);
        for (std::size_t i = 0; i < list.size(); ++i) {
            all.push_back(
                {number_of(list[i]), static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(i)});
        }
    }
    std::ranges::sort(all);
    return all;
}

template <std::size_t N>
std::array<std::uint64_t, N> numbers_of(const RootMessage& message,
                                        const std::array<std::uint32_t, N>& places) {
    std::array<std::uint64_t, N> numbers;
    for (std::size_t k = 0; k < N; ++k) numbers[k] = message.vertices[places[k]];
    return numbers;
}

void take_vertices(const std::vector<RootMessage>& messages, MeshPart& part) {
    const auto all = arrivals(
        messages, [](const RootMessage& m) -> const auto& { return m.vertices; }, std::identity());
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0 && all[i].number == all[i - 1].number) continue;
        const RootMessage& message = messages[all[i].message];
        const std::size_t place = all[i].place;
        part.vertex_numbers.push_back(all[i].number);
        part.points.push_back(message.points[place]);
        if (!message.point_markers.empty()) {
            part.point_markers.push_back(message.point_markers[place]);
        }
        for (std::size_t k = 0; k < part.attributes_per_point; ++k) {
            part.point_attributes.push_back(
                message.point_attributes[place * part.attributes_per_point + k]);
        }
    }
}

void take_roots(const std::vector<RootMessage>& messages, bool has_regions, MovedRoots& moved) {
    const auto all = arrivals(
        messages, [](const RootMessage& m) -> const auto& { return m.roots; },
        [](const RootMessage::Root& root) { return root.number; });
    std::vector<std::size_t> cuts_taken(messages.size(), 0);
    for (const Arrival& arrival : all) {
        const RootMessage& message = messages[arrival.message];
        const RootMessage::Root& root = message.roots[arrival.place];
        if (root.cut_bytes > 0) {
            moved.cuts.roots.push_back(
                {static_cast<std::uint32_t>(moved.input.cells.size()), root.cut_bytes});
            const auto bytes =
                std::span(message.cuts).subspan(cuts_taken[arrival.message], root.cut_bytes);
            moved.cuts.bytes.insert(moved.cuts.bytes.end(), bytes.begin(), bytes.end());
            cuts_taken[arrival.message] += root.cut_bytes;
        }
        moved.input.cells.push_back(numbers_of(message, root.corners));
        moved.input.cell_numbers.push_back(root.number);
        if (has_regions) moved.input.regions.push_back(root.region);
        moved.came_from.push_back(static_cast<int>(arrival.message));
    }
}

template <std::size_t N>
void take_tagged(const std::vector<RootMessage>& messages,
                 std::vector<RootMessage::Tagged<N>> RootMessage::*list, bool has_markers,
                 std::vector<std::array<std::uint64_t, N>>& entities, std::vector<Marker>& markers,
                 std::vector<std::uint64_t>& numbers) {
    const auto all = arrivals(
        messages, [&](const RootMessage& m) -> const auto& { return m.*list; },
        [](const RootMessage::Tagged<N>& tagged) { return tagged.number; });
    for (const Arrival& arrival : all) {
        const RootMessage& message = messages[arrival.message];
        const auto& tagged = (message.*list)[arrival.place];
        entities.push_back(numbers_of(message, tagged.vertices));
        numbers.push_back(tagged.number);
        if (has_markers) markers.push_back(tagged.marker);
    }
}

MovedRoots together(const std::vector<RootMessage>& messages, const HasLists& has,
                    const DistributedMesh& mesh) {
    MovedRoots moved;
    moved.input.attributes_per_point = mesh.attributes_per_point;
    moved.input.index_base = mesh.index_base;
    take_vertices(messages, moved.input);
    take_roots(messages, has.regions, moved);
    take_tagged(messages, &RootMessage::facets, has.facet_markers, moved.input.facets,
                moved.input.facet_markers, moved.input.facet_numbers);
    take_tagged(messages, &RootMessage::edges, has.edge_markers, moved.input.edges,
                moved.input.edge_markers, moved.input.edge_numbers);
    return moved;
}

}  // namespace

MovedRoots move_roots(const DistributedMesh& mesh, const CutRoots& cuts,
                      std::span<const int> rank_of_root, LocalFailure& failure) {
    const Phase phase(mesh.processes, "move roots");
    const HasLists has(mesh);
    std::vector<std::vector<std::byte>> outboxes;
    failure.attempt([&] {
        const DistributedMesh input = input_of(mesh);
        outboxes = Messages(input, cuts, rank_of_root).packed();
    });
    if (failure.max_unless_failed(mesh.processes, 0) == LocalFailure::somewhere) return {};
    MovedRoots moved;
    failure.attempt([&] {
        std::vector<RootMessage> messages;
        for (const auto& inbox : mesh.processes.all_to_all(outboxes)) {
            messages.push_back(RootMessage::unpacked(inbox));
        }
        outboxes.clear();
        moved = together(messages, has, mesh);
    });
    return moved;
}

}  // namespace octetra::distributed
