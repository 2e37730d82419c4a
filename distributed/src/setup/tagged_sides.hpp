#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/vertex_buckets.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "assemble/ancestors_of_roots.hpp"
#include "setup/owners.hpp"
#include "setup/part_vertices.hpp"

namespace octetra::distributed {

/// A tagged facet or edge that is being sent to a process with a cell at it; vertices are global
/// numbers.
template <std::size_t N>
struct TaggedSide {
    std::array<VertexIndex, N> vertices{};
    std::uint32_t number = 0;
    Marker marker = 0;

    [[nodiscard]] VertexIndex lowest() const { return std::ranges::min(vertices); }
    [[nodiscard]] std::array<VertexIndex, N> sorted() const {
        auto key = vertices;
        std::ranges::sort(key);
        return key;
    }
};

/// Bits for the cells that a process has at a facet: on its even side, on its odd side, and whether
/// several are on the same side.
namespace side {
inline constexpr std::uint8_t even = 1;
inline constexpr std::uint8_t odd = 2;
inline constexpr std::uint8_t overlap = 4;
}  // namespace side

/// Returns the side of its face k on which a positive cell lies, defined by the order of the global
/// numbers of the face's vertices, so all processes agree. Edges have no sides.
inline std::uint8_t cell_side(const FacetVertices& face, std::size_t k) {
    const auto& [a, b, c] = face;
    const bool is_even = (a < b) == ((b < c) == (a < c));
    return is_even == (k % 2 == 0) ? side::even : side::odd;
}
inline std::uint8_t cell_side(const EdgeVertices&, std::size_t) { return side::even; }

/// Assigns facets or edges, of which each process has read a share, to processes that have cells at
/// them, within a transaction. The owner of its lowest vertex handles an entity, because it knows
/// the processes that have this vertex.
template <class I, std::size_t N>
class TaggedSides {
public:
    using Side = TaggedSide<N>;
    using List = IndexVector<I, std::array<VertexIndex, N>>;

    TaggedSides(const Communicator& processes, const VerticesOfPart& vertices)
        : processes_(&processes), vertices_(&vertices) {}

    /// Collective. Sends this process's share, whose first entity has number `first`, to the owners
    /// of the lowest vertices. Returns false if an entity is listed repeatedly with different
    /// markers.
    [[nodiscard]] bool collect(const OwnerMap& owners, const List& list,
                               const IndexVector<I, Marker>& markers, std::uint64_t first) {
        std::vector<std::vector<Side>> to_owners(process_count());
        for (I i{0}; i < list.end_index(); ++i) {
            const Side one{list[i], static_cast<std::uint32_t>(first + i.value()),
                           markers.empty() ? Marker{0} : markers[i]};
            const int owner = owners.rank_of(one.lowest().value());
            to_owners[static_cast<std::size_t>(owner)].push_back(one);
        }
        for (const auto& box : processes_->all_to_all(to_owners)) {
            owned_.insert(owned_.end(), box.begin(), box.end());
        }
        std::vector<std::pair<std::array<VertexIndex, N>, std::size_t>> order;
        order.reserve(owned_.size());
        for (const Side& one : owned_) order.emplace_back(one.sorted(), order.size());
        std::ranges::sort(order);
        std::vector<Side> sorted;
        sorted.reserve(owned_.size());
        bool agree = true;
        for (std::size_t i = 0; i < order.size(); ++i) {
            sorted.push_back(owned_[order[i].second]);
            agree = agree && (i == 0 || order[i].first != order[i - 1].first ||
                              sorted[i].marker == sorted[i - 1].marker);
        }
        owned_ = std::move(sorted);
        return agree;
    }

    /// Collective. Sends entities to all processes that have their lowest vertex; these report the
    /// cells that they have there. `cells` have local vertex indices. Returns false if an entity
    /// has no cell, or two on the same side.
    template <std::size_t Sides>
    [[nodiscard]] bool find_cells(const IndexVector<CellIndex, CellVertices>& cells,
                                  const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
        received_ = processes_->all_to_all(boxes_to_parts());
        auto kept_by = processes_->all_to_all(find_cells_at(cells, sides));
        processes_->agree_on_success();  // all replies have been received
        const bool is_valid = assign_to_lowest_rank(kept_by);
        keeps_ = processes_->all_to_all(kept_by);
        processes_->agree_on_success();
        return is_valid;
    }

    /// Appends the entities that this process keeps, in the order of their numbers.
    void take(bool has_markers, List& list, AncestorMap& ancestors) {
        std::vector<Side> kept;
        for (std::size_t rank = 0; rank < received_.size(); ++rank) {
            for (std::size_t i = 0; i < received_[rank].size(); ++i) {
                if (keeps_[rank][i] != 0) kept.push_back(received_[rank][i]);
            }
        }
        std::ranges::sort(kept, {}, &Side::number);
        std::vector<std::uint64_t> numbers;
        std::vector<Marker> markers;
        list.reserve(kept.size());
        numbers.reserve(kept.size());
        for (const Side& one : kept) {
            list.push_back(local_vertices(one));
            numbers.push_back(one.number);
            if (has_markers) markers.push_back(one.marker);
        }
        ancestors = ancestors_of_roots(std::move(numbers), std::move(markers));
    }

private:
    [[nodiscard]] std::size_t process_count() const {
        return static_cast<std::size_t>(processes_->size());
    }

