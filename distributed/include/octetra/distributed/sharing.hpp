#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

/// Sharing of the vertices, edges or faces of a distributed mesh between processes.
namespace octetra::distributed {

/// The entities that this process shares with another one, by local number. Each of the three lists
/// has the same entities in the same order as the corresponding list of the other process.
template <class I>
struct SharedWith {
    int rank = 0;
    std::vector<I> entities;
    std::vector<I> owned;     ///< those that this process owns
    std::vector<I> received;  ///< those that the other process owns; third ones own the rest

    friend bool operator==(const SharedWith&, const SharedWith&) = default;
};

/// The entities of one kind that other processes have as well, including those that they share with
/// this process only at a single vertex or edge. Entities are local numbers. No function
/// communicates.
///
/// Every entity has one owner among its sharers, determined by a hash of its global number: so all
/// sharers agree on the owner without communication, and shared entities are distributed evenly.
template <class I>
class Sharing {
public:
    /// Returns the other ranks that have the entity, ascending; empty if only this process has it.
    [[nodiscard]] std::span<const int> sharers(I i) const {
        const std::size_t k = shared_index_of(i);
        if (k == shared_.size()) return {};
        return std::span(ranks_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
    }
    /// Returns the rank that owns the entity.
    [[nodiscard]] int owner(I i) const {
        const std::size_t k = shared_index_of(i);
        return k == shared_.size() ? rank_ : owners_[k];
    }
    /// Returns whether this process owns the entity.
    [[nodiscard]] bool is_owned(I i) const { return owner(i) == rank_; }

    /// The processes that share entities with this one, ascending by rank.
    [[nodiscard]] const std::vector<SharedWith<I>>& neighbours() const { return neighbours_; }
    /// The entities that are shared with any process, ascending.
    [[nodiscard]] const std::vector<I>& shared() const { return shared_; }
    /// The rank of this process.
    [[nodiscard]] int rank() const { return rank_; }

    friend bool operator==(const Sharing&, const Sharing&) = default;

private:
    template <class Entity>
    friend class SharingBuilder;

    [[nodiscard]] std::size_t shared_index_of(I i) const {
        const auto found = std::ranges::lower_bound(shared_, i);
        if (found == shared_.end() || *found != i) return shared_.size();
        return static_cast<std::size_t>(found - shared_.begin());
    }

    int rank_ = 0;
    std::vector<I> shared_;
    std::vector<std::uint32_t> begin_{0};  ///< offsets into ranks_, by shared entity
    std::vector<int> ranks_;
    std::vector<int> owners_;
    std::vector<SharedWith<I>> neighbours_;
};

}  // namespace octetra::distributed
