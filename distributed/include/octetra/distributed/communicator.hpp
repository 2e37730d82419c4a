#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/process_group.hpp>

/// The interface of the distributed engine to MPI, in terms of vectors. This header does not
/// include mpi.h.
namespace octetra::distributed {

class Profile;  // see octetra/distributed/profile.hpp

/// A group of processes that work on one mesh. Copies refer to the same group.
///
/// Collective functions, also those of ProcessGroup, must be called by every process of the group
/// in the same order. A group of one process never calls MPI, so that a program runs without mpirun
/// and without the cost of starting MPI.
///
/// Within transaction() every collective function begins with the agreement that no process has
/// failed. A process that cannot allocate memory for a message completes its part of the exchange
/// with empty messages before it throws std::bad_alloc, so that no other process waits for it.
class Communicator final : public ProcessGroup {
public:
    /// Creates the group of this process alone.
    Communicator();

    /// The rank of this process, from 0 to size() - 1. Not collective.
    [[nodiscard]] int rank() const override;
    /// The number of processes. Not collective.
    [[nodiscard]] int size() const override;

    /// The profile that records this process's phases and messages, or null. Copies share it.
    [[nodiscard]] Profile* profile() const { return profile_.get(); }
    /// Returns the same group with this profile, or without one if it is null. Not collective.
    [[nodiscard]] Communicator with_profile(std::shared_ptr<Profile> profile) const;

    // ProcessGroup's functions by collective operations of MPI: a sum does not gather the terms on
    // all processes. They throw OutOfMemory on all processes if one cannot allocate the result.
    [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> to_each) const override;
    [[nodiscard]] std::vector<Bytes> of_all(Bytes bytes) const override;
    using ProcessGroup::sum;
    [[nodiscard]] std::uint64_t sum(std::uint64_t number) const override;
    using ProcessGroup::sum_before;
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t number) const override;
    using ProcessGroup::of_first;
    [[nodiscard]] Bytes of_first(Bytes bytes) const override {
        broadcast(bytes);
        return bytes;
    }
    void check_same(std::string_view name, const std::string& value) const override;

    /// Collective. Replaces each number by the sum of the numbers at its position on all processes,
    /// which pass equally many, fewer than 2^31. Allocates nothing.
    void sum(std::span<std::uint64_t> numbers) const;
    /// Collective. The same with the maximum.
    void max(std::span<std::uint64_t> numbers) const;

    /// Collective. Returns the maximum of one number from each process.
    [[nodiscard]] std::uint64_t max(std::uint64_t number) const;
    void max(std::floating_point auto number) const = delete;

    /// Collective. Replaces the values on every process by those of the first process. Throws
    /// OutOfMemory on all processes if one cannot allocate them.
    template <class T>
    void broadcast(std::vector<T>& values) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t size = broadcast_size(values.size());
        transaction([&] { values.resize(size); });
        broadcast_bytes(values.data(), values.size() * sizeof(T), 0);
    }

    /// Collective. Returns the value that process `rank` passes. Allocates nothing.
    template <class T>
    [[nodiscard]] T of_rank(int rank, T value) const {
        static_assert(std::is_trivially_copyable_v<T>);
        broadcast_bytes(&value, sizeof value, rank);
        return value;
    }

    /// Collective. Sends to_each[r] to rank r; element r of the result was received from rank r.
    /// Only nonempty messages are sent, and no process needs to know which ranks send to it.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> all_to_all(
        const std::vector<std::vector<T>>& to_each) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<std::span<const std::byte>> bytes;
        std::vector<std::vector<T>> inboxes;
        try {
            bytes.reserve(to_each.size());
            for (const auto& outbox : to_each) bytes.push_back(std::as_bytes(std::span(outbox)));
            inboxes.resize(static_cast<std::size_t>(size()));
        } catch (...) {
            if (is_in_transaction()) throw;
            const auto nowhere = [](void*, std::size_t, std::size_t) -> std::byte* {
                return nullptr;
            };
            exchange_sparsely({}, nowhere, nullptr);
            throw;
        }
        exchange_sparsely(bytes, &allocate_inbox<T>, &inboxes);
        return inboxes;
    }

    /// Collective among neighbours. Sends outboxes[i] to rank neighbours[i]; element i of the
    /// result was received from there. The relation of neighbours must be symmetric. Exactly one
    /// message, possibly empty, is sent to each neighbour.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> exchange_with(
        std::span<const int> neighbours, const std::vector<std::vector<T>>& outboxes) const {
        return send_and_receive<T>(neighbours, outboxes, neighbours, Agreement::yes);
    }
    /// As exchange_with(), without an agreement of its own, because a collective function, max()
    /// for example, precedes it immediately. A process without memory sends empty messages.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> exchange_after_agreement(
        std::span<const int> neighbours, const std::vector<std::vector<T>>& outboxes) const {
        return send_and_receive<T>(neighbours, outboxes, neighbours, Agreement::no);
    }

    /// Point-to-point: one process sends and the other receives. Both block until the transfer is
    /// complete. Other processes are not involved, hence no agreement precedes it.
    template <class T>
    void send(const std::vector<T>& values, int receiver) const {
        (void)send_and_receive<T>(std::span(&receiver, 1), std::span(&values, 1), {},
                                  Agreement::no);
    }
    template <class T>
    [[nodiscard]] std::vector<T> receive(int sender) const {
        return std::move(send_and_receive<T>({}, {}, std::span(&sender, 1), Agreement::no).front());
    }

    /// Collective. Returns the values of each process, by rank, on the first process, and nothing
    /// on the others.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> gather(const std::vector<T>& values) const {
        return send_and_receive<T>(every_rank().first(1), std::span(&values, 1), if_first(),
                                   Agreement::yes);
    }

    /// Collective. Returns on rank r the vector to_each[r] of the first process.
    template <class T>
    [[nodiscard]] std::vector<T> scatter(const std::vector<std::vector<T>>& to_each) const {
        return std::move(
            send_and_receive<T>(if_first(), to_each, every_rank().first(1), Agreement::yes)
                .front());
    }

    /// Collective within a transaction, where every collective function begins with it; otherwise
    /// does nothing. Ends the work of the transaction if a process has failed.
    void agree_on_success() const;

    struct Mpi;  // wraps an MPI communicator; see octetra/distributed/mpi.hpp
    explicit Communicator(std::shared_ptr<const Mpi> mpi);
    [[nodiscard]] const Mpi* mpi() const { return mpi_.get(); }  ///< null: this process alone
    [[nodiscard]] bool is_in_transaction() const override;

