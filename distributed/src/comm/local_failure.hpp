#pragma once

#include <cstdint>
#include <exception>
#include <limits>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Ends a transaction on a process that has not failed itself. Not derived from std::exception, so
/// that only the transaction catches it.
struct OthersFailed {};

/// What has gone wrong on this process, kept until all processes know: one that throws on its own
/// leaves the others waiting. Between two places where processes agree, there is one exchange at
/// most, which every process enters whatever has failed before.
class LocalFailure {
public:
    /// Does the work, unless something has failed before. What it throws is kept, but for
    /// OthersFailed, as those will not come to the place where processes agree.
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

    /// Collective. Throws on all processes the same if any has failed: what has failed on the one
    /// of the lowest rank. That is OutOfMemory, an InputError, or for all else a SystemError; the
    /// same once more, if it is what all have agreed on before.
    void agree(const Communicator& processes) const;

    /// Collective. The greatest of the processes' numbers, or `somewhere` if any has failed. Throws
    /// nothing but OthersFailed.
    static constexpr std::uint64_t somewhere = std::numeric_limits<std::uint64_t>::max();
    [[nodiscard]] std::uint64_t max_unless_failed(const Communicator& processes,
                                                  std::uint64_t number) const {
        if (processes.is_in_transaction()) {
            agree(processes);
            return processes.max(number);
        }
        return processes.max(found() ? somewhere : number);
    }

private:
    std::exception_ptr failure_;
};

}  // namespace octetra::distributed
