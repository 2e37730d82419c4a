#include <octetra/distributed/communicator.hpp>

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include <octetra/distributed/mpi.hpp>

#include "comm/common_lock.hpp"
#include "profile/recorder.hpp"

namespace octetra::distributed {

struct Communicator::Mpi {
    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0;
    int size = 1;

    explicit Mpi(MPI_Comm original) {
        MPI_Comm_dup(original, &comm);
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
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

/// The most bytes of one MPI message; its count is an int.
constexpr std::size_t most_bytes = std::size_t{1} << 30U;

constexpr int exchange_tag = 1;

std::uint64_t reduced(std::uint64_t number, MPI_Op operation, MPI_Comm comm, Profile* profile) {
    const Communication communication(profile, "reduction");
    communication.count_collective(sizeof number);
    MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_UINT64_T, operation, comm);
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

std::uint64_t Communicator::sum(std::uint64_t number) const {
    return mpi_ ? reduced(number, MPI_SUM, mpi_->comm, profile()) : number;
}

std::uint64_t Communicator::max(std::uint64_t number) const {
    return mpi_ ? reduced(number, MPI_MAX, mpi_->comm, profile()) : number;
}

std::uint64_t Communicator::sum_before(std::uint64_t number) const {
    if (!mpi_) return 0;
    const Communication communication(profile(), "reduction");
    communication.count_collective(sizeof number);
    std::uint64_t sum = 0;
    MPI_Exscan(&number, &sum, 1, MPI_UINT64_T, MPI_SUM, mpi_->comm);
    return mpi_->rank == 0 ? 0 : sum;
}

std::vector<int> Communicator::every_rank() const {
    std::vector<int> ranks(static_cast<std::size_t>(size()));
    std::iota(ranks.begin(), ranks.end(), 0);
    return ranks;
}

std::size_t Communicator::broadcast_size(std::size_t size) const {
    if (!mpi_) return size;
    const Communication communication(profile(), "broadcast");
    std::uint64_t number = size;
    communication.count_collective(sizeof number);
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, mpi_->comm);
    return number;
}

void Communicator::broadcast_bytes(void* data, std::size_t size) const {
    if (!mpi_) return;
    const Communication communication(profile(), "broadcast");
    for (std::size_t offset = 0; offset < size; offset += most_bytes) {
        const std::size_t count = std::min(size - offset, most_bytes);
        communication.count_collective(count);
        MPI_Bcast(static_cast<std::byte*>(data) + offset, static_cast<int>(count), MPI_BYTE, 0,
                  mpi_->comm);
    }
}

// One message to each receiver, empty or not. Only one that fills a whole message is followed by
// another, so that the receiver knows when it has all.
void Communicator::send_and_receive_bytes(const std::vector<int>& receivers,
                                          const std::vector<std::span<const std::byte>>& outboxes,
                                          const std::vector<int>& senders, Allocate allocate,
                                          void* context) const {
    const Communication communication(mpi_ ? profile() : nullptr, "exchange");
    std::vector<MPI_Request> requests;
    std::span<const std::byte> to_itself;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        const std::span<const std::byte> outbox = outboxes[i];
        if (receivers[i] == rank()) {
            to_itself = outbox;
            continue;
        }
        for (std::size_t offset = 0; offset <= outbox.size(); offset += most_bytes) {
            const std::size_t count = std::min(outbox.size() - offset, most_bytes);
            communication.count_message(count);
            MPI_Isend(outbox.data() + offset, static_cast<int>(count), MPI_BYTE, receivers[i],
                      exchange_tag, mpi_->comm, &requests.emplace_back());
        }
    }
    for (std::size_t i = 0; i < senders.size(); ++i) {
        if (senders[i] == rank()) {
            std::ranges::copy(to_itself, allocate(context, i, to_itself.size()));
            continue;
        }
        std::size_t received = 0;
        int count = 0;
        do {
            MPI_Message message = MPI_MESSAGE_NULL;
            MPI_Status status;
            MPI_Mprobe(senders[i], exchange_tag, mpi_->comm, &message, &status);
            MPI_Get_count(&status, MPI_BYTE, &count);
            const auto size = static_cast<std::size_t>(count);
            std::byte* inbox = allocate(context, i, received + size);
            MPI_Mrecv(inbox + received, count, MPI_BYTE, &message, MPI_STATUS_IGNORE);
            received += size;
        } while (static_cast<std::size_t>(count) == most_bytes);
    }
    if (!requests.empty()) {
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }
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
