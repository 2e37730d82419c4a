#include "comm/mpi_group.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <numeric>

namespace octetra::distributed {
namespace {

/// All duplicated communicators that this process belongs to.
struct Duplicates {
    std::mutex mutex;
    std::list<Duplicate> all;
    std::uint64_t last_number = 0;
};

/// Never destroyed, because static Communicators may outlive any static object.
Duplicates& duplicates() {
    static auto& kept = *new Duplicates;
    return kept;
}

bool is_idle(const Duplicate& duplicate, MPI_Comm original) {
    if (duplicate.is_used) return false;
    int result = MPI_UNEQUAL;
    MPI_Comm_compare(duplicate.comm, original, &result);
    return result == MPI_IDENT || result == MPI_CONGRUENT;
}

/// Numbers of duplicates, 0 in unused entries. Entry 0 is the number for a new duplicate.
using Offer = std::array<std::uint64_t, 16>;

/// Returns the duplicates that the first process proposes to reuse.
Offer make_offer(MPI_Comm original) {
    Duplicates& kept = duplicates();
    const std::lock_guard lock(kept.mutex);
    Offer offer{++kept.last_number};
    std::size_t next = 1;
    for (const Duplicate& duplicate : kept.all) {
        if (next < offer.size() && is_idle(duplicate, original)) offer[next++] = duplicate.number;
    }
    return offer;
}

}  // namespace

Communicator::Mpi::Mpi(MPI_Comm original) : fresh_(1) {
    MPI_Comm_rank(original, &rank);
    MPI_Comm_size(original, &size);
    every_rank.resize(static_cast<std::size_t>(size));
    std::iota(every_rank.begin(), every_rank.end(), 0);
    requests.reset(new MPI_Request[every_rank.size()]);
}

Communicator::Mpi::~Mpi() {
    if (duplicate_ == nullptr) return;
    const std::lock_guard lock(duplicates().mutex);
    duplicate_->is_used = false;
}

bool Communicator::Mpi::assign_duplicate(MPI_Comm original, Mpi* group) {
    Offer offer{};
    if (group != nullptr && group->rank == 0) offer = make_offer(original);
    MPI_Bcast(offer.data(), static_cast<int>(offer.size()), MPI_UINT64_T, 0, original);

    // Other threads may execute this with other communicators. Offered duplicates are therefore
    // reserved until all processes have stated which of them they can use.
    Duplicates& kept = duplicates();
    std::array<Duplicate*, std::tuple_size_v<Offer>> taken{};
    Offer is_taken{group != nullptr ? 1U : 0U};
    if (group != nullptr) {
        const std::lock_guard lock(kept.mutex);
        for (Duplicate& duplicate : kept.all) {
            const auto found = std::find(offer.begin() + 1, offer.end(), duplicate.number);
            if (found == offer.end() || !is_idle(duplicate, original)) continue;
            const auto index = static_cast<std::size_t>(found - offer.begin());
            duplicate.is_used = true;
            taken[index] = &duplicate;
            is_taken[index] = 1;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, is_taken.data(), static_cast<int>(is_taken.size()), MPI_UINT64_T,
                  MPI_MIN, original);
    const bool has_memory = is_taken[0] == 1;
    const auto agreed = std::find(is_taken.begin() + 1, is_taken.end(), 1U);
    const bool is_new = has_memory && agreed == is_taken.end();
    MPI_Comm comm = MPI_COMM_NULL;
    if (is_new) MPI_Comm_dup(original, &comm);

    const std::lock_guard lock(kept.mutex);
    for (std::size_t i = 1; i < taken.size(); ++i) {
        if (taken[i] == nullptr) continue;
        if (has_memory && agreed == is_taken.begin() + static_cast<std::ptrdiff_t>(i)) {
            group->duplicate_ = taken[i];
        } else {
            taken[i]->is_used = false;
        }
    }
    if (is_new) {
        group->fresh_.front() = {.comm = comm, .number = offer[0], .is_used = true};
        kept.all.splice(kept.all.end(), group->fresh_);
        group->duplicate_ = &kept.all.back();
    }
    if (has_memory) group->comm = group->duplicate_->comm;
    return has_memory;
}

}  // namespace octetra::distributed
