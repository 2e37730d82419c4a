#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "comm/mpi_group.hpp"
#include "profile/recorder.hpp"

namespace octetra::distributed {

/// Tags of the messages that together transfer one outbox.
struct Tags {
    int whole;  ///< the whole outbox, if it has at most max_message_bytes
    int size;   ///< otherwise first its size in bytes
    int piece;  ///< and then its bytes in messages of max_message_bytes; the last one has the rest
};

/// Returns the number of messages that transfer an outbox.
inline std::size_t message_count(std::span<const std::byte> outbox) {
    if (outbox.size() <= max_message_bytes) return 1;
    return 1 + (outbox.size() + max_message_bytes - 1) / max_message_bytes;
}

/// The pending sends of this process; the caller provides memory for their requests.
class Sending {
public:
    Sending(MPI_Comm comm, const Communication& communication, std::span<MPI_Request> room)
        : comm_(comm), communication_(&communication), room_(room) {}

    void send(const void* data, std::size_t size, int receiver, int tag) {
        communication_->count_message(size);
        MPI_Isend(data, static_cast<int>(size), MPI_BYTE, receiver, tag, comm_, &room_[count_++]);
    }
    /// The send completes only after the receiver has begun to receive.
    void send_synchronously(const void* data, std::size_t size, int receiver, int tag) {
        communication_->count_message(size);
        MPI_Issend(data, static_cast<int>(size), MPI_BYTE, receiver, tag, comm_, &room_[count_++]);
    }
    void wait() {
        if (count_ == 0) return;
        MPI_Waitall(static_cast<int>(count_), room_.data(), MPI_STATUSES_IGNORE);
    }
    [[nodiscard]] bool are_over() {
        int is_over = 0;
        MPI_Testall(static_cast<int>(count_), room_.data(), &is_over, MPI_STATUSES_IGNORE);
        return is_over != 0;
    }

private:
    MPI_Comm comm_;
    const Communication* communication_;
    std::span<MPI_Request> room_;
    std::size_t count_ = 0;
};

inline void send_pieces(Sending& sending, std::span<const std::byte> outbox, int receiver,
                        int tag) {
    for (std::size_t begin = 0; begin < outbox.size(); begin += max_message_bytes) {
        const std::size_t size = std::min(outbox.size() - begin, max_message_bytes);
        sending.send(outbox.data() + begin, size, receiver, tag);
    }
}

/// A message that was matched by a probe and has not been received.
struct Arrived {
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;

    [[nodiscard]] std::size_t size() const {
        int count = 0;
        MPI_Get_count(&status, MPI_BYTE, &count);
        return static_cast<std::size_t>(count);
    }
    void receive(void* place) {
        MPI_Mrecv(place, static_cast<int>(size()), MPI_BYTE, &message, MPI_STATUS_IGNORE);
    }
};

inline Arrived wait_for_message(MPI_Comm comm, int sender, int tag) {
    Arrived arrived;
    MPI_Mprobe(sender, tag, comm, &arrived.message, &arrived.status);
    return arrived;
}

/// Receives the transfer that begins with `first` into the buffer that allocate(size) returns, or
/// discards it if that is null.
inline void receive_from(const Communicator::Mpi& group, Arrived first, const Tags& tags,
                         auto&& allocate) {
    const auto place = [&](std::byte* inbox) {
        return inbox == nullptr ? group.discard_buffer.get() : inbox;
    };
    if (first.status.MPI_TAG == tags.whole) return first.receive(place(allocate(first.size())));
    std::uint64_t size = 0;
    first.receive(&size);
    std::byte* const inbox = allocate(size);
    for (std::size_t begin = 0; begin < size; begin += max_message_bytes) {
        wait_for_message(group.comm, first.status.MPI_SOURCE, tags.piece)
            .receive(place(inbox == nullptr ? nullptr : inbox + begin));
    }
}

}  // namespace octetra::distributed
