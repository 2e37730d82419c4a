#include "commands/refine/judge.hpp"

#include <utility>

#include <fmt/format.h>

#include <octetra/verify/verify.hpp>

#include "adapt/step_texts.hpp"
#include "commands/refine/maps_of_all.hpp"
#include "terminal.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

verify::VerifyOptions verify_options(const Plan& plan, const RefineOptions& options,
                                     const RefinementMaps* maps) {
    constexpr std::size_t described_of_each_code = 100;
    verify::VerifyOptions verified{.maps = maps, .kept_per_code = described_of_each_code};
    if (plan.closure == Closure::regular) {
        note(std::string(regular_closure_is_unchecked));
    } else {
        verified.request = {plan.selection, plan.scheme, options.refinement.levels};
    }
    return verified;
}

void note_unchecked(const RefineOptions& options) {
    if (options.check) return;
    note(
        fmt::format("of {} itself, only orientation and faces were checked, not whether cells "
                    "overlap: use octetra verify {}",
                    options.input.path, options.input.path));
}

void print_refusal(const verify::Verdict& verdict, const RefineOptions& options,
                   std::uint32_t index_base) {
    print_verdict(verdict, {options.output, options.input.path, index_base, index_base});
    print("nothing was written\n");
}

}  // namespace

bool is_valid(const Mesh& coarse, const Mesh& fine, const RefinementMaps& maps, const Plan& plan,
              const RefineOptions& options) {
    const auto verdict =
        verify::verify_refinement(coarse, fine, verify_options(plan, options, &maps));
    if (verdict.valid()) {
        note_unchecked(options);
    } else {
        print_refusal(verdict, options, fine.index_base);
    }
    return verdict.valid();
}

bool is_valid_distributed(verify::MeshSlice coarse, distributed::CanonicalMesh& fine,
                          const Plan& plan, const RefineOptions& options,
                          const distributed::Communicator& world) {
    RefinementMaps maps;
    if (!options.maps.empty()) maps = maps_of_all(fine.whole(), world);
    const auto verdict = verify::verify_refinement(
        std::move(coarse), verify::slice_of(fine.whole()), world,
        verify_options(plan, options, options.maps.empty() ? nullptr : &maps));
    if (world.is_first() && verdict.valid()) note_unchecked(options);
    if (world.is_first() && !verdict.valid()) {
        print_refusal(verdict, options, fine.facts().index_base);
    }
    return verdict.valid();
}

}  // namespace octetra::cli
