#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Returns the owner among the `ranks` that have an entity: a hash of its global number selects it.
/// `ranks` is ascending and includes this rank.
[[nodiscard]] inline int owner_of(std::uint64_t number, std::span<const int> ranks) {
    std::uint64_t h = number + 0x9e3779b97f4a7c15U;  // splitmix64
    h = (h ^ h >> 30U) * 0xbf58476d1ce4e5b9U;
    h = (h ^ h >> 27U) * 0x94d049bb133111ebU;
    return ranks[(h ^ h >> 31U) % ranks.size()];
}

/// Adds entities to a Sharing in two phases: prepare() may throw and changes nothing, commit()
/// cannot fail.
template <class I>
class SharingBuilder {
public:
    SharingBuilder(Sharing<I>& sharing, int rank) : sharing_(&sharing) { sharing.rank_ = rank; }

    /// Adds entities shared with `rank`, in an order that both ranks know. At most one call for
    /// each rank.
    void share(int rank, std::vector<I> entities) {
        if (!entities.empty()) added_.push_back({rank, std::move(entities), {}, {}});
    }

    /// Computes owners and reserves memory, after the last share(). All added entities have greater
    /// local indices than those already in the Sharing; number_of(i) is the global number.
    void prepare(auto&& number_of) {
        struct Entry {
            I entity;
            int rank;
        };
        std::vector<Entry> entries;
        for (const SharedWith<I>& with : added_) {
            for (const I i : with.entities) entries.push_back({i, with.rank});
        }
        std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.entity, e.rank); });
        std::vector<int> ranks;
        for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
            const I entity = entries[begin].entity;
            ranks.assign(1, sharing_->rank_);
            for (; end < entries.size() && entries[end].entity == entity; ++end) {
                ranks_.push_back(entries[end].rank);
                ranks.push_back(entries[end].rank);
            }
            std::ranges::sort(ranks);
            shared_.push_back(entity);
            ends_.push_back(static_cast<std::uint32_t>(sharing_->ranks_.size() + ranks_.size()));
            owners_.push_back(owner_of(number_of(entity), ranks));
        }
        for (SharedWith<I>& with : added_) {
            for (const I i : with.entities) {
                const int owner = owner_of_added(i);
                if (owner == sharing_->rank_) with.owned.push_back(i);
                if (owner == with.rank) with.received.push_back(i);
            }
        }
        make_room_for_all();
    }

    void commit() noexcept {
        const auto append = [](auto& list, const auto& added) {
            list.insert(list.end(), added.begin(), added.end());
        };
        append(sharing_->shared_, shared_);
        append(sharing_->begin_, ends_);
        append(sharing_->ranks_, ranks_);
        append(sharing_->owners_, owners_);
        for (SharedWith<I>& with : added_) {
            const auto there = neighbour(with.rank);
            if (there == sharing_->neighbours_.end() || there->rank != with.rank) {
                sharing_->neighbours_.insert(there, std::move(with));
            } else {
                append(there->entities, with.entities);
                append(there->owned, with.owned);
                append(there->received, with.received);
            }
        }
    }

private:
    [[nodiscard]] int owner_of_added(I i) const {
        return owners_[static_cast<std::size_t>(std::ranges::lower_bound(shared_, i) -
                                                shared_.begin())];
    }
    [[nodiscard]] auto neighbour(int rank) {
        return std::ranges::lower_bound(sharing_->neighbours_, rank, {}, &SharedWith<I>::rank);
    }
    void make_room_for_all() {
        make_room(sharing_->shared_, sharing_->shared_.size() + shared_.size());
        make_room(sharing_->begin_, sharing_->begin_.size() + ends_.size());
        make_room(sharing_->ranks_, sharing_->ranks_.size() + ranks_.size());
        make_room(sharing_->owners_, sharing_->owners_.size() + owners_.size());
        make_room(sharing_->neighbours_, sharing_->neighbours_.size() + added_.size());
        const auto make_room_for = [](auto& list, const auto& added) {
            make_room(list, list.size() + added.size());
        };
        for (const SharedWith<I>& with : added_) {
            const auto there = neighbour(with.rank);
            if (there == sharing_->neighbours_.end() || there->rank != with.rank) continue;
            make_room_for(there->entities, with.entities);
            make_room_for(there->owned, with.owned);
            make_room_for(there->received, with.received);
        }
    }

    Sharing<I>* sharing_;
    std::vector<SharedWith<I>> added_;
    std::vector<I> shared_;
    std::vector<std::uint32_t> ends_;
    std::vector<int> ranks_;
    std::vector<int> owners_;
};

}  // namespace octetra::distributed
