#include "assemble/arrivals.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "assemble/ancestors_of_roots.hpp"

namespace octetra::distributed {
namespace {

/// An entry of a list in one of the messages.
struct Entry {
    std::uint64_t number = 0;
    std::uint32_t message = 0;
    std::uint32_t index = 0;

    friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// Returns the entries of a list in all messages, sorted by number.
std::vector<Entry> entries(const std::vector<RootMessage>& messages, auto list, auto&& number_of) {
    std::vector<Entry> all;
    for (std::uint32_t m = 0; m < messages.size(); ++m) {
        std::uint32_t index = 0;
        for (const auto& entry : messages[m].*list) all.push_back({number_of(entry), m, index++});
    }
    if (!std::ranges::is_sorted(all)) std::ranges::sort(all);  // those of one message are sorted
    return all;
}

/// Merges the roots of all messages into a part.
class ArrivalMerger {
public:
    ArrivalMerger(const std::vector<RootMessage>& messages, const HasLists& has, Arrivals& arrivals)
        : messages_(&messages), arrivals_(&arrivals), part_(&arrivals.part) {
        take_vertices();
        take_roots(has.regions);
        take_tagged(&RootMessage::facets, has.facet_markers, part_->facets, part_->facet_ancestors);
        take_tagged(&RootMessage::edges, has.edge_markers, part_->edges, part_->edge_ancestors);
    }

private:
    void take_vertices() {
        for (const RootMessage& message : *messages_) {
            local_.emplace_back(message.vertices.size());
        }
        const auto number_of = [](GlobalVertex v) { return static_cast<std::uint64_t>(v); };
        for (const Entry& entry : entries(*messages_, &RootMessage::vertices, number_of)) {
            const GlobalVertex number{entry.number};
            if (part_->input_vertices.empty() || part_->input_vertices.back() != number) {
                take_vertex((*messages_)[entry.message], entry.index);
            }
            local_[entry.message][entry.index] = VertexIndex{part_->points.size() - 1};
        }
    }
    void take_vertex(const RootMessage& message, std::size_t index) {
        part_->input_vertices.push_back(message.vertices[index]);
        part_->points.push_back(message.points[index]);
        if (!message.point_markers.empty()) {
            part_->input_vertex_markers.push_back(message.point_markers[index]);
        }
        const std::size_t count = part_->attributes_per_point;
        for (std::size_t k = 0; k < count; ++k) {
            part_->point_attributes.push_back(message.point_attributes[index * count + k]);
        }
    }

    void take_roots(bool has_regions) {
        std::vector<std::uint64_t> numbers;
        std::vector<Marker> regions;
        std::vector<std::size_t> cuts_taken(messages_->size(), 0);
        const auto number_of = [](const RootMessage::Root& root) { return root.number; };
        for (const Entry& entry : entries(*messages_, &RootMessage::roots, number_of)) {
            const RootMessage& message = (*messages_)[entry.message];
            const RootMessage::Root& root = message.roots[entry.index];
            if (root.cut_bytes > 0) {
                arrivals_->cuts.roots.push_back(
                    {static_cast<std::uint32_t>(numbers.size()), root.cut_bytes});
                const auto bytes =
                    std::span(message.cuts).subspan(cuts_taken[entry.message], root.cut_bytes);
                auto& all = arrivals_->cuts.bytes;
                all.insert(all.end(), bytes.begin(), bytes.end());
                cuts_taken[entry.message] += root.cut_bytes;
            }
            part_->cells.push_back(local(entry, root.corners));
            numbers.push_back(root.number);
            if (has_regions) regions.push_back(root.region);
            arrivals_->rank_of_root.push_back(static_cast<int>(entry.message));
        }
        part_->cell_ancestors = ancestors_of_roots(std::move(numbers), std::move(regions));
    }

    template <class I, std::size_t N>
    void take_tagged(std::vector<RootMessage::Tagged<N>> RootMessage::*list, bool has_markers,
                     IndexVector<I, std::array<VertexIndex, N>>& entities, AncestorMap& ancestors) {
        std::vector<std::uint64_t> numbers;
        std::vector<Marker> markers;
        const auto number_of = [](const auto& tagged) { return tagged.number; };
        for (const Entry& entry : entries(*messages_, list, number_of)) {
            const auto& tagged = ((*messages_)[entry.message].*list)[entry.index];
            entities.push_back(local(entry, tagged.vertices));
            numbers.push_back(tagged.number);
            if (has_markers) markers.push_back(tagged.marker);
        }
        ancestors = ancestors_of_roots(std::move(numbers), std::move(markers));
    }

    template <std::size_t N>
    [[nodiscard]] std::array<VertexIndex, N> local(
        const Entry& entry, const std::array<std::uint32_t, N>& indices) const {
        std::array<VertexIndex, N> vertices;
        for (std::size_t k = 0; k < N; ++k) vertices[k] = local_[entry.message][indices[k]];
        return vertices;
    }

    const std::vector<RootMessage>* messages_;
    Arrivals* arrivals_;
    DistributedMesh* part_;
    std::vector<std::vector<VertexIndex>> local_;  ///< for each message, its vertices
};

}  // namespace

Arrivals arrivals_of(const std::vector<RootMessage>& messages, const HasLists& has,
                     std::size_t attributes_per_point) {
    Arrivals arrivals;
    arrivals.part.attributes_per_point = attributes_per_point;
    (void)ArrivalMerger(messages, has, arrivals);
    return arrivals;
}

}  // namespace octetra::distributed
