#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/incidence.hpp"

namespace octetra::distributed {

/// A list of the mesh (cells, tagged facets or edges) that changes in few positions: the first
/// child of a bisected entity replaces it, the others are appended, and for each root a linked list
/// stores the canonical order of its descendants. The list and its ancestor map belong to the mesh
/// and are passed to the functions. While the list is unordered, `ancestors.first` has the first
/// descendant of each root instead of ranges.
///
/// Memory: 12 bytes per entity, in addition to those of Incidence.
template <class I, std::size_t N>
class UnorderedList {
public:
    using Vertices = std::array<VertexIndex, N>;
    using List = IndexVector<I, Vertices>;

    /// The list must be in canonical order.
    UnorderedList(std::size_t vertex_count, const List& list, const AncestorMap& ancestors)
        : incidence_(vertex_count, list) {
        reserve_with_room(places_, list.size());
        for (std::uint32_t root = 0; root < ancestors.roots.size(); ++root) {
            const I begin{ancestors.first[root]};
            const I end{ancestors.first[root + 1]};
            for (I i = begin; i < end; ++i) {
                places_.push_back({root, i == begin ? I::none() : I{i.value() - std::size_t{1}},
                                   I{i.value() + std::size_t{1}}});
            }
            if (begin < end) places_.back().next = I::none();
        }
    }

    /// Calls found(i, e) for each entity of the list that has the edge as its edge number e.
    void for_each_with(const EdgeVertices& edge, const List& list, auto&& found) const {
        incidence_.for_each_with(
            edge, [&](I i) -> const Vertices& { return list[i]; }, found);
    }
    /// Frees the index that finding entities by edges and replacing them requires.
    void drop_index() noexcept { incidence_ = {}; }
    void make_index(std::size_t vertex_count, const List& list) {
        incidence_ = Incidence<I, N>(vertex_count, list);
    }
    [[nodiscard]] Incidence<I, N>& incidence() { return incidence_; }
    void set_vertex_count(std::size_t count) { incidence_.set_vertex_count(count); }
    /// Reserves capacity so that replace() cannot fail for this many children beyond the first
    /// ones.
    void make_room(std::size_t added, List& list) {
        octetra::make_room(list, list.size() + added);
        octetra::make_room(places_, list.size() + added);
        incidence_.make_room(added);
    }

    /// Returns the next descendant of the same root in canonical order, or none().
    [[nodiscard]] I next(I i) const { return places_[i].next; }
    /// Returns the previous one, or none().
    [[nodiscard]] I previous(I i) const { return places_[i].previous; }
    /// The position of its root among this process's roots.
    [[nodiscard]] std::uint32_t root_of(I i) const { return places_[i].root; }

    /// Replaces an entity of the list by its children.
    void replace(I i, std::span<const Vertices> pieces, List& list) {
        change(i, pieces[0], list);
        const auto [root, previous, after] = places_[i];
        I last = i;
        for (const Vertices& piece : pieces.subspan(1)) {
            incidence_.append(piece);
            list.push_back(piece);
            const I added = places_.append({root, last, after});
            places_[last].next = added;
            last = added;
        }
        if (!after.is_none()) places_[after].previous = last;
        is_ordered_ = is_ordered_ && pieces.size() == 1;
    }

    /// An entity and its place in the canonical order.
    struct Entry {
        I i;
        Vertices vertices{};
        std::uint32_t root = 0;
        I previous;
        I next;
    };
    [[nodiscard]] Entry entry_of(I i, const List& list) const {
        return {i, list[i], places_[i].root, places_[i].previous, places_[i].next};
    }
    /// Reverts calls of replace(): `before` has the replaced entities, in the order of these calls,
    /// and the list had `count` entities before. There must be no index.
    void restore(std::span<const Entry> before, std::size_t count, List& list) noexcept {
        for (std::size_t k = before.size(); k-- > 0;) {
            const auto& [i, vertices, root, previous, next] = before[k];
            list[i] = vertices;
            places_[i] = {root, previous, next};
            if (!next.is_none()) places_[next].previous = i;
        }
        list.resize(count);
        places_.resize(count);
    }

    // Coarsening: for each affected root, some entities are changed, superfluous ones are removed,
    // and the order is set. Then the last entities of the list are moved to the numbers of removed
    // ones.

    void change(I i, const Vertices& vertices, List& list) {
        incidence_.replace(i, list[i], vertices);
        list[i] = vertices;
    }
    void remove(I i, const List& list) { incidence_.remove(i, list[i]); }
    void set_order(std::uint32_t root, std::span<const I> descendants, AncestorMap& ancestors) {
        ancestors.first[root] = descendants.front().value();
        for (std::size_t k = 0; k < descendants.size(); ++k) {
            places_[descendants[k]] = {
                root, k == 0 ? I::none() : descendants[k - 1],
                k + 1 == descendants.size() ? I::none() : descendants[k + 1]};
        }
        is_ordered_ = false;
    }
    void move(I from, I to, List& list, AncestorMap& ancestors) {
        incidence_.move(from, to, list[from]);
        list[to] = list[from];
        const OrderLink place = places_[from];
        places_[to] = place;
        if (place.previous.is_none()) {
            ancestors.first[place.root] = to.value();
        } else {
            places_[place.previous].next = to;
        }
        if (!place.next.is_none()) places_[place.next].previous = to;
    }
    void truncate(std::size_t count, List& list) {
        incidence_.truncate(count);
        list.resize(count);
        places_.resize(count);
    }
    /// Renumbers vertices: `before` has the previous numbers of the remaining ones; those before
    /// `first` are unchanged. Removed vertices must have no entities.
    void keep_vertices(std::span<const VertexIndex> before, VertexIndex first, List& list) {
        incidence_.keep_vertices(before, first, list);
    }

    /// Calls visit(i) for each entity that has the vertex.
    void for_each_at(VertexIndex v, auto&& visit) const { incidence_.for_each_at(v, visit); }

    /// Returns whether the order of the list is canonical.
    [[nodiscard]] bool is_ordered() const { return is_ordered_; }

    /// The list in canonical order.
    struct Ordered {
        List list;
        std::vector<std::uint32_t> first;  ///< as in AncestorMap
        std::vector<I> before;             ///< the number of each entity in the unordered list
    };
    [[nodiscard]] Ordered ordered(const List& list, const AncestorMap& ancestors) const {
        Ordered ordered;
        reserve_in_huge_pages(ordered.list, list.size());
        reserve_in_huge_pages(ordered.before, list.size());
        ordered.first.reserve(ancestors.first.size());
        for (std::size_t root = 0; root < ancestors.roots.size(); ++root) {
            ordered.first.push_back(ordered.list.end_index().value());
            for (I i{ancestors.first[root]}; !i.is_none(); i = places_[i].next) {
                ordered.list.push_back(list[i]);
                ordered.before.push_back(i);
            }
        }
        ordered.first.push_back(ordered.list.end_index().value());
        return ordered;
    }

private:
    struct OrderLink {
        std::uint32_t root = 0;
        I previous;  ///< among the root's descendants, or none()
        I next;
    };

    Incidence<I, N> incidence_;
    IndexVector<I, OrderLink> places_;
    bool is_ordered_ = true;
};

}  // namespace octetra::distributed
