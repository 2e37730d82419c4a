#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

/// Who else has what this process has of a distributed mesh: vertices, edges or faces.
namespace octetra::distributed {

/// What this process shares with another one. Both have the same entities listed in the same order,
/// each by its own numbers; and those that one of them owns, likewise.
template <class I>
struct SharedWith {
    int rank = 0;
    std::vector<I> entities;
    std::vector<I> owned;     ///< of these, this process's own
    std::vector<I> received;  ///< and the other one's own; the rest are a third one's

    friend bool operator==(const SharedWith&, const SharedWith&) = default;
};

/// Which entities of a kind other processes have, too: also those that they have in common with
/// this one at a single vertex or edge. Local numbers; nothing is asked of anybody at the time of
/// use.
///
/// Every entity has one owner among the processes that have it. Which one a hash of its global
/// number decides, so that all of them come to the same answer by themselves, and shared entities
/// are spread evenly.
template <class I>
class Sharing {
public:
    /// The other processes that have the entity, ascending; none if it is this one's alone.
    [[nodiscard]] std::span<const int> sharers(I i) const {
        const std::size_t k = place_of(i);
        if (k == shared_.size()) return {};
        return std::span(ranks_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
    }
    [[nodiscard]] int owner(I i) const {
        const std::size_t k = place_of(i);
        return k == shared_.size() ? rank_ : owners_[k];
    }
    [[nodiscard]] bool is_owned(I i) const { return owner(i) == rank_; }

    /// The processes that share something with this one, by rank, and what.
    [[nodiscard]] const std::vector<SharedWith<I>>& neighbours() const { return neighbours_; }
    /// The entities that are shared with any, ascending.
    [[nodiscard]] const std::vector<I>& shared() const { return shared_; }
    [[nodiscard]] int rank() const { return rank_; }

    friend bool operator==(const Sharing&, const Sharing&) = default;

private:
    template <class Entity>
    friend class SharingBuilder;

    [[nodiscard]] std::size_t place_of(I i) const {
        const auto found = std::ranges::lower_bound(shared_, i);
        if (found == shared_.end() || *found != i) return shared_.size();
        return static_cast<std::size_t>(found - shared_.begin());
    }

    int rank_ = 0;
    std::vector<I> shared_;
    std::vector<std::uint32_t> begin_{0};  ///< of the ranks of each shared entity, and the end
    std::vector<int> ranks_;
    std::vector<int> owners_;
    std::vector<SharedWith<I>> neighbours_;
};

}  // namespace octetra::distributed
