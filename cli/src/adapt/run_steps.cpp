#include "adapt/run_steps.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "adapt/marked_cells.hpp"

namespace octetra::cli {
namespace {

using distributed::Adaptation;
using distributed::AdaptiveMesh;

/// Takes a step, which is collective, at most so often, until it changes nothing.
int repeat(AdaptiveMesh& mesh, int levels, const Followers& followers, auto&& take_step) {
    for (int level = 1; level <= levels; ++level) {
        const Adaptation step = take_step();
        if (!step.changed) return level - 1;
        if (followers.on_step) followers.on_step(step);
        const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
        if (followers.on_level && mesh.processes().is_first()) followers.on_level(level, cells);
    }
    return levels;
}

/// Collective.
std::vector<std::uint8_t> listed_or_none(const AdaptiveMesh& mesh,
                                         const std::vector<GlobalCell>& cells) {
    if (cells.empty()) return std::vector<std::uint8_t>(mesh.cells().size(), 0);
    return listed_cells(mesh, cells);
}

/// Collective. The cells of this process that a step marks as the mesh is now.
std::vector<std::uint8_t> may_go(const AdaptiveMesh& mesh, const CoarsenStep& step) {
    std::vector<std::uint8_t> marked = listed_or_none(mesh, step.selection.cells);
    add_marked_cells(mesh, step.selection, marked);
    if (!step.typed.outside) return marked;
    for (std::uint8_t& mark : marked) mark = mark == 0 ? 1 : 0;
    return marked;
}

}  // namespace

int refine(AdaptiveMesh& mesh, const RefineStep& step, const distributed::StepOptions& options,
           const Followers& followers) {
    if (step.selection.cells.empty()) {
        return repeat(mesh, step.typed.levels, followers,
                      [&] { return mesh.refine(step.selection, options); });
    }
    std::vector<std::uint8_t> listed;
    if (step.typed.levels > 0) listed = listed_cells(mesh, step.selection.cells);
    return repeat(mesh, step.typed.levels, followers, [&] {
        std::vector<std::uint8_t> marked = listed;
        add_marked_cells(mesh, step.selection, marked);
        Adaptation done = mesh.refine(std::span<const std::uint8_t>(marked), options);
        std::vector<std::uint8_t> descendants;
        descendants.reserve(mesh.cells().size());
        for (const std::uint32_t parent : done.cells.parents()) {
            descendants.push_back(listed[parent]);
        }
        listed = std::move(descendants);
        return done;
    });
}

int coarsen(AdaptiveMesh& mesh, const CoarsenStep& step, const Followers& followers) {
    return repeat(mesh, step.typed.levels, followers, [&] {
        const std::vector<std::uint8_t> marked = may_go(mesh, step);
        return mesh.coarsen(std::span<const std::uint8_t>(marked));
    });
}

}  // namespace octetra::cli
