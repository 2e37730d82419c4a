#include "adapt/judge.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/select_cells.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/maps_of_all.hpp"
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

}  // namespace

verify::MeshSlice slice_of(const distributed::AdaptiveMesh& mesh) {
    distributed::CanonicalMesh canonical = mesh.canonical();
    return verify::slice_of(canonical.whole());
}

verify::MeshSlice slice_of(const distributed::DistributedMesh& mesh) {
    auto canonical = distributed::CanonicalMesh::of(mesh);
    return verify::slice_of(canonical.whole());
}

void note_unverified(const Run& run, const Selection& selection) {
    const std::vector<Term> terms = external_terms(selection);
    if (terms.empty() || !run.world.is_first()) return;
    note(fmt::format("--verify checks a refinement of any cells: the verifier cannot evaluate {}",
                     text_of(terms.front())));
}

bool is_valid_refinement(const Run& run, verify::MeshSlice coarse, verify::MeshSlice fine,
                         const Judgement& judgement) {
    const std::string& coarse_name = run.options->input.path;
    const std::string& fine_name = run.options->output;
    const JudgedFiles judged{fine_name, coarse_name, fine.lists.index_base,
                             coarse.lists.index_base};
    verify::VerifyOptions options{.request = judgement.request,
                                  .closure = judgement.closure,
                                  .kept_per_code = described_of_each_code};
    RefinementMaps maps;
    if (judgement.maps != nullptr) {
        maps = maps_of_all(*judgement.maps, run.world);
        options.maps = &maps;
    }
    const auto verdict =
        verify::verify_refinement(std::move(coarse), std::move(fine), run.world, options);
    if (!run.world.is_first()) return verdict.valid();
    if (!verdict.valid()) {
        print_verdict(verdict, judged);
        print("{} written\n",
              judgement.is_only_output ? "nothing was" : fmt::format("{} was not", fine_name));
    } else if (!run.options->check) {
        note_unchecked(coarse_name);
    }
    return verdict.valid();
}

bool is_valid_coarsening(const Run& run, const distributed::AdaptiveMesh& after,
                         const Coarsened& asked) {
    const distributed::Phase phase(run.world, "verify");
    const std::string& name = run.options->output;
    const Mesh whole = after.collect();
    bool valid = true;
    run.world.on_first([&] {
        JudgedFiles judged;
        const auto verdict =
            judge_coarsened(asked, whole, name, {.kept_per_code = described_of_each_code}, judged);
        valid = verdict.valid();
        if (valid) return note_unchecked(asked.before);
        print_verdict(verdict, judged);
        print("{} was not written\n", name);
    });
    return run.world.of_first(std::uint64_t{valid ? 1U : 0U}) != 0;
}

}  // namespace octetra::cli
