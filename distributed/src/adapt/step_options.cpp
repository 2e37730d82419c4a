#include "adapt/step_options.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

template <class Options>
void check_all_same(const Communicator& processes, const Options& options) {
    if (options == processes.of_rank(0, options)) return;
    throw InputError(
        fmt::format("rank {}: options of the step are not those of rank 0", processes.rank()));
}

}  // namespace

void check_same(const Communicator& processes, const StepOptions& options) {
    check_all_same(processes, options);
}

void check_same(const Communicator& processes, const BalanceOptions& options) {
    // NaN must be rejected first, since it differs from itself.
    if (!(options.most_over_mean >= 1)) {
        throw InputError(fmt::format(
            "most_over_mean: the largest number of cells of a process over the mean, from 1; "
            "given is {}",
            options.most_over_mean));
    }
    check_all_same(processes, options);
}

}  // namespace octetra::distributed