    /// Calls send(rank, index) for each process that has the lowest vertex of an entity in
    /// owned_; the order is the same in each call.
    void for_each_sent(auto&& send) const {
        for (std::size_t rank = 0; rank < process_count(); ++rank) {
            std::size_t next = 0;
            for (const std::uint32_t number : vertices_->requests.received[rank]) {  // ascending
                while (next < owned_.size() && owned_[next].lowest().value() < number) ++next;
                for (; next < owned_.size() && owned_[next].lowest().value() == number; ++next) {
                    send(rank, next);
                }
            }
        }
    }

    [[nodiscard]] std::vector<std::vector<Side>> boxes_to_parts() const {
        std::vector<std::vector<Side>> boxes(process_count());
        for_each_sent(
            [&](std::size_t rank, std::size_t place) { boxes[rank].push_back(owned_[place]); });
        return boxes;
    }

    [[nodiscard]] bool has_all(const Side& one) const {
        return std::ranges::all_of(one.vertices,
                                   [&](VertexIndex v) { return vertices_->set.has(v.value()); });
    }
    [[nodiscard]] std::array<VertexIndex, N> local_vertices(const Side& one) const {
        auto vertices = one.vertices;
        for (VertexIndex& v : vertices) v = vertices_->set.local_of(v);
        return vertices;
    }

    /// Returns the bits of the cells at each received entity.
    template <std::size_t Sides>
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> find_cells_at(
        const IndexVector<CellIndex, CellVertices>& cells,
        const std::array<std::array<std::uint8_t, N>, Sides>& sides) const {
        std::vector<std::vector<std::uint8_t>> found;
        List list;
        std::vector<std::uint8_t*> found_at;
        std::vector<bool> is_corner(vertices_->set.size(), false);
        for (const auto& box : received_) found.emplace_back(box.size(), std::uint8_t{0});
        for (std::size_t rank = 0; rank < received_.size(); ++rank) {
            for (std::size_t i = 0; i < received_[rank].size(); ++i) {
                if (!has_all(received_[rank][i])) continue;
                list.push_back(local_vertices(received_[rank][i]));
                for (const VertexIndex v : list.back()) is_corner[v.value()] = true;
                found_at.push_back(&found[rank][i]);
            }
        }
        if (list.empty()) return found;
        const VertexBuckets<I, N> buckets(list, vertices_->set.size());
        for (const CellVertices& cell : cells) {
            const auto corners =
                std::ranges::count_if(cell, [&](VertexIndex v) { return is_corner[v.value()]; });
            if (corners < std::ptrdiff_t{N}) continue;  // most cells
            for (std::size_t k = 0; k < Sides; ++k) {
                std::array<VertexIndex, N> vertices;
                for (std::size_t j = 0; j < N; ++j) vertices[j] = cell[sides[k][j]];
                buckets.find(vertices, [&](I i) { meet(*found_at[i.value()], vertices, k); });
            }
        }
        return found;
    }

    static void meet(std::uint8_t& found, const std::array<VertexIndex, N>& vertices,
                     std::size_t k) {
        const std::uint8_t of_cell = cell_side(vertices, k);
        const bool again = N == 3 && (found & of_cell) != 0;
        found |= static_cast<std::uint8_t>(of_cell | (again ? side::overlap : 0));
    }

    /// Replaces the found bits by 1 for the lowest rank that has a cell at the entity, which keeps
    /// it, and by 0 for others. Returns false if there is no cell, or two on the same side.
    [[nodiscard]] bool assign_to_lowest_rank(std::vector<std::vector<std::uint8_t>>& found) const {
        std::vector<std::uint8_t> all(owned_.size(), 0);
        std::vector<std::size_t> next(process_count(), 0);
        bool is_valid = true;
        for_each_sent([&](std::size_t rank, std::size_t place) {
            std::uint8_t& here = found[rank][next[rank]++];
            is_valid =
                is_valid && (here & side::overlap) == 0 && (N == 2 || (here & all[place]) == 0);
            const bool keeps = here != 0 && all[place] == 0;
            all[place] |= here;
            here = keeps ? 1 : 0;
        });
        return is_valid && std::ranges::find(all, std::uint8_t{0}) == all.end();
    }

    const Communicator* processes_;
    const VerticesOfPart* vertices_;
    std::vector<Side> owned_;                  // sorted by vertices
    std::vector<std::vector<Side>> received_;  // from each owner
    // for each of these: whether this process keeps it
    std::vector<std::vector<std::uint8_t>> keeps_;
};

}  // namespace octetra::distributed
