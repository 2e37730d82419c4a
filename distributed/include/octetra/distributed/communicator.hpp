#pragma once

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

/// What the distributed engine needs of MPI, in terms of vectors. Nothing here includes mpi.h.
namespace octetra::distributed {

class Profile;  // see octetra/distributed/profile.hpp

/// A group of processes that work on one mesh. Copies speak for the same group.
///
/// Collective functions are called by every process of the group, in the same order; those of
/// ProcessGroup are. A group of one process never calls MPI, so that a program runs without mpirun
/// and without MPI's start-up.
///
/// A process that has no memory for a message takes its part in the exchange all the same, and only
/// then throws std::bad_alloc: no other waits for it. All others must be told by whoever called;
/// see LocalFailure and all_or_none() in src/comm.
class Communicator final : public ProcessGroup {
public:
    /// This process alone.
    Communicator();

    [[nodiscard]] int rank() const override;
    [[nodiscard]] int size() const override;

    /// What measures this process's phases and messages, or null; copies share it.
    [[nodiscard]] Profile* profile() const { return profile_.get(); }
    [[nodiscard]] Communicator with_profile(std::shared_ptr<Profile> profile) const;

    // As ProcessGroup says, without sending to all what only a sum is wanted of.
    // Where one process has no memory for it, OutOfMemory is thrown on all.
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

    /// Collective. Each number becomes the sum of those at its place on all processes, which have
    /// equally many, fewer than 2^31. Needs no memory.
    void sum(std::span<std::uint64_t> numbers) const;
    /// Collective. The same with the greatest.
    void max(std::span<std::uint64_t> numbers) const;

    /// Collective. The maximum of one number from each process.
    [[nodiscard]] std::uint64_t max(std::uint64_t number) const;
    void max(std::floating_point auto number) const = delete;

    /// Collective. Runs `work`, in which nothing is collective, on every process. What it throws on
    /// one is thrown on all, when none waits any more, by the lowest rank's: OutOfMemory, an
    /// InputError as such, all else as SystemError.
    void on_each(const std::function<void()>& work) const;

    /// Collective. Every process gets the first one's values. Where one process has no memory for
    /// them, OutOfMemory is thrown on all.
    template <class T>
    void broadcast(std::vector<T>& values) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t size = broadcast_size(values.size());
        on_each([&] { values.resize(size); });
        broadcast_bytes(values.data(), values.size() * sizeof(T), 0);
    }

    /// Collective. The value that process `rank` has. Needs no memory.
    template <class T>
    [[nodiscard]] T of_rank(int rank, T value) const {
        static_assert(std::is_trivially_copyable_v<T>);
        broadcast_bytes(&value, sizeof value, rank);
        return value;
    }

    /// Collective. to_each[r] goes to rank r; the result's [r] came from rank r. Messages go only
    /// where there is something to send, and no process need know who has something for it.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> all_to_all(
        const std::vector<std::vector<T>>& to_each) const {
        static_assert(std::is_trivially_copyable_v<T>);
        ask_whether_all_work();
        std::vector<std::span<const std::byte>> bytes;
        std::vector<std::vector<T>> inboxes;
        try {
            bytes.reserve(to_each.size());
            for (const auto& outbox : to_each) bytes.push_back(std::as_bytes(std::span(outbox)));
            inboxes.resize(static_cast<std::size_t>(size()));
        } catch (...) {
            const auto nowhere = [](void*, std::size_t, std::size_t) -> std::byte* {
                return nullptr;
            };
            exchange_sparsely({}, nowhere, nullptr);
            throw;
        }
        exchange_sparsely(bytes, &allocate_inbox<T>, &inboxes);
        return inboxes;
    }

    /// Collective among neighbours. outboxes[i] goes to rank neighbours[i]; the result's [i] came
    /// from there. Who is whose neighbour must be mutual. One message to each, empty or not.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> exchange_with(
        std::span<const int> neighbours, const std::vector<std::vector<T>>& outboxes) const {
        return send_and_receive<T>(neighbours, outboxes, neighbours);
    }

    /// Between two processes: one sends to the other, which receives. Both wait until it is done.
    template <class T>
    void send(const std::vector<T>& values, int receiver) const {
        (void)send_and_receive<T>(std::span(&receiver, 1), std::span(&values, 1), {});
    }
    template <class T>
    [[nodiscard]] std::vector<T> receive(int sender) const {
        return std::move(send_and_receive<T>({}, {}, std::span(&sender, 1)).front());
    }

    /// Collective. The first process gets what each one has, by rank; the others get nothing.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> gather(const std::vector<T>& values) const {
        return send_and_receive<T>(every_rank().first(1), std::span(&values, 1), if_first());
    }

    /// Collective. Rank r gets to_each[r] of the first process.
    template <class T>
    [[nodiscard]] std::vector<T> scatter(const std::vector<std::vector<T>>& to_each) const {
        return std::move(send_and_receive<T>(if_first(), to_each, every_rank().first(1)).front());
    }

    class Watch;  // see all_or_none() in src/comm
    struct Mpi;   // wraps an MPI communicator; see octetra/distributed/mpi.hpp
    explicit Communicator(std::shared_ptr<const Mpi> mpi);
    [[nodiscard]] const Mpi* mpi() const { return mpi_.get(); }  ///< null: this process alone

