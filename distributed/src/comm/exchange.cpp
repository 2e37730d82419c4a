#include <algorithm>
#include <exception>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/messages.hpp"

namespace octetra::distributed {
namespace {

constexpr Tags exchange_tags{.whole = 1, .size = 2, .piece = 3};

/// `size` must live until the send completes.
void send_all(Sending& sending, std::span<const std::byte> outbox, const std::uint64_t& size,
              int receiver) {
    if (size <= max_message_bytes) {
        return sending.send(outbox.data(), size, receiver, exchange_tags.whole);
    }
    sending.send(&size, sizeof size, receiver, exchange_tags.size);
    send_pieces(sending, outbox, receiver, exchange_tags.piece);
}

/// Messages of one sender arrive in the order in which they were sent, so the next one is the first
/// of this exchange, whatever its tag.
void receive_all(const Communicator::Mpi& group, int sender, auto&& allocate) {
    receive_from(group, wait_for_message(group.comm, sender, MPI_ANY_TAG), exchange_tags, allocate);
}

}  // namespace

void Communicator::send_and_receive_bytes(std::span<const int> receivers,
                                          std::span<const std::span<const std::byte>> outboxes,
                                          std::span<const int> senders, Agreement agreement,
                                          Allocate allocate, void* context) const {
    std::vector<MPI_Request> requests;
    std::vector<std::uint64_t> sizes;
    try {
        std::size_t count = 0;
        for (const auto& outbox : outboxes) count += message_count(outbox);
        requests.resize(count);
        for (const auto& outbox : outboxes) sizes.push_back(outbox.size());
    } catch (...) {
        if (agreement == Agreement::no || !is_in_transaction()) {
            exchange_empty_messages(receivers, senders);
        }
        throw;
    }
    if (agreement == Agreement::yes) agree_on_success();
    const Communication communication(mpi_ ? profile() : nullptr, "exchange");
    Sending sending(mpi_ ? mpi_->comm : MPI_COMM_NULL, communication, requests);
    std::span<const std::byte> to_itself;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        if (receivers[i] == rank()) {
            to_itself = outboxes[i];
        } else {
            send_all(sending, outboxes[i], sizes[i], receivers[i]);
        }
    }
    std::exception_ptr failure;
    for (std::size_t i = 0; i < senders.size(); ++i) {
        const auto inbox_of_size = [&](std::size_t size) -> std::byte* {
            try {
                return allocate(context, i, size);
            } catch (...) {
                failure = std::current_exception();
                return nullptr;
            }
        };
        if (senders[i] != rank()) {
            receive_all(*mpi_, senders[i], inbox_of_size);
        } else if (std::byte* const inbox = inbox_of_size(to_itself.size()); inbox != nullptr) {
            std::ranges::copy(to_itself, inbox);
        }
    }
    sending.wait();
    if (failure) std::rethrow_exception(failure);
}

void Communicator::exchange_empty_messages(std::span<const int> receivers,
                                           std::span<const int> senders) const noexcept {
    if (!mpi_) return;
    const Communication communication(profile(), "exchange");
    Sending sending(mpi_->comm, communication, {mpi_->requests.get(), mpi_->every_rank.size()});
    for (const int receiver : receivers) {
        if (receiver != rank()) sending.send(nullptr, 0, receiver, exchange_tags.whole);
    }
    for (const int sender : senders) {
        if (sender == rank()) continue;
        receive_all(*mpi_, sender, [](std::size_t) -> std::byte* { return nullptr; });
    }
    sending.wait();
}

}  // namespace octetra::distributed
