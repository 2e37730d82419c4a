#include "commands/refine/judge.hpp"

#include <utility>

#include <fmt/format.h>

#include <octetra/verify/verify.hpp>

#include "terminal.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

verify::VerifyOptions verify_options(const Plan& plan, const RefineOptions& options,
                                     const RefinementMaps* maps) {
    constexpr std::size_t described_of_each_code = 100;
    return {.request = verify::Request{plan.selection, plan.scheme, options.refinement.levels},
            .maps = maps,
            .kept_per_code = described_of_each_code};
}

void note_unchecked(const RefineOptions& options) {
    if (options.check) return;
    note(
        fmt::format("of {} itself, orientation and faces were checked, not whether cells overlap: "
                    "octetra verify {} does",
                    options.input.path, options.input.path));
}

void print_refusal(const verify::Verdict& verdict, const RefineOptions& options,
                   std::uint32_t index_base) {
    print_verdict(verdict, {options.output, options.input.path, index_base, index_base});
    print("nothing was written\n");
}

/// Collective. Every process gets the whole of the maps. (Only who asks for --maps needs them.)
RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world) {
    const MeshFacts& facts = fine.facts();
    RefinementMaps maps;
    for (const std::uint64_t parent : fine.parents(whole_window(facts.cells))) {
        maps.cell_to_parent.push_back(CellIndex{parent});
    }
    const Window midpoints = whole_window(facts.vertices - facts.first_midpoint);
    for (const auto& ends : fine.midpoint_ends(midpoints)) {
        maps.midpoint_to_edge.push_back(indices_of(ends));
    }
    world.broadcast(maps.cell_to_parent);
    world.broadcast(maps.midpoint_to_edge);
    maps.first_midpoint = VertexIndex{facts.first_midpoint};
    return maps;
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

bool is_valid_together(verify::MeshSlice coarse, distributed::CanonicalMesh& fine, const Plan& plan,
                       const RefineOptions& options, const distributed::Communicator& world) {
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
