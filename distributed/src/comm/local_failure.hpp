#pragma once

#include <cstdint>
#include <exception>
#include <limits>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Thrown by collective functions inside all_or_none() if another process has failed.
struct OthersFailed : std::exception {};

/// Keeps an exception of this process until all processes know of it, because a process that threw
/// alone would leave the others waiting. Between two calls of agree() there may be at most one
/// exchange, which every process enters even if it has failed before.
class LocalFailure {
public:
    /// Calls `work`, unless something has failed before, and keeps the exception that it throws.
    /// OthersFailed is rethrown, because the failed process does not reach the next agree().
    void attempt(auto&& work) {
        if (found()) return;
        try {
            work();
        } catch (const OthersFailed&) {
            throw;
        } catch (...) {
            failure_ = std::current_exception();
        }
    }
    [[nodiscard]] bool found() const { return failure_ != nullptr; }

    /// Collective. If any process has failed, throws the failure of the lowest such rank on all
    /// processes: OutOfMemory, InputError, or SystemError for all other exceptions. A failure that
    /// was agreed on before is thrown again unchanged.
    void agree(const Communicator& processes) const;

    /// Collective. Returns the greatest `number` of all processes, or `somewhere` if any has
    /// failed. Throws nothing but OthersFailed.
    static constexpr std::uint64_t somewhere = std::numeric_limits<std::uint64_t>::max();
    [[nodiscard]] std::uint64_t max_unless_failed(const Communicator& processes,
                                                  std::uint64_t number) const {
        return processes.max(found() ? somewhere : number);
    }

private:
    std::exception_ptr failure_;
};

}  // namespace octetra::distributed
