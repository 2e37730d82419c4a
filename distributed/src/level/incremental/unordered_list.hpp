#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/incidence.hpp"
#include "memory/huge_pages.hpp"

namespace octetra::distributed {

/// A list of the mesh (cells, tagged facets or edges) while it changes in a few places only: the
/// first piece of what is bisected takes its place, the others go to the end, and a linked list
/// remembers the canonical order. The list and its ancestors are the mesh's, and handed in. As long
/// as the list is unordered, `ancestors.first` names the first descendant of every root, not
/// ranges.
///
/// Memory: 4 bytes per entity beside those of Incidence, 8 for those that are added.
template <class I, std::size_t N>
class UnorderedList {
public:
    using Vertices = std::array<VertexIndex, N>;
    using List = IndexVector<I, Vertices>;

    /// The list is in canonical order.
    UnorderedList(std::size_t vertex_count, const List& list)
        : incidence_(vertex_count, list), first_added_(list.size()) {
        reserve_with_room(next_, list.size());
        next_.resize(list.size());
        std::ranges::generate(next_, [next = std::size_t{0}]() mutable { return I{++next}; });
        if (!next_.empty()) next_.back() = I::none();
    }

    /// Calls found(i, e) for each entity of the list that has the edge, as its e-th one.
    void for_each_with(const EdgeVertices& edge, const List& list, auto&& found) const {
        incidence_.for_each_with(
            edge, [&](I i) -> const Vertices& { return list[i]; }, found);
    }
    /// To find entities by edges, and to replace them, takes an index: memory that can be given
    /// back for a while.
    void drop_index() noexcept { incidence_ = {}; }
    void make_index(std::size_t vertex_count, const List& list) {
        incidence_ = Incidence<I, N>(vertex_count, list);
    }
    void set_vertex_count(std::size_t count) { incidence_.set_vertex_count(count); }
    /// After this, replace() does not fail for so many pieces beyond the first ones.
    void make_room(std::size_t added, List& list) {
        octetra::distributed::make_room(list, list.size() + added);
        octetra::distributed::make_room(next_, list.size() + added);
        octetra::distributed::make_room(root_of_added_, root_of_added_.size() + added);
        incidence_.make_room(added);
    }

    /// What follows in canonical order, or none().
    [[nodiscard]] I next(I i) const { return next_[i]; }
    /// The position of its root among this process's roots.
    [[nodiscard]] std::uint32_t root_of(I i, const AncestorMap& ancestors) const {
        if (i >= first_added_) return root_of_added_[i.value() - first_added_.value()];
        const auto after = std::ranges::upper_bound(ancestors.first, i.value());
        return static_cast<std::uint32_t>(after - ancestors.first.begin()) - 1;
    }

    /// Calls visit(i, position of the root) for the entities begin .. end-1 as they stand in the
    /// list: sooner than by root_of().
    void for_each_root(I begin, I end, const AncestorMap& ancestors, auto&& visit) const {
        if (begin == end) return;
        std::uint32_t root = root_of(begin, ancestors);
        I i = begin;
        for (; i < std::min(end, first_added_); ++i) {
            while (ancestors.first[root + 1] <= i.value()) ++root;
            visit(i, root);
        }
        for (; i < end; ++i) visit(i, root_of(i, ancestors));
    }

    /// Puts pieces into the place of an entity of the list.
    void replace(I i, std::span<const Vertices> pieces, List& list, const AncestorMap& ancestors) {
        const std::uint32_t root = root_of(i, ancestors);
        incidence_.replace(i, list[i], pieces[0]);
        list[i] = pieces[0];
        I last = i;
        for (const Vertices& piece : pieces.subspan(1)) {
            incidence_.append(piece);
            list.push_back(piece);
            root_of_added_.push_back(root);
            const I added = next_.append(next_[last]);
            next_[last] = added;
            last = added;
        }
    }

    /// Is the list in canonical order as it stands?
    [[nodiscard]] bool is_ordered(const List& list) const {
        return list.end_index() == first_added_;
    }

    /// What the list is in canonical order.
    struct Ordered {
        List list;
        std::vector<std::uint32_t> first;  ///< as in AncestorMap
        std::vector<I> before;  ///< the number that each entity has in the unordered list
    };
    [[nodiscard]] Ordered ordered(const List& list, const AncestorMap& ancestors) const {
        Ordered ordered;
        ordered.list.reserve(list.size());
        ordered.before.reserve(list.size());
        ordered.first.reserve(ancestors.first.size());
        for (I i = first_of(list); !i.is_none(); i = next_[i]) {
            const std::size_t root = ordered.first.size();
            if (root < ancestors.roots.size() && ancestors.first[root] == i.value()) {
                ordered.first.push_back(ordered.list.end_index().value());
            }
            ordered.list.push_back(list[i]);
            ordered.before.push_back(i);
        }
        ordered.first.push_back(ordered.list.end_index().value());
        return ordered;
    }

private:
    static I first_of(const List& list) { return list.empty() ? I::none() : I{0}; }

    Incidence<I, N> incidence_;
    IndexVector<I, I> next_;
    I first_added_;
    std::vector<std::uint32_t> root_of_added_;
};

}  // namespace octetra::distributed
