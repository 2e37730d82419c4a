#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/messages.hpp"

/// The NBX protocol of Hoefler, Siebert, Lumsdaine: Scalable communication protocols for dynamic
/// sparse data exchange (2010). A process sends its messages synchronously, receives incoming ones,
/// and enters a nonblocking barrier once all its sends have completed. When all processes have
/// entered the barrier, no message is in transit.
namespace octetra::distributed {
namespace {

/// A process may begin the next exchange while another has not left the barrier of this one, but
/// not the exchange after the next: two sets of tags distinguish them.
Tags tags_of_exchange(unsigned number) {
    const int first = number % 2 == 0 ? 4 : 7;
    return {.whole = first, .size = first + 1, .piece = first + 2};
}

class SparseExchange {
public:
    SparseExchange(const Communicator::Mpi& group, const Communication& communication)
        : group_(&group),
          communication_(&communication),
          tags_(tags_of_exchange(group.sparse_exchanges++)) {}

    /// Returns when this process has received everything that was sent to it.
    void run(Sending& sending, auto&& inbox_from) {
        while (!is_complete(sending)) {
            for (const int tag : {tags_.whole, tags_.size}) {
                while (auto arrived = arrived_with(tag)) {
                    const int sender = arrived->status.MPI_SOURCE;
                    receive_from(*group_, *arrived, tags_,
                                 [&](std::size_t size) { return inbox_from(sender, size); });
                }
            }
        }
    }
    /// `size` must live until the send completes.
    void send(Sending& sending, std::span<const std::byte> outbox, const std::uint64_t& size,
              int receiver) const {
        if (size <= max_message_bytes) {
            return sending.send_synchronously(outbox.data(), size, receiver, tags_.whole);
        }
        sending.send_synchronously(&size, sizeof size, receiver, tags_.size);
        send_pieces(sending, outbox, receiver, tags_.piece);
    }

private:
    [[nodiscard]] bool is_complete(Sending& sending) {
        if (!is_in_barrier_) {
            if (!sending.are_over()) return false;
            communication_->count_collective(0);
            MPI_Ibarrier(group_->comm, &barrier_);
            is_in_barrier_ = true;
        }
        int is_over = 0;
        MPI_Test(&barrier_, &is_over, MPI_STATUS_IGNORE);
        return is_over != 0;
    }
    [[nodiscard]] std::optional<Arrived> arrived_with(int tag) const {
        Arrived arrived;
        int has_message = 0;
        MPI_Improbe(MPI_ANY_SOURCE, tag, group_->comm, &has_message, &arrived.message,
                    &arrived.status);
        if (has_message == 0) return std::nullopt;
        return arrived;
    }

    const Communicator::Mpi* group_;
    const Communication* communication_;
    Tags tags_;
    MPI_Request barrier_ = MPI_REQUEST_NULL;
    bool is_in_barrier_ = false;
};

}  // namespace

void Communicator::exchange_sparsely(std::span<const std::span<const std::byte>> outboxes,
                                     Allocate allocate, void* context) const {
    std::exception_ptr failure;
    const auto inbox_from = [&](int sender, std::size_t size) -> std::byte* {
        try {
            return allocate(context, static_cast<std::size_t>(sender), size);
        } catch (...) {
            failure = std::current_exception();
            return nullptr;
        }
    };
    const auto own = static_cast<std::size_t>(rank());
    if (own < outboxes.size() && !outboxes[own].empty()) {
        std::byte* const inbox = inbox_from(rank(), outboxes[own].size());
        if (inbox != nullptr) std::ranges::copy(outboxes[own], inbox);
    }
    if (!mpi_) {
        if (failure) std::rethrow_exception(failure);
        return;
    }
    std::vector<MPI_Request> requests;
    std::vector<std::uint64_t> sizes;
    try {
        std::size_t count = 0;
        for (const auto& outbox : outboxes) count += outbox.empty() ? 0 : message_count(outbox);
        requests.resize(count);
        for (const auto& outbox : outboxes) sizes.push_back(outbox.size());
    } catch (...) {
        if (is_in_transaction()) throw;
        failure = std::current_exception();
        outboxes = {};
    }
    agree_on_success();
    const Communication communication(profile(), "exchange");
    SparseExchange exchange(*mpi_, communication);
    Sending sending(mpi_->comm, communication, requests);
    for (std::size_t r = 0; r < outboxes.size(); ++r) {
        if (r == own || outboxes[r].empty()) continue;
        exchange.send(sending, outboxes[r], sizes[r], static_cast<int>(r));
    }
    exchange.run(sending, inbox_from);
    if (failure) std::rethrow_exception(failure);
}

}  // namespace octetra::distributed
