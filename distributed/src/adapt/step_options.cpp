#include "adapt/step_options.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

void check_same(const Communicator& processes, const StepOptions& options) {
    const StepOptions on_first = processes.of_rank(0, options);
    LocalFailure failure;
    failure.attempt([&] {
        if (options == on_first) return;
        throw InputError(
            fmt::format("rank {}: options of the step are not those of rank 0", processes.rank()));
    });
    failure.agree(processes);
}

}  // namespace octetra::distributed
