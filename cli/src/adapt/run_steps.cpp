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

/// Calls change(), a collective step, at most so often, until it changes nothing.
int repeat(AdaptiveMesh& mesh, int levels, const OnLevel& on_level, auto&& change) {
    for (int level = 1; level <= levels; ++level) {
        if (!change()) return level - 1;
        const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
        if (on_level && mesh.processes().is_first()) on_level(level, cells);
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
           const OnLevel& on_level) {
    if (step.selection.cells.empty()) {
        return repeat(mesh, step.typed.levels, on_level,
                      [&] { return mesh.refine(step.selection, options).changed; });
    }
    std::vector<std::uint8_t> listed;
    if (step.typed.levels > 0) listed = listed_cells(mesh, step.selection.cells);
    return repeat(mesh, step.typed.levels, on_level, [&] {
        std::vector<std::uint8_t> marked = listed;
        add_marked_cells(mesh, step.selection, marked);
        const Adaptation done = mesh.refine(std::span<const std::uint8_t>(marked), options);
        std::vector<std::uint8_t> descendants;
        descendants.reserve(mesh.cells().size());
        for (const std::uint32_t parent : done.cells.parents()) {
            descendants.push_back(listed[parent]);
        }
        listed = std::move(descendants);
        return done.changed;
    });
}

int coarsen(AdaptiveMesh& mesh, const CoarsenStep& step, const OnLevel& on_level) {
    return repeat(mesh, step.typed.levels, on_level, [&] {
        const std::vector<std::uint8_t> marked = may_go(mesh, step);
        return mesh.coarsen(std::span<const std::uint8_t>(marked)).changed;
    });
}

}  // namespace octetra::cli