private:
    using Allocate = std::byte* (*)(void* context, std::size_t i, std::size_t size);

    /// In inbox i of those that `context` points to.
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
    /// The first thing in every collective function.
    void ask_whether_all_work() const;
    [[nodiscard]] std::size_t broadcast_size(std::size_t size) const;
    void broadcast_bytes(void* data, std::size_t size, int root) const;
    /// outboxes[i] goes to rank receivers[i]; the result's [i] came from senders[i].
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> send_and_receive(
        std::span<const int> receivers, std::span<const std::vector<T>> outboxes,
        std::span<const int> senders) const {
        static_assert(std::is_trivially_copyable_v<T>);
        ask_whether_all_work();
        std::vector<std::span<const std::byte>> bytes;
        std::vector<std::vector<T>> inboxes;
        try {
            bytes.reserve(receivers.size());
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                bytes.push_back(std::as_bytes(std::span(outboxes[i])));
            }
            inboxes.resize(senders.size());
        } catch (...) {
            send_and_receive_nothing(receivers, senders);
            throw;
        }
        send_and_receive_bytes(receivers, bytes, senders, &allocate_inbox<T>, &inboxes);
        return inboxes;
    }
    /// Throws what allocate() throws, but only when all is sent and received.
    void send_and_receive_bytes(std::span<const int> receivers,
                                std::span<const std::span<const std::byte>> outboxes,
                                std::span<const int> senders, Allocate allocate,
                                void* context) const;
    /// outboxes[r] goes to rank r, unless it is empty; what has come from there goes to where
    /// allocate(context, r, size) says. Throws what allocate() throws, but only in the end.
    void exchange_sparsely(std::span<const std::span<const std::byte>> outboxes, Allocate allocate,
                           void* context) const;
    /// Everybody's number, and everybody's bytes, of which there are counts[r] from rank r, to
    /// places[r]: by rank. Need no memory.
    void gather_everywhere(std::uint64_t number, std::span<std::uint64_t> numbers) const;
    void gather_everywhere(std::span<const std::byte> bytes, std::span<const int> counts,
                           std::span<const int> places, std::span<std::byte> gathered) const;
    /// For a process that cannot do better: needs no memory.
    void send_and_receive_nothing(std::span<const int> receivers,
                                  std::span<const int> senders) const noexcept;

    std::shared_ptr<const Mpi> mpi_;  // none: this process alone
    std::shared_ptr<Profile> profile_;
};

/// Starts MPI if the program was started by mpirun, and ends it in the end.
class MpiSession {
public:
    MpiSession(int* argc, char*** argv);
    ~MpiSession();
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;
    MpiSession(MpiSession&&) = delete;
    MpiSession& operator=(MpiSession&&) = delete;

    /// All processes that mpirun started, or this one alone.
    [[nodiscard]] const Communicator& world() const { return world_; }

    /// For a failure that this process alone has met, before it calls abort(): may it say so? Of
    /// those on one machine that fail at the same time, the first one may; the others come back
    /// from here when that one has ended, if they live that long.
    [[nodiscard]] bool is_first_to_fail() const;

    /// Ends all processes at once with this exit status: for a failure that this one alone has met,
    /// while the others may be waiting for it.
    [[noreturn]] static void abort(int status);

private:
    Communicator world_;
    int lock_ = -1;
};

}  // namespace octetra::distributed
