#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/out_of_memory.hpp>

#include "comm/mpi_group.hpp"
#include "comm/reduce.hpp"

/// A process that fails within a transaction need not know which collective function the others
/// call next: each begins with the same reduction, agree_in(), and that of the failed process
/// reports its failure. The others then leave the transaction by OthersFailed.
namespace octetra::distributed {
namespace {

/// Ends the work of a transaction on a process that has not failed itself. Not derived from
/// std::exception, so that only the transaction catches it.
struct OthersFailed {};

enum class Kind : std::uint8_t { out_of_memory, bad_input, system_failed };

/// The description of a failure, which a process without memory can send.
struct Description {
    Kind kind = Kind::out_of_memory;
    int rank = 0;                   ///< without memory
    std::array<char, 4096> what{};  ///< ends with a zero

    void take(Kind of, const char* text) {
        kind = of;
        std::strncpy(what.data(), text, what.size() - 1);
    }
};

/// The description of a failure of this process, or of another one if that is what it has thrown.
Description description_of(const std::exception_ptr& failure, int rank) {
    Description description{.rank = rank};
    if (!failure) return description;
    try {
        std::rethrow_exception(failure);
    } catch (const OutOfMemory& error) {
        description.rank = error.rank();
    } catch (const std::bad_alloc&) {
    } catch (const InputError& error) {
        description.take(Kind::bad_input, error.what());
    } catch (const std::exception& error) {
        description.take(Kind::system_failed, error.what());
    } catch (...) {
        description.take(Kind::system_failed, "something unknown has failed");
    }
    return description;
}

/// Collective. Throws the failure that `description` describes on the process `rank`.
[[noreturn]] void throw_failure(const Communicator& processes, int rank,
                                const std::exception_ptr& failure) {
    const Description description =
        processes.of_rank(rank, description_of(failure, processes.rank()));
    switch (description.kind) {
        case Kind::bad_input: throw InputError(description.what.data());
        case Kind::system_failed: throw SystemError(description.what.data());
        case Kind::out_of_memory: break;
    }
    throw OutOfMemory(description.rank);
}

/// Collective. Returns the maxima of two numbers of each process, and notes the lowest rank that
/// has failed, if one has.
std::array<std::uint64_t, 2> agree_in(const Communicator::Mpi& group,
                                      const std::array<std::uint64_t, 2>& numbers, bool has_failed,
                                      Profile* profile) {
    const auto size = static_cast<std::uint64_t>(group.size);
    const auto rank = static_cast<std::uint64_t>(group.rank);
    std::array<std::uint64_t, 3> maxima{numbers[0], numbers[1], has_failed ? size - rank : 0};
    reduce(maxima, MPI_MAX, group.comm, profile);
    if (maxima[2] != 0) group.failed_rank = static_cast<int>(size - maxima[2]);
    return {maxima[0], maxima[1]};
}

}  // namespace

bool Communicator::is_in_transaction() const { return mpi_ && mpi_->is_in_transaction; }

std::array<std::uint64_t, 2> Communicator::agreed_max(std::array<std::uint64_t, 2> numbers) const {
    if (!mpi_->failed_rank) numbers = agree_in(*mpi_, numbers, false, profile());
    if (mpi_->failed_rank) throw OthersFailed();
    return numbers;
}

void Communicator::agree_on_success() const {
    if (is_in_transaction()) (void)agreed_max({0, 0});
}

void Communicator::run_transaction(const std::function<void()>& work) const {
    if (is_in_transaction()) return work();
    std::exception_ptr failure;
    if (mpi_) mpi_->is_in_transaction = true;
    try {
        work();
        agree_on_success();
    } catch (const OthersFailed&) {
    } catch (...) {
        failure = std::current_exception();
    }
    if (!mpi_) {
        if (failure) throw_failure(*this, 0, failure);
        return;
    }
    // Without a profile, because there may be no memory for measuring.
    if (failure && !mpi_->failed_rank) (void)agree_in(*mpi_, {0, 0}, true, nullptr);
    mpi_->is_in_transaction = false;
    const std::optional<int> failed_rank = std::exchange(mpi_->failed_rank, std::nullopt);
    if (failed_rank) throw_failure(*this, *failed_rank, failure);
}

std::vector<Communicator::Bytes> Communicator::exchange(std::vector<Bytes> to_each) const {
    return transaction([&] { return all_to_all(to_each); });
}

/// Calls that all processes make together: messages from each to each would be far more.
std::vector<Communicator::Bytes> Communicator::of_all(Bytes bytes) const {
    return transaction([&] {
        std::vector<Bytes> all;
        if (!mpi_) {
            all.push_back(std::move(bytes));
            return all;
        }
        std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size()));
        agree_on_success();
        gather_everywhere(bytes.size(), sizes);
        const auto total = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
        if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
            return all_to_all(std::vector<Bytes>(sizes.size(), bytes));
        }
        Bytes gathered(total);
        const std::vector<int> counts(sizes.begin(), sizes.end());
        std::vector<int> offsets(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
        agree_on_success();
        gather_everywhere(bytes, counts, offsets, gathered);
        for (std::size_t r = 0; r < counts.size(); ++r) {
            const auto begin = gathered.begin() + offsets[r];
            all.emplace_back(begin, begin + counts[r]);
        }
        return all;
    });
}

}  // namespace octetra::distributed
