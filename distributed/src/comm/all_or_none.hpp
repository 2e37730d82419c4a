#pragma once

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// While one of these lives, processes begin every collective function by asking each other whether
/// one has failed. So one that has failed, wherever that was, can answer the question that the
/// others will ask next, and need not know which function they are in: those throw OthersFailed.
class Communicator::Watch {
public:
    explicit Watch(const Communicator& processes);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch(Watch&&) = delete;
    Watch& operator=(Watch&&) = delete;

    /// Answers once, instead of a collective function or after the last.
    void answer(bool has_failed) const noexcept;

private:
    const Communicator* processes_;
};

/// Collective. Does work with collective functions in it, in the midst of which one process may
/// fail while others go on. Whatever fails is thrown on all processes, as by LocalFailure, which
/// may be used in the work, too: that one has failed is known to all of its exchanges. What the
/// work has begun must be undone by destructors, without collective functions. It must not use
/// send() and receive().
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
