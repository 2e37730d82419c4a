#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/huge_pages.hpp"
#include "level/incremental/incidence.hpp"

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
    void add_vertices(std::size_t count) { incidence_.add_vertices(count); }

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

    /// Brings the list into canonical order, and its ancestors to ranges. The end of this object.
    void restore_canonical_order(List& list, AncestorMap& ancestors) && {
        incidence_ = Incidence<I, N>(0, {});  // before the list is there twice
        if (list.end_index() == first_added_) return;
        List ordered;
        ordered.reserve(list.size());
        std::size_t root = 0;
        for (I i{0}; !i.is_none(); i = next_[i]) {
            if (root < ancestors.roots.size() && ancestors.first[root] == i.value()) {
                ancestors.first[root++] = ordered.end_index().value();
            }
            ordered.push_back(list[i]);
        }
        ancestors.first.back() = ordered.end_index().value();
        list = std::move(ordered);
    }

private:
    Incidence<I, N> incidence_;
    IndexVector<I, I> next_;
    I first_added_;
    std::vector<std::uint32_t> root_of_added_;
};

}  // namespace octetra::distributed
