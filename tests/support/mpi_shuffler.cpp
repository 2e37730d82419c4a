#include "support/mpi_shuffler.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

namespace octetra::test {
namespace {

/// A send that the program takes for started. Its buffer remains valid until the program has
/// waited.
struct HeldSend {
    const void* buffer;
    int count;
    MPI_Datatype type;
    int receiver;
    int tag;
    MPI_Comm comm;
    bool is_synchronous;
    std::uint64_t number;
};

class Shuffler {
public:
    void hold(HeldSend send) {
        send.number = counts_.held_back++;
        held_.push_back(send);
    }

    /// Releases one message: the oldest to a random receiver.
    void release_one() {
        if (held_.empty()) return;
        const int receiver = held_[random() % held_.size()].receiver;
        const auto send = std::ranges::find(held_, receiver, &HeldSend::receiver);
        const bool is_overtaken = send->number < last_released_;
        if (is_overtaken) ++counts_.overtaken;
        last_released_ = std::max(last_released_, send->number);
        (send->is_synchronous ? PMPI_Issend : PMPI_Isend)(send->buffer, send->count, send->type,
                                                          receiver, send->tag, send->comm,
                                                          &started_.emplace_back());
        held_.erase(send);
    }

    void finish_all() {
        while (!held_.empty()) {
            release_one();
            maybe_sleep();
        }
        PMPI_Waitall(static_cast<int>(started_.size()), started_.data(), MPI_STATUSES_IGNORE);
        started_.clear();
    }

    /// Releases one message. Returns whether none is held or incomplete.
    bool progress() {
        release_one();
        int are_complete = 0;
        PMPI_Testall(static_cast<int>(started_.size()), started_.data(), &are_complete,
                     MPI_STATUSES_IGNORE);
        if (are_complete != 0) started_.clear();
        return are_complete != 0 && held_.empty();
    }

    /// Usually returns at once; else sleeps up to 0.1 ms, rarely up to 1 ms.
    void maybe_sleep() {
        const auto draw = random() % 64;
        if (draw > 4) return;
        ++counts_.late_calls;
        const auto most = draw == 0 ? 1000U : 100U;
        std::this_thread::sleep_for(std::chrono::microseconds(random() % most));
    }

    std::uint64_t random() {
        if (!is_seeded_) {
            int rank = 0;
            PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
            std::seed_seq seeds{shuffle_seed(), static_cast<std::uint64_t>(rank)};
            random_.seed(seeds);
            is_seeded_ = true;
        }
        return random_();
    }

    [[nodiscard]] const ShuffleCounts& counts() const { return counts_; }

private:
    ShuffleCounts counts_;
    std::vector<HeldSend> held_;
    std::vector<MPI_Request> started_;
    std::uint64_t last_released_ = 0;
    bool is_seeded_ = false;
    std::mt19937_64 random_;
};

Shuffler& shuffler() {
    static Shuffler only;
    return only;
}

/// The possible senders of a message, in random order.
std::vector<int> candidates(int sender, MPI_Comm comm) {
    if (sender != MPI_ANY_SOURCE) return {sender};
    int size = 0;
    PMPI_Comm_size(comm, &size);
    std::vector<int> ranks(static_cast<std::size_t>(size));
    std::iota(ranks.begin(), ranks.end(), 0);
    for (std::size_t i = ranks.size(); i > 1; --i) {
        std::swap(ranks[i - 1], ranks[shuffler().random() % i]);
    }
    return ranks;
}

/// Completes all sends before a collective call, because other ranks may wait for them.
void complete_sends() {
    shuffler().maybe_sleep();
    shuffler().finish_all();
}

}  // namespace

ShuffleCounts shuffle_counts() { return shuffler().counts(); }

std::uint64_t shuffle_seed() {
    const char* const given = std::getenv("OCTETRA_SHUFFLE_SEED");
    return given == nullptr ? 1 : std::strtoull(given, nullptr, 10);
}

}  // namespace octetra::test

using octetra::test::shuffler;

int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
              MPI_Comm comm, MPI_Request* request) {
    shuffler().hold({buffer, count, type, receiver, tag, comm, false, 0});
    *request = MPI_REQUEST_NULL;  // MPI_Waitall is wrapped, too, and waits for all held sends
    return MPI_SUCCESS;
}

int MPI_Issend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
               MPI_Comm comm, MPI_Request* request) {
    shuffler().hold({buffer, count, type, receiver, tag, comm, true, 0});
    *request = MPI_REQUEST_NULL;  // as is MPI_Testall
    return MPI_SUCCESS;
}

int MPI_Improbe(int sender, int tag, MPI_Comm comm, int* has_arrived, MPI_Message* message,
                MPI_Status* status) {
    shuffler().maybe_sleep();
    for (const int candidate : octetra::test::candidates(sender, comm)) {
        PMPI_Improbe(candidate, tag, comm, has_arrived, message, status);
        if (*has_arrived != 0) break;
    }
    return MPI_SUCCESS;
}

int MPI_Mprobe(int sender, int tag, MPI_Comm comm, MPI_Message* message, MPI_Status* status) {
    while (true) {
        shuffler().maybe_sleep();
        for (const int candidate : octetra::test::candidates(sender, comm)) {
            int is_there = 0;
            PMPI_Improbe(candidate, tag, comm, &is_there, message, status);
            if (is_there != 0) return MPI_SUCCESS;
        }
        shuffler().release_one();
        std::this_thread::yield();
    }
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
    shuffler().finish_all();
    return PMPI_Waitall(count, requests, statuses);
}

int MPI_Testall(int count, MPI_Request* requests, int* are_complete, MPI_Status* statuses) {
    shuffler().maybe_sleep();
    if (!shuffler().progress()) {
        *are_complete = 0;
        return MPI_SUCCESS;
    }
    return PMPI_Testall(count, requests, are_complete, statuses);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
    octetra::test::complete_sends();
    return PMPI_Ibarrier(comm, request);
}

int MPI_Test(MPI_Request* request, int* is_over, MPI_Status* status) {
    shuffler().maybe_sleep();
    return PMPI_Test(request, is_over, status);
}

int MPI_Allreduce(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
    octetra::test::complete_sends();
    return PMPI_Allreduce(mine, result, count, type, operation, comm);
}

int MPI_Exscan(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
    octetra::test::complete_sends();
    return PMPI_Exscan(mine, result, count, type, operation, comm);
}

int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    octetra::test::complete_sends();
    return PMPI_Bcast(buffer, count, type, root, comm);
}
