#include "adapt/step_options.hpp"

#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "adapt/mesh_state.hpp"

namespace octetra::distributed {
namespace {

std::string_view word_of(Scheme scheme) {
    constexpr std::array<std::string_view, 3> words{"8t", "4t", "2t"};
    return words[static_cast<std::size_t>(scheme)];
}

std::string_view word_of(Closure closure) {
    return closure == Closure::regular ? "regular" : "longest-edge";
}

std::string_view word_of(Synchronisation synchronisation) {
    return synchronisation == Synchronisation::gateway ? "gateway" : "neighbour";
}

/// Throws InputError if an option of this process differs from that of the first.
struct Check {
    int rank;

    void operator()(std::string_view name, const auto& own, const auto& of_first) const {
        ProcessGroup::check_same_as_first(rank, name, fmt::to_string(own),
                                          fmt::to_string(of_first));
    }
};

}  // namespace

void check_same(const Communicator& processes, const StepOptions& options) {
    const StepOptions first = processes.of_rank(0, options);
    if (options == first) return;
    const Check check{processes.rank()};
    check("scheme", word_of(options.scheme), word_of(first.scheme));
    check("closure", word_of(options.closure), word_of(first.closure));
    check("synchronisation", word_of(options.synchronisation), word_of(first.synchronisation));
    check("max_cells", options.max_cells, first.max_cells);
    check("is_last", options.is_last, first.is_last);
}

void check_closure(const AdaptiveMesh::State& state, const StepOptions& options) {
    if (options.closure == Closure::regular && options.scheme != Scheme::eight) {
        throw InputError("the regular closure requires the scheme 8t");
    }
    const bool has_steps = !state.mesh.level_begin.empty() || !state.forgotten.empty();
    if (!has_steps || state.mesh.closure == options.closure) return;
    throw InputError(fmt::format(
        "the mesh was refined with the {} closure, and this step has the {} closure: repeat the "
        "step with the closure of the mesh",
        word_of(state.mesh.closure), word_of(options.closure)));
}

void check_same(const Communicator& processes, const BalanceOptions& options) {
    // NaN must be rejected first, since it differs from itself.
    if (!(options.most_over_mean >= 1)) {
        throw InputError(fmt::format(
            "most_over_mean: the largest number of cells of a process over the mean, from 1; "
            "given is {}",
            options.most_over_mean));
    }
    const BalanceOptions first = processes.of_rank(0, options);
    if (options == first) return;
    const Check check{processes.rank()};
    check("most_over_mean", options.most_over_mean, first.most_over_mean);
    check("only_if_it_pays", options.only_if_it_pays, first.only_if_it_pays);
    check("may_forget_history", options.may_forget_history, first.may_forget_history);
}

}  // namespace octetra::distributed
