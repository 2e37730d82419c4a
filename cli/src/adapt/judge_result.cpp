#include "adapt/judge_result.hpp"

#include <utility>

#include <fmt/format.h>

#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "commands/mesh_options.hpp"
#include "terminal.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {

bool is_valid_result(const distributed::AdaptiveMesh& fine, verify::MeshSlice coarse,
                     const Judgement& judgement) {
    const distributed::Communicator& world = fine.processes();
    const distributed::Phase phase(world, "verify");
    constexpr std::size_t described_of_each_code = 100;
    distributed::CanonicalMesh whole = fine.canonical();
    const std::uint32_t index_base = whole.facts().index_base;
    const auto verdict = verify::verify_refinement(
        std::move(coarse), verify::slice_of(whole.whole()), world,
        {.request = judgement.request, .kept_per_code = described_of_each_code});
    if (!world.is_first()) return verdict.valid();
    if (verdict.valid()) {
        note(fmt::format(
            "of {} itself, orientation and faces were checked, not whether cells overlap: octetra "
            "verify {} does",
            judgement.coarse, judgement.coarse));
    } else {
        print_verdict(verdict, {judgement.fine, judgement.coarse, index_base, index_base});
        print("{} was not written\n", judgement.fine);
    }
    return verdict.valid();
}

}  // namespace octetra::cli
