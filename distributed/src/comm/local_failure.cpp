#include "comm/local_failure.hpp"

namespace octetra::distributed {

void LocalFailure::agree(const Communicator& processes) const {
    if (!failure_) processes.agree_on_success();
    processes.transaction([&] {
        if (failure_) std::rethrow_exception(failure_);
    });
}

}  // namespace octetra::distributed
