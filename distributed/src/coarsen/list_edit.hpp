#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/entity_transfer.hpp>

#include "coarsen/coarser_list.hpp"
#include "level/incremental/unordered_list.hpp"

namespace octetra::distributed {

/// The edit of an unordered list (of cells, tagged facets or edges) by the removal of vertices:
/// processes the descendants of the roots that lose a vertex in canonical order, and does not
/// access the rest of the list. Planning may fail and changes nothing; commit() performs the edit.
template <class I, std::size_t N>
class ListEdit {
public:
    using Vertices = std::array<VertexIndex, N>;
    using List = IndexVector<I, Vertices>;
    using Unordered = UnorderedList<I, N>;

    ListEdit(const List& list, const Unordered& unordered, const AncestorMap& ancestors)
        : list_(&list), unordered_(&unordered), ancestors_(&ancestors), count_after_(list.size()) {}

    /// Finds the descendants of roots that have one of the vertices. Returns false as soon as they
    /// are more than `most`: a pass over the whole list is then faster.
    [[nodiscard]] bool find(std::span<const VertexIndex> removed, std::size_t most) {
        std::vector<bool> is_found(ancestors_->roots.size(), false);
        std::size_t count = 0;
        for (const VertexIndex v : removed) {
            unordered_->for_each_at(v, [&](I i) {
                const std::uint32_t root = unordered_->root_of(i);
                if (is_found[root]) return;
                is_found[root] = true;
                roots_.push_back(root);
                for_each_descendant(root, [&](I) { ++count; });
            });
            if (count > most) return false;
        }
        std::ranges::sort(roots_);
        before_.reserve(count);
        for (const std::uint32_t root : roots_) {
            for_each_descendant(root, [&](I i) { before_.push_back(i); });
        }
        return true;
    }

    /// For `divide` see ListCoarsening.
    void plan(const VertexLevels& levels, const LevelRemovals& removals, const KeptVertices& kept,
              auto&& divide) {
        List descendants;
        descendants.reserve(before_.size());
        for (const I i : before_) descendants.push_back((*list_)[i]);
        result_ = ListCoarsening<I, N>(levels, removals, kept)
                      .run(descendants, [&](std::uint32_t level, std::size_t root,
                                            const Vertices& parent, const auto& midpoints) {
                          return divide(level, roots_[root], parent, midpoints);
                      });
        assign_numbers();
        plan_moves();
    }

    [[nodiscard]] EntityTransfer entity_transfer() const {
        std::vector<std::uint32_t> coarse_of;
        reserve_in_huge_pages(coarse_of, list_->size());
        coarse_of.resize(list_->size());
        std::vector<std::uint8_t> halvings;
        reserve_in_huge_pages(halvings, list_->size());
        halvings.resize(list_->size());
        std::iota(coarse_of.begin(), coarse_of.end(), 0U);
        const auto moved = [&](I i) {
            return i.value() < count_after_ ? i : moved_[i.value() - count_after_];
        };
        for (std::size_t i = count_after_; i < coarse_of.size(); ++i) {
            coarse_of[i] = moved(I{i}).value();  // removed entries, none() here, are set below
        }
        for (std::size_t k = 0; k < before_.size(); ++k) {
            coarse_of[before_[k].value()] = moved(numbers_[result_.coarse_of[k]]).value();
            halvings[before_[k].value()] = result_.halvings[k];
        }
        return EntityTransfer::of_merges(count_after_, std::move(coarse_of), std::move(halvings));
    }

    /// The arguments must be those that the edit was planned for. Afterwards entities have their
    /// previous vertices, by the old numbers.
    void commit(List& list, Unordered& unordered, AncestorMap& ancestors) noexcept {
        for (std::size_t k = 0; k < result_.list.size(); ++k) {
            const I assigned = numbers_[k];
            if (list[assigned] != result_.list[I{k}])
                unordered.change(assigned, result_.list[I{k}], list);
        }
        for (const I i : removed_) unordered.remove(i, list);
        for (std::size_t r = 0; r < roots_.size(); ++r) {
            const std::span<const I> all = numbers_;
            unordered.set_order(
                roots_[r], all.subspan(result_.first[r], result_.first[r + 1] - result_.first[r]),
                ancestors);
        }
        for (const auto& [from, to] : moves_) unordered.move(from, to, list, ancestors);
        unordered.truncate(count_after_, list);
    }

    /// Calls visit(i) for each number that denotes a different entity after the edit.
    void for_each_changed(auto&& visit) const {
        for (std::size_t k = 0; k < before_.size(); ++k) {
            const I assigned = numbers_[result_.coarse_of[k]];
            if (result_.halvings[k] > 0 && assigned.value() < count_after_) visit(assigned);
        }
        for (const auto& [from, to] : moves_) visit(to);
    }

private:
    void for_each_descendant(std::uint32_t root, auto&& visit) const {
        for (I i{ancestors_->first[root]}; !i.is_none(); i = unordered_->next(i)) visit(i);
    }

    /// Assigns to a coarse entity the number of the first entity merged into it; the other numbers
    /// become free.
    void assign_numbers() {
        numbers_.assign(result_.list.size(), I::none());
        for (std::size_t k = 0; k < before_.size(); ++k) {
            I& assigned = numbers_[result_.coarse_of[k]];
            if (assigned.is_none()) {
                assigned = before_[k];
            } else {
                removed_.push_back(before_[k]);
            }
        }
    }
    /// Plans to move the last entities of the list to the free numbers.
    void plan_moves() {
        std::ranges::sort(removed_);
        count_after_ = list_->size() - removed_.size();
        moved_.assign(removed_.size(), I{0});
        const auto beyond = std::ranges::lower_bound(removed_, I{count_after_});
        for (auto i = beyond; i != removed_.end(); ++i) {
            moved_[i->value() - count_after_] = I::none();
        }
        auto hole = removed_.begin();
        for (std::size_t k = 0; k < moved_.size(); ++k) {
            if (moved_[k].is_none()) continue;
            moved_[k] = *hole++;
            moves_.push_back({I{count_after_ + k}, moved_[k]});
        }
    }

    const List* list_;
    const Unordered* unordered_;
    const AncestorMap* ancestors_;
    std::vector<std::uint32_t> roots_;  ///< that lose a vertex, ascending
    std::vector<I> before_;             ///< their descendants, in canonical order
    CoarserList<I, N> result_;          ///< the new list for these descendants
    std::vector<I> numbers_;            ///< of each in result_, the number before moves
    std::vector<I> removed_;
    std::size_t count_after_;
    std::vector<I> moved_;  ///< the new numbers of entities from count_after_ on, or none()
    struct Move {
        I from;
        I to;
    };
    std::vector<Move> moves_;
};

}  // namespace octetra::distributed
