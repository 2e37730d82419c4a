#include "comm/local_failure.hpp"

#include <array>
#include <cstring>
#include <new>

#include <octetra/core/error.hpp>
#include <octetra/distributed/out_of_memory.hpp>

#include "comm/mpi_group.hpp"

namespace octetra::distributed {
namespace {

enum class Kind : std::uint8_t { out_of_memory, bad_input, system_failed };

/// A failure that can be sent, by a process that may have no memory.
struct Words {
    Kind kind = Kind::out_of_memory;
    int rank = 0;                   ///< that has no memory
    std::array<char, 4096> what{};  ///< ends with a zero

    void take(Kind of, const char* text) {
        kind = of;
        std::strncpy(what.data(), text, what.size() - 1);
    }
};

/// Of the process `rank`, which may have heard of it from another.
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
        words.take(Kind::system_failed, "something unknown has failed");
    }
    return words;
}

}  // namespace

void Communicator::on_each(const std::function<void()>& work) const {
    LocalFailure failure;
    failure.attempt(work);
    failure.agree(*this);
}

/// From a process that has failed nothing comes, which nobody may take for what it has to say.
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
