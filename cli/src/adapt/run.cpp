#include "adapt/run.hpp"

#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/verify/verify.hpp>

#include "commands/report_line.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

/// Collective. Throws InputError on all processes if the mesh is not valid.
void check_input(const Run& run, const std::function<verify::MeshSlice()>& slice_of_input) {
    const std::string& path = run.options->input.path;
    const distributed::Phase phase(run.world, "check");
    verify::MeshSlice slice = slice_of_input();
    const std::uint32_t index_base = slice.lists.index_base;
    const verify::Verdict verdict = verify::verify_mesh(std::move(slice), run.world);
    if (verdict.valid()) return;
    if (run.world.is_first()) {
        print_verdict(verdict, {.fine = path, .fine_index_base = index_base});
        std::fflush(stdout);
    }
    throw InputError(
        fmt::format("{}: --check finds the mesh not valid; nothing was written", path));
}

}  // namespace

void report(const Run& run, std::string_view doing, const MeshSize& size) {
    if (!run.world.is_first()) return;
    report_line(run.options->quiet, doing, size.vertices, size.cells, run.watch->lap());
}

void report_input(const Run& run, const MeshSize& size,
                  const std::function<verify::MeshSlice()>& slice) {
    const std::string& path = run.options->input.path;
    report(run, fmt::format("read {}", path), size);
    if (!run.options->check) return;
    check_input(run, slice);
    report(run, fmt::format("checked {}", path), size);
}

void report_written(const Run& run, const std::string& lost, const MeshSize& size) {
    if (run.world.is_first() && !lost.empty()) note(lost);
    report(run, fmt::format("wrote {}", run.options->output), size);
}

}  // namespace octetra::cli
