#include "commands/verify/coarsened.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>

#include "commands/mesh_options.hpp"

namespace octetra::cli {

verify::Verdict judge_coarsened(const Coarsened& asked, const Mesh& after, const std::string& name,
                                const verify::VerifyOptions& options, JudgedFiles& judged) {
    const Checkpoint before = read_checkpoint(asked.before);
    check_regions(asked.typed.selection, before.input.regions, ProcessGroup::alone());
    verify::CoarseningRequest request{asked.selection, asked.typed.outside, asked.typed.levels,
                                      before.facts.closure};
    complete_selection(request.may_coarsen, asked.typed.selection,
                       {before.input.index_base, before.facts.cells_now,
                        SharedGroupNames(before.facts.group_names)});
    judged = {.fine = name,
              .coarse = asked.before,
              .fine_index_base = after.index_base,
              .coarse_index_base = before.input.index_base,
              .is_coarsened = true};
    try {
        return verify_coarsening(before.input, before.steps, request, after, options);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", asked.before, error.what()));
    }
}

}  // namespace octetra::cli
