#include "adapt/judge_result.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "commands/mesh_options.hpp"
#include "terminal.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

constexpr std::size_t described_of_each_code = 100;

void note_unchecked(const std::string& coarse) {
    note(
        fmt::format("of {} itself, only orientation and faces were checked, not whether cells "
                    "overlap: use octetra verify {}",
                    coarse, coarse));
}

void print_refusal(const verify::Verdict& verdict, const JudgedFiles& judged) {
    print_verdict(verdict, judged);
    print("{} was not written\n", judged.fine);
}

}  // namespace

JudgedMesh mesh_to_judge(const distributed::AdaptiveMesh& mesh, std::string name) {
    distributed::CanonicalMesh whole = mesh.canonical();
    return {std::move(name), whole.facts().index_base, verify::slice_of(whole.whole())};
}

bool is_valid_refinement(const distributed::AdaptiveMesh& fine, JudgedMesh coarse,
                         const Judgement& judgement) {
    const distributed::Communicator& world = fine.processes();
    const distributed::Phase phase(world, "verify");
    JudgedMesh judged = mesh_to_judge(fine, judgement.fine);
    const auto verdict =
        verify::verify_refinement(std::move(coarse.slice), std::move(judged.slice), world,
                                  {.request = judgement.request,
                                   .maps = judgement.maps,
                                   .kept_per_code = described_of_each_code});
    if (!world.is_first()) return verdict.valid();
    if (!verdict.valid()) {
        print_refusal(verdict, {judged.name, coarse.name, judged.index_base, coarse.index_base});
    } else if (!judgement.is_coarse_checked) {
        note_unchecked(coarse.name);
    }
    return verdict.valid();
}

bool is_valid_coarsening(const distributed::AdaptiveMesh& after, const Coarsened& asked,
                         const std::string& name) {
    const distributed::Communicator& world = after.processes();
    const distributed::Phase phase(world, "verify");
    const Mesh whole = after.collect();
    bool valid = true;
    world.on_first([&] {
        JudgedFiles judged;
        const auto verdict =
            judge_coarsened(asked, whole, name, {.kept_per_code = described_of_each_code}, judged);
        valid = verdict.valid();
        valid ? note_unchecked(asked.before) : print_refusal(verdict, judged);
    });
    return world.of_first(std::uint64_t{valid ? 1U : 0U}) != 0;
}

}  // namespace octetra::cli
