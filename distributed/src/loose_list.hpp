#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "at_vertices.hpp"
#include "huge_pages.hpp"

namespace octetra::distributed {

/// A list of the mesh (cells, listed facets or edges) while it changes in a few places only: the
/// first piece of what is bisected takes its place, the others go to the end, and a linked list
/// remembers the canonical order. The list and its lineage are the mesh's, and handed in. As long
/// as the list is loose, `lineage.first` names the first descendant of every root, not ranges.
///
/// Memory: 4 bytes per entity beside those of AtVertices, 8 for those that are added.
template <class I, std::size_t N>
class LooseList {
public:
    using Vertices = std::array<VertexIndex, N>;
    using List = IndexVector<I, Vertices>;

    LooseList(std::size_t vertex_count, const List& list)
        : at_vertices_(vertex_count, list), first_added_(list.size()) {
        reserve_with_room(next_, list.size());
        next_.resize(list.size());
        std::ranges::generate(next_, [next = std::size_t{0}]() mutable { return I{++next}; });
        if (!next_.empty()) next_.back() = I::none();
    }

    /// Calls found(i, e) for each entity of the list that has the edge, as its e-th one.
    void for_each_with(const EdgeVertices& edge, const List& list, auto&& found) const {
        at_vertices_.for_each_with(
            edge, [&](I i) -> const Vertices& { return list[i]; }, found);
    }
    void add_vertices(std::size_t count) { at_vertices_.add_vertices(count); }

    /// What follows in canonical order, or none().
    [[nodiscard]] I next(I i) const { return next_[i]; }
    /// The position of its root among this process's roots.
    [[nodiscard]] std::uint32_t root_of(I i, const Lineage& lineage) const {
        if (i >= first_added_) return root_of_added_[i.value() - first_added_.value()];
        const auto after = std::ranges::upper_bound(lineage.first, i.value());
        return static_cast<std::uint32_t>(after - lineage.first.begin()) - 1;
    }

    /// Calls visit(i, position of the root) for the entities begin .. end-1 as they stand in the
    /// list: sooner than by root_of().
    void for_each_root(I begin, I end, const Lineage& lineage, auto&& visit) const {
        if (begin == end) return;
        std::uint32_t root = root_of(begin, lineage);
        I i = begin;
        for (; i < std::min(end, first_added_); ++i) {
            while (lineage.first[root + 1] <= i.value()) ++root;
            visit(i, root);
        }
        for (; i < end; ++i) visit(i, root_of(i, lineage));
    }

    /// Puts pieces into the place of an entity of the list.
    void replace(I i, std::span<const Vertices> pieces, List& list, const Lineage& lineage) {
        const std::uint32_t root = root_of(i, lineage);
        at_vertices_.replace(i, list[i], pieces[0]);
        list[i] = pieces[0];
        I last = i;
        for (const Vertices& piece : pieces.subspan(1)) {
            at_vertices_.append(piece);
            list.push_back(piece);
            root_of_added_.push_back(root);
            const I added = next_.append(next_[last]);
            next_[last] = added;
            last = added;
        }
    }

    /// Brings the list into canonical order, and its lineage to ranges. The end of this object.
    void put_in_order(List& list, Lineage& lineage) && {
        at_vertices_ = AtVertices<I, N>(0, {});  // before the list is there twice
        if (list.end_index() == first_added_) return;
        List ordered;
        ordered.reserve(list.size());
        std::size_t root = 0;
        for (I i{0}; !i.is_none(); i = next_[i]) {
            if (root < lineage.roots.size() && lineage.first[root] == i.value()) {
                lineage.first[root++] = ordered.end_index().value();
            }
            ordered.push_back(list[i]);
        }
        lineage.first.back() = ordered.end_index().value();
        list = std::move(ordered);
    }

private:
    AtVertices<I, N> at_vertices_;
    IndexVector<I, I> next_;
    I first_added_;
    std::vector<std::uint32_t> root_of_added_;
};

}  // namespace octetra::distributed