private:
    using Allocate = std::byte* (*)(void* context, std::size_t i, std::size_t size);
    /// Whether agree_on_success() precedes the messages. Memory for sending is allocated before,
    /// so that after it every message is complete.
    enum class Agreement : std::uint8_t { no, yes };

    /// Allocates inbox i of the inboxes that `context` points to.
    template <class T>
    static std::byte* allocate_inbox(void* context, std::size_t i, std::size_t size) {
        std::vector<T>& inbox = (*static_cast<std::vector<std::vector<T>>*>(context))[i];
        inbox.resize(size / sizeof(T));
        return reinterpret_cast<std::byte*>(inbox.data());
    }
    [[nodiscard]] std::span<const int> every_rank() const;
    [[nodiscard]] std::span<const int> if_first() const {
        return is_first() ? every_rank() : std::span<const int>{};
    }
    void run_transaction(const std::function<void()>& work) const override;
    /// Collective within a transaction. The same reduction also returns the maxima of two numbers.
    [[nodiscard]] std::array<std::uint64_t, 2> agreed_max(
        std::array<std::uint64_t, 2> numbers) const;
    [[nodiscard]] std::size_t broadcast_size(std::size_t size) const;
    void broadcast_bytes(void* data, std::size_t size, int root) const;
    /// Sends outboxes[i] to rank receivers[i]; element i of the result was received from
    /// senders[i].
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> send_and_receive(
        std::span<const int> receivers, std::span<const std::vector<T>> outboxes,
        std::span<const int> senders, Agreement agreement) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<std::span<const std::byte>> bytes;
        std::vector<std::vector<T>> inboxes;
        try {
            bytes.reserve(receivers.size());
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                bytes.push_back(std::as_bytes(std::span(outboxes[i])));
            }
            inboxes.resize(senders.size());
        } catch (...) {
            if (agreement == Agreement::no || !is_in_transaction()) {
                exchange_empty_messages(receivers, senders);
            }
            throw;
        }
        send_and_receive_bytes(receivers, bytes, senders, agreement, &allocate_inbox<T>, &inboxes);
        return inboxes;
    }
    /// Throws what allocate() throws, once all messages are sent and received.
    void send_and_receive_bytes(std::span<const int> receivers,
                                std::span<const std::span<const std::byte>> outboxes,
                                std::span<const int> senders, Agreement agreement,
                                Allocate allocate, void* context) const;
    /// Sends outboxes[r] to rank r unless it is empty, and writes the message received from rank r
    /// to allocate(context, r, size). Throws what allocate() throws, once the exchange is complete.
    void exchange_sparsely(std::span<const std::span<const std::byte>> outboxes, Allocate allocate,
                           void* context) const;
    /// Gather the number, or the bytes, of every process on all processes, by rank: counts[r] bytes
    /// of rank r at offset offsets[r]. Allocate nothing.
    void gather_everywhere(std::uint64_t number, std::span<std::uint64_t> numbers) const;
    void gather_everywhere(std::span<const std::byte> bytes, std::span<const int> counts,
                           std::span<const int> offsets, std::span<std::byte> gathered) const;
    /// Completes send_and_receive_bytes() with empty messages after a failure. Allocates nothing.
    void exchange_empty_messages(std::span<const int> receivers,
                                 std::span<const int> senders) const noexcept;

    std::shared_ptr<const Mpi> mpi_;  // none: this process alone
    std::shared_ptr<Profile> profile_;
};

/// Initialises MPI if the program was started by mpirun or srun, and finalises it in the
/// destructor.
class MpiSession {
public:
    MpiSession(int* argc, char*** argv);
    ~MpiSession();
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;
    MpiSession(MpiSession&&) = delete;
    MpiSession& operator=(MpiSession&&) = delete;

    /// The communicator of all processes that mpirun started, or of this process alone.
    [[nodiscard]] const Communicator& world() const { return world_; }

    /// Returns whether this process is to report a failure that it alone has met; called before
    /// abort(). Among the processes of one machine that fail at the same time, the first gets true
    /// at once; the others block until the first one has ended, and get false.
    [[nodiscard]] bool is_first_to_fail() const;

    /// Ends all processes immediately with this exit status, after a failure that this process
    /// alone has met while others may be waiting for it.
    [[noreturn]] static void abort(int status);

private:
    Communicator world_;
    int lock_ = -1;
};

}  // namespace octetra::distributed
