#include <octetra/distributed/communicator.hpp>

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <memory>
#include <numeric>

#include <octetra/distributed/mpi.hpp>

#include "comm/all_or_none.hpp"
#include "comm/common_lock.hpp"
#include "profile/recorder.hpp"

namespace octetra::distributed {

namespace {

/// The most bytes of one MPI message. What a process has no memory for it receives into a buffer of
/// this size, piece by piece.
constexpr std::size_t most_bytes = std::size_t{1} << 20U;

}  // namespace

struct Communicator::Mpi {
    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0;
    int size = 1;
    std::vector<int> every_rank;
    // For a process that has no memory at the time: what it throws away, and its empty messages.
    std::unique_ptr<std::byte[]> unwanted{new std::byte[most_bytes]};
    std::unique_ptr<MPI_Request[]> requests;
    mutable bool is_watched = false;  ///< by Watch, on all processes

    explicit Mpi(MPI_Comm original) {
        MPI_Comm_dup(original, &comm);
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
        every_rank.resize(static_cast<std::size_t>(size));
        std::iota(every_rank.begin(), every_rank.end(), 0);
        requests.reset(new MPI_Request[every_rank.size()]);
    }
    ~Mpi() {
        int finalized = 0;
        MPI_Finalized(&finalized);
        if (finalized == 0) MPI_Comm_free(&comm);
    }
    Mpi(const Mpi&) = delete;
    Mpi& operator=(const Mpi&) = delete;
    Mpi(Mpi&&) = delete;
    Mpi& operator=(Mpi&&) = delete;
};

namespace {

constexpr int exchange_tag = 1;
constexpr int size_tag = 2;  ///< of a message that tells how many bytes the next ones bring

void reduce(std::span<std::uint64_t> numbers, MPI_Op operation, MPI_Comm comm, Profile* profile) {
    const Communication communication(profile, "reduction");
    communication.count_collective(numbers.size_bytes());
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T,
                  operation, comm);
}

std::uint64_t reduced(std::uint64_t number, MPI_Op operation, MPI_Comm comm, Profile* profile) {
    reduce(std::span(&number, 1), operation, comm, profile);
    return number;
}

}  // namespace

Communicator::Communicator() = default;
Communicator::Communicator(std::shared_ptr<const Mpi> mpi)
    : mpi_(mpi->size == 1 ? nullptr : std::move(mpi)) {}

int Communicator::rank() const { return mpi_ ? mpi_->rank : 0; }
int Communicator::size() const { return mpi_ ? mpi_->size : 1; }

Communicator Communicator::with_profile(std::shared_ptr<Profile> profile) const {
    Communicator same = *this;
    same.profile_ = std::move(profile);
    return same;
}

Communicator::Watch::Watch(const Communicator& processes) : processes_(&processes) {
    if (processes.mpi_) processes.mpi_->is_watched = true;
}

Communicator::Watch::~Watch() {
    if (processes_->mpi_) processes_->mpi_->is_watched = false;
}

void Communicator::Watch::answer(bool has_failed) const noexcept {
    if (!processes_->mpi_) return;
    // Not measured, which may take memory.
    (void)reduced(has_failed ? 1 : 0, MPI_MAX, processes_->mpi_->comm, nullptr);
}

void Communicator::ask_whether_all_work() const {
    if (!mpi_ || !mpi_->is_watched) return;
    if (reduced(0, MPI_MAX, mpi_->comm, profile()) != 0) throw OthersFailed();
}

std::uint64_t Communicator::sum(std::uint64_t number) const {
    ask_whether_all_work();
    return mpi_ ? reduced(number, MPI_SUM, mpi_->comm, profile()) : number;
}

void Communicator::sum(std::span<std::uint64_t> numbers) const {
    ask_whether_all_work();
    if (mpi_) reduce(numbers, MPI_SUM, mpi_->comm, profile());
}

void Communicator::max(std::span<std::uint64_t> numbers) const {
    ask_whether_all_work();
    if (mpi_) reduce(numbers, MPI_MAX, mpi_->comm, profile());
}

std::uint64_t Communicator::max(std::uint64_t number) const {
    ask_whether_all_work();
    return mpi_ ? reduced(number, MPI_MAX, mpi_->comm, profile()) : number;
}

std::uint64_t Communicator::sum_before(std::uint64_t number) const {
    ask_whether_all_work();
    if (!mpi_) return 0;
    const Communication communication(profile(), "reduction");
    communication.count_collective(sizeof number);
    std::uint64_t sum = 0;
    MPI_Exscan(&number, &sum, 1, MPI_UINT64_T, MPI_SUM, mpi_->comm);
    return mpi_->rank == 0 ? 0 : sum;
}

std::span<const int> Communicator::every_rank() const {
    static constexpr std::array<int, 1> alone{0};
    return mpi_ ? std::span<const int>(mpi_->every_rank) : std::span<const int>(alone);
}

std::size_t Communicator::broadcast_size(std::size_t size) const {
    ask_whether_all_work();
    if (!mpi_) return size;
    const Communication communication(profile(), "broadcast");
    std::uint64_t number = size;
    communication.count_collective(sizeof number);
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, mpi_->comm);
    return number;
}

void Communicator::broadcast_bytes(void* data, std::size_t size, int root) const {
    ask_whether_all_work();
    if (!mpi_) return;
    constexpr std::size_t most = std::size_t{1} << 30U;  // MPI's counts are ints
    const Communication communication(profile(), "broadcast");
    for (std::size_t offset = 0; offset < size; offset += most) {
        const std::size_t count = std::min(size - offset, most);
        communication.count_collective(count);
        MPI_Bcast(static_cast<std::byte*>(data) + offset, static_cast<int>(count), MPI_BYTE, root,
                  mpi_->comm);
    }
}

