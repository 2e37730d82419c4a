#include "comm/local_failure.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/out_of_memory.hpp>

#include "comm/mpi_group.hpp"

namespace octetra::distributed {
namespace {

enum class Kind : std::uint8_t { out_of_memory, bad_input, system_failed };

/// A failure in a form that a process without memory can send.
struct Words {
    Kind kind = Kind::out_of_memory;
    int rank = 0;                   ///< the rank that is out of memory
    std::array<char, 4096> what{};  ///< terminated by a zero

    void take(Kind of, const char* text) {
        kind = of;
        std::strncpy(what.data(), text, what.size() - 1);
    }
};

/// Describes the failure of process `rank`. OutOfMemory keeps the rank that it was first reported
/// for.
Words words_of(const std::exception_ptr& failure, int rank) {
    Words words{.rank = rank};
    if (!failure) return words;
    try {
        std::rethrow_exception(failure);
    } catch (const OutOfMemory& error) {
        words.rank = error.rank();
    } catch (const std::bad_alloc&) {
    } catch (const InputError& error) {
        words.take(Kind::bad_input, error.what());
    } catch (const std::exception& error) {
        words.take(Kind::system_failed, error.what());
    } catch (...) {
        words.take(Kind::system_failed, "unknown exception");
    }
    return words;
}

}  // namespace

void Communicator::on_each(const std::function<void()>& work) const {
    LocalFailure failure;
    failure.attempt(work);
    failure.agree(*this);
}

/// A failed process sends nothing. The others must not take its missing messages for empty ones, so
/// they check for failures before the messages are used.
std::vector<Communicator::Bytes> Communicator::exchange(std::vector<Bytes> to_each) const {
    if (mpi_ && mpi_->is_watched) {
        std::vector<Bytes> come = all_to_all(to_each);
        ask_whether_all_work();
        return come;
    }
    std::vector<Bytes> come;
    LocalFailure failure;
    failure.attempt([&] { come = all_to_all(to_each); });
    failure.agree(*this);
    return come;
}

/// Calls MPI_Allgatherv, which scales better than a message to each process; only above 2^31 bytes
/// in all, where its counts overflow, messages are used.
std::vector<Communicator::Bytes> Communicator::of_all(Bytes bytes) const {
    std::vector<Bytes> all;
    if (!mpi_) {
        all.push_back(std::move(bytes));
        return all;
    }
    const auto all_have = [this](auto&& memory) {
        if (mpi_->is_watched) {
            memory();
            return ask_whether_all_work();
        }
        LocalFailure failure;
        failure.attempt(memory);
        failure.agree(*this);
    };
    std::vector<std::uint64_t> sizes;
    all_have([&] { sizes.resize(static_cast<std::size_t>(size())); });
    gather_everywhere(bytes.size(), sizes);
    const auto total = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        std::vector<Bytes> to_each;
        all_have([&] { to_each.assign(sizes.size(), bytes); });
        return exchange(std::move(to_each));
    }
    Bytes gathered;
    std::vector<int> counts;
    std::vector<int> places;
    all_have([&] {
        gathered.resize(total);
        counts.assign(sizes.begin(), sizes.end());
        places.resize(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), places.begin(), 0);
    });
    gather_everywhere(bytes, counts, places, gathered);
    all_have([&] {
        for (std::size_t r = 0; r < counts.size(); ++r) {
            const auto begin = gathered.begin() + places[r];
            all.emplace_back(begin, begin + counts[r]);
        }
    });
    return all;
}

void LocalFailure::agree(const Communicator& processes) const {
    const auto size = static_cast<std::uint64_t>(processes.size());
    const auto rank = static_cast<std::uint64_t>(processes.rank());
    const std::uint64_t lowest = size - processes.max(found() ? size - rank : 0);
    if (lowest == size) return;
    const Words words =
        processes.of_rank(static_cast<int>(lowest), words_of(failure_, processes.rank()));
    switch (words.kind) {
        case Kind::out_of_memory: throw OutOfMemory(words.rank);
        case Kind::bad_input: throw InputError(words.what.data());
        case Kind::system_failed: throw SystemError(words.what.data());
    }
}

}  // namespace octetra::distributed
