#include "adapt/run_steps.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>

#include "adapt/marked_cells.hpp"
#include "adapt/step_texts.hpp"

namespace octetra::cli {
namespace {

using distributed::Adaptation;
using distributed::AdaptiveMesh;

/// Runs a step. An error message contains the level counted from the input of the history; adds the
/// level within this step.
Adaptation with_level(int level, int levels, const Followers& followers, auto&& take_step) {
    try {
        return take_step();
    } catch (const InputError& error) {
        if (!followers.is_refined_before) throw;
        throw InputError(cli::with_level(error.what(), level, levels));
    }
}

/// Repeats a collective step, at most `levels` times, until it changes nothing.
int repeat(AdaptiveMesh& mesh, int levels, const Followers& followers, auto&& take_step) {
    for (int level = 1; level <= levels; ++level) {
        const Adaptation step = with_level(level, levels, followers, take_step);
        if (!step.changed) return level - 1;
        if (followers.on_step) followers.on_step(step);
        const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
        if (followers.on_level && mesh.processes().is_first()) followers.on_level(level, cells);
    }
    return levels;
}

/// Collective. Returns the marks of the listed cells.
std::vector<std::uint8_t> listed_or_none(const AdaptiveMesh& mesh,
                                         const std::vector<GlobalCell>& cells) {
    if (cells.empty()) return std::vector<std::uint8_t>(mesh.cells().size(), 0);
    return listed_cells(mesh, cells);
}

/// Collective. Returns the marks of the cells of this process that a step selects in the current
/// mesh.
std::vector<std::uint8_t> marks_to_coarsen(const AdaptiveMesh& mesh, const CoarsenStep& step,
                                           const CarriedFields& fields) {
    std::vector<std::uint8_t> marked = listed_or_none(mesh, step.selection.cells);
    add_marked_cells(mesh, step.selection, fields, marked);
    if (!step.typed.outside) return marked;
    for (std::uint8_t& mark : marked) mark = mark == 0 ? 1 : 0;
    return marked;
}

/// Collective. Returns the number of marked cells of the whole mesh.
std::uint64_t count_marked(const AdaptiveMesh& mesh, const std::vector<std::uint8_t>& marked) {
    return mesh.processes().sum(marked.size() -
                                static_cast<std::size_t>(std::ranges::count(marked, 0)));
}

/// Collective. Leaves only as many marks as refinement to at most `target` cells can use; none
/// after a level in which these were not all.
void reduce_to_target(AdaptiveMesh& mesh, std::uint64_t target,
                      const distributed::StepOptions& options, std::vector<std::uint8_t>& marked,
                      RefinedLevels& done) {
    if (done.refined < done.marked) {
        std::ranges::fill(marked, 0);
        return;
    }
    done.marked = count_marked(mesh, marked);
    marked = mesh.marks_within(marked, target, options);
    done.refined = count_marked(mesh, marked);
}

}  // namespace

RefinedLevels refine(AdaptiveMesh& mesh, const RefineStep& step,
                     const distributed::StepOptions& options,
                     const std::optional<distributed::BalanceOptions>& balance,
                     const Followers& followers) {
    RefinedLevels done;
    const auto refine_by = [&](const auto& marks, auto&& follow_move) {
        if (!balance) return mesh.refine(marks, options);
        distributed::EvenStep done = mesh.refine_evenly(marks, *balance, options);
        if (done.move.changed()) {
            follow_move(done.move);
            if (followers.on_move) followers.on_move(done.move);
        }
        return std::move(done.step);
    };
    const std::optional<std::uint64_t>& target = step.typed.target_cells;
    if (step.selection.cells.empty() && !is_compound(step.selection) && !target) {
        done.count = repeat(mesh, step.typed.levels, followers, [&] {
            return refine_by(step.selection, [](const distributed::Migration&) {});
        });
        return done;
    }
    std::vector<std::uint8_t> listed;
    if (step.typed.levels > 0) listed = listed_or_none(mesh, step.selection.cells);
    done.count = repeat(mesh, step.typed.levels, followers, [&] {
        std::vector<std::uint8_t> marked = listed;
        add_marked_cells(mesh, step.selection, *followers.fields, marked);
        if (target) reduce_to_target(mesh, *target, options, marked, done);
        Adaptation level = refine_by(
            std::span<const std::uint8_t>(marked),
            [&](const distributed::Migration& move) { listed = move.cells(std::move(listed)); });
        std::vector<std::uint8_t> descendants;
        descendants.reserve(mesh.cells().size());
        for (const std::uint32_t parent : level.cells.parents()) {
            descendants.push_back(listed[parent]);
        }
        listed = std::move(descendants);
        return level;
    });
    return done;
}

int coarsen(AdaptiveMesh& mesh, const CoarsenStep& step, const Followers& followers,
            bool& is_any_marked) {
    return repeat(mesh, step.typed.levels, followers, [&] {
        const std::vector<std::uint8_t> marked = marks_to_coarsen(mesh, step, *followers.fields);
        const bool marks_here = std::ranges::count(marked, 0) < std::ssize(marked);
        is_any_marked = mesh.processes().max(marks_here ? 1 : 0) == 1;
        return mesh.coarsen(std::span<const std::uint8_t>(marked));
    });
}

Fitted fit(AdaptiveMesh& mesh, const FitStep& step, const distributed::StepOptions& options,
           const std::optional<distributed::BalanceOptions>& balance, const Followers& followers) {
    distributed::FitOptions fitting{
        .step = options, .balance = balance, .levels = step.typed.levels};
    if (balance) fitting.balance->may_forget_history = false;
    distributed::Fit fit(mesh, fitting);
    const auto sizes = [&] {
        return mesh.cell_values(step.size, followers.fields->all, followers.fields->backgrounds);
    };
    while (const auto done = fit.next(sizes())) {
        if (done->move.changed() && followers.on_move) followers.on_move(done->move);
        if (followers.on_step) followers.on_step(done->step);
        const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
        if (followers.on_level && mesh.processes().is_first()) {
            followers.on_level(fit.refined() + fit.coarsened(), cells);
        }
    }
    return {fit.refined(), fit.coarsened(), fit.misfit_cells(sizes())};
}

}  // namespace octetra::cli