namespace {

/// The requests of sends under way, for which there is room from the beginning.
class Sending {
public:
    Sending(MPI_Comm comm, const Communication& communication, std::span<MPI_Request> room)
        : comm_(comm), communication_(&communication), room_(room) {}

    void send(const void* data, std::size_t size, int receiver, int tag) {
        communication_->count_message(size);
        MPI_Isend(data, static_cast<int>(size), MPI_BYTE, receiver, tag, comm_, &room_[count_++]);
    }
    void wait() {
        if (count_ == 0) return;
        MPI_Waitall(static_cast<int>(count_), room_.data(), MPI_STATUSES_IGNORE);
    }

private:
    MPI_Comm comm_;
    const Communication* communication_;
    std::span<MPI_Request> room_;
    std::size_t count_ = 0;
};

/// How many messages it takes: one, or one that tells the size and then pieces of most_bytes.
std::size_t message_count(std::span<const std::byte> outbox) {
    if (outbox.size() <= most_bytes) return 1;
    return 1 + (outbox.size() + most_bytes - 1) / most_bytes;
}

/// `size` lives until sending is over.
void send_all(Sending& sending, std::span<const std::byte> outbox, const std::uint64_t& size,
              int receiver) {
    if (size <= most_bytes) return sending.send(outbox.data(), size, receiver, exchange_tag);
    sending.send(&size, sizeof size, receiver, size_tag);
    for (std::size_t begin = 0; begin < size; begin += most_bytes) {
        sending.send(outbox.data() + begin, std::min(size - begin, most_bytes), receiver,
                     exchange_tag);
    }
}

/// A message that has come and is yet to be received.
struct Arrived {
    MPI_Message message = MPI_MESSAGE_NULL;
    std::size_t size = 0;
    int tag = 0;

    Arrived(MPI_Comm comm, int sender) {
        MPI_Status status;
        int count = 0;
        MPI_Mprobe(sender, MPI_ANY_TAG, comm, &message, &status);
        MPI_Get_count(&status, MPI_BYTE, &count);
        size = static_cast<std::size_t>(count);
        tag = status.MPI_TAG;
    }
    void receive(void* place) {
        MPI_Mrecv(place, static_cast<int>(size), MPI_BYTE, &message, MPI_STATUS_IGNORE);
    }
};

/// Receives what send_all() sends to where allocate(size) says, or nowhere where that is null.
void receive_all(MPI_Comm comm, int sender, std::byte* unwanted, auto&& allocate) {
    Arrived first(comm, sender);
    if (first.tag == exchange_tag) {
        std::byte* const inbox = allocate(first.size);
        return first.receive(inbox == nullptr ? unwanted : inbox);
    }
    std::uint64_t size = 0;
    first.receive(&size);
    std::byte* const inbox = allocate(size);
    for (std::size_t begin = 0; begin < size; begin += most_bytes) {
        Arrived(comm, sender).receive(inbox == nullptr ? unwanted : inbox + begin);
    }
}

}  // namespace

void Communicator::send_and_receive_bytes(std::span<const int> receivers,
                                          std::span<const std::span<const std::byte>> outboxes,
                                          std::span<const int> senders, Allocate allocate,
                                          void* context) const {
    std::vector<MPI_Request> requests;
    std::vector<std::uint64_t> sizes;
    try {
        std::size_t count = 0;
        for (const auto& outbox : outboxes) count += message_count(outbox);
        requests.resize(count);
        for (const auto& outbox : outboxes) sizes.push_back(outbox.size());
    } catch (...) {
        send_and_receive_nothing(receivers, senders);
        throw;
    }
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
            receive_all(mpi_->comm, senders[i], mpi_->unwanted.get(), inbox_of_size);
        } else if (std::byte* const inbox = inbox_of_size(to_itself.size()); inbox != nullptr) {
            std::ranges::copy(to_itself, inbox);
        }
    }
    sending.wait();
    if (failure) std::rethrow_exception(failure);
}

void Communicator::send_and_receive_nothing(std::span<const int> receivers,
                                            std::span<const int> senders) const noexcept {
    if (!mpi_) return;
    const Communication communication(profile(), "exchange");
    Sending sending(mpi_->comm, communication, {mpi_->requests.get(), mpi_->every_rank.size()});
    for (const int receiver : receivers) {
        if (receiver != rank()) sending.send(nullptr, 0, receiver, exchange_tag);
    }
    for (const int sender : senders) {
        if (sender == rank()) continue;
        receive_all(mpi_->comm, sender, mpi_->unwanted.get(),
                    [](std::size_t) -> std::byte* { return nullptr; });
    }
    sending.wait();
}

Communicator communicator_of(MPI_Comm comm) {
    return Communicator(std::make_shared<const Communicator::Mpi>(comm));
}

namespace {

/// Did mpirun, or srun, start this process? Starting MPI otherwise would only cost time.
bool was_started_in_parallel() {
    constexpr std::array<const char*, 3> told_by{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
    return std::ranges::any_of(told_by, [](const char* n) { return std::getenv(n) != nullptr; });
}

}  // namespace

MpiSession::MpiSession(int* argc, char*** argv) {
    if (!was_started_in_parallel()) return;
    MPI_Init(argc, argv);
    world_ = communicator_of(MPI_COMM_WORLD);
    lock_ = open_common_lock(world_);
}

bool MpiSession::is_first_to_fail() const { return is_first_to_take(lock_); }

void MpiSession::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);  // not reached; MPI_Abort is not declared not to return
}

MpiSession::~MpiSession() {
    world_ = Communicator();
    if (lock_ >= 0) ::close(lock_);
    int initialized = 0;
    MPI_Initialized(&initialized);
    if (initialized != 0) MPI_Finalize();
}

}  // namespace octetra::distributed
