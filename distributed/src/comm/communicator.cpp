#include <octetra/distributed/communicator.hpp>

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <new>

#include <octetra/core/error.hpp>
#include <octetra/distributed/mpi.hpp>

#include "comm/common_lock.hpp"
#include "comm/launcher.hpp"
#include "comm/mpi_group.hpp"
#include "comm/reduce.hpp"
#include "profile/recorder.hpp"

namespace octetra::distributed {

Communicator::Communicator() = default;
Communicator::Communicator(std::shared_ptr<const Mpi> mpi) : mpi_(std::move(mpi)) {}

int Communicator::rank() const { return mpi_ ? mpi_->rank : 0; }
int Communicator::size() const { return mpi_ ? mpi_->size : 1; }

Communicator Communicator::with_profile(std::shared_ptr<Profile> profile) const {
    Communicator same = *this;
    same.profile_ = std::move(profile);
    return same;
}

std::uint64_t Communicator::sum(std::uint64_t number) const {
    agree_on_success();
    return mpi_ ? reduced(number, MPI_SUM, mpi_->comm, profile()) : number;
}

void Communicator::sum(std::span<std::uint64_t> numbers) const {
    agree_on_success();
    if (mpi_) reduce(numbers, MPI_SUM, mpi_->comm, profile());
}

void Communicator::max(std::span<std::uint64_t> numbers) const {
    agree_on_success();
    if (mpi_) reduce(numbers, MPI_MAX, mpi_->comm, profile());
}

std::uint64_t Communicator::max(std::uint64_t number) const {
    if (is_in_transaction()) return agreed_max({number, 0})[0];
    return mpi_ ? reduced(number, MPI_MAX, mpi_->comm, profile()) : number;
}

std::uint64_t Communicator::sum_before(std::uint64_t number) const {
    agree_on_success();
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
    agree_on_success();
    if (!mpi_) return size;
    const Communication communication(profile(), "broadcast");
    std::uint64_t number = size;
    communication.count_collective(sizeof number);
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, mpi_->comm);
    return number;
}

void Communicator::broadcast_bytes(void* data, std::size_t size, int root) const {
    agree_on_success();
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

void Communicator::gather_everywhere(std::uint64_t number, std::span<std::uint64_t> numbers) const {
    const Communication communication(profile(), "gathering");
    communication.count_collective(sizeof number);
    MPI_Allgather(&number, 1, MPI_UINT64_T, numbers.data(), 1, MPI_UINT64_T, mpi_->comm);
}

void Communicator::gather_everywhere(std::span<const std::byte> bytes, std::span<const int> counts,
                                     std::span<const int> offsets,
                                     std::span<std::byte> gathered) const {
    const Communication communication(profile(), "gathering");
    communication.count_collective(bytes.size());
    MPI_Allgatherv(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, gathered.data(),
                   counts.data(), offsets.data(), MPI_BYTE, mpi_->comm);
}

Communicator communicator_of(MPI_Comm comm) {
    if (comm == MPI_COMM_NULL) throw InputError("MPI_COMM_NULL has no processes");
    int is_intercommunicator = 0;
    MPI_Comm_test_inter(comm, &is_intercommunicator);
    if (is_intercommunicator != 0) {
        throw InputError(
            "an intercommunicator has two groups of processes, but a mesh needs one: merge them "
            "with MPI_Intercomm_merge");
    }
    int size = 0;
    MPI_Comm_size(comm, &size);
    if (size == 1) return {};
    std::shared_ptr<Communicator::Mpi> group;
    try {
        group = std::make_shared<Communicator::Mpi>(comm);
    } catch (const std::bad_alloc&) {  // thrown below, on all processes
    }
    if (!Communicator::Mpi::assign_duplicate(comm, group.get())) throw std::bad_alloc();
    return Communicator(std::move(group));
}

MPI_Comm comm_of(const Communicator& processes) {
    return processes.mpi() == nullptr ? MPI_COMM_SELF : processes.mpi()->comm;
}

MpiSession::MpiSession(int* argc, char*** argv) {
    if (!is_launched_by_mpi(&std::getenv)) return;
    MPI_Init(argc, argv);
    world_ = communicator_of(MPI_COMM_WORLD);
    lock_ = open_common_lock(world_);
}

bool MpiSession::is_first_to_fail() const { return try_claim(lock_); }

void MpiSession::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);  // not reached; MPI_Abort is not declared [[noreturn]]
}

MpiSession::~MpiSession() {
    world_ = Communicator();
    if (lock_ >= 0) ::close(lock_);
    int initialized = 0;
    MPI_Initialized(&initialized);
    if (initialized != 0) MPI_Finalize();
}

}  // namespace octetra::distributed
