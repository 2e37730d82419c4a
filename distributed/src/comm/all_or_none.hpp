#pragma once

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// While a Watch exists, every collective function begins with a reduction by which the processes
/// check whether one of them has failed. A failed process calls answer() to take part in the next
/// such reduction, without knowing which function the others are calling; they throw OthersFailed.
class Communicator::Watch {
public:
    explicit Watch(const Communicator& processes);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch(Watch&&) = delete;
    Watch& operator=(Watch&&) = delete;

    /// Takes part in one such reduction, instead of a collective function or after the last one.
    void answer(bool has_failed) const noexcept;

private:
    const Communicator* processes_;
};

/// Collective. Calls `work`, which calls collective functions and may fail on one process while
/// others continue. A failure on any process is thrown on all, as by LocalFailure. `work` may use
/// LocalFailure as well: every exchange in it reports a failed process. Destructors must undo the
/// effects of an unfinished `work`, without collective functions. `work` must not call send() and
/// receive().
void all_or_none(const Communicator& processes, auto&& work) {
    LocalFailure failure;
    {
        const Communicator::Watch watch(processes);
        bool has_heard = false;
        failure.attempt([&] {
            try {
                work();
            } catch (const OthersFailed&) {
                has_heard = true;
            }
        });
        if (!has_heard) watch.answer(failure.found());
    }
    failure.agree(processes);
}

}  // namespace octetra::distributed
