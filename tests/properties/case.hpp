#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/refine.hpp>

namespace octetra::properties {

/// The action of a step of a history.
enum class Action {
    refine,     ///< the selected cells
    coarsen,    ///< the selected cells are marked to be removed
    take_back,  ///< coarsen the cells that the previous step made; none if it did not refine
    again,      ///< refine what was marked for the step that was just taken back; else nothing
    reload,     ///< save, and load on the first few ranks, or on all
    rebalance,  ///< migrate so that all ranks have nearly the same number of cells
    scatter,    ///< migrate roots to random ranks; some ranks may be left without cells
    rewrite,    ///< write and read again: earlier steps can no longer be taken back
};

struct Step {
    Action action = Action::refine;
    Selection selection;            ///< for refine and coarsen
    Scheme scheme = Scheme::eight;  ///< for refine
    int ranks = 1;                  ///< for reload; all ranks if the run has fewer
    std::string format;             ///< for rewrite: a name of formats()
};

/// Exact histories have coordinates below 16 on a grid of 2^-16, and each of their at most twelve
/// steps halves the grid: multiplied by this scale, coordinates are integers.
inline constexpr double exact_grid_scale = 0x1p28;

/// Maximum number of cells of a history: a step that would exceed it is refused.
inline constexpr std::size_t max_history_cells = 3000;

/// One refinement or history on which laws are judged: the complete input of the judgement.
struct Case {
    std::string kind;  ///< how the mesh was made, in words
    Mesh mesh;         ///< valid according to the verifier
    Selection selection;
    Scheme scheme = Scheme::eight;
    Closure closure = Closure::longest_edge;  ///< of all levels and steps; see regular()
    int levels = 1;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    /// The rank of each cell. Ranks are taken modulo the number of ranks of the run.
    std::vector<int> cell_to_rank;
    std::uint64_t seed =
        0;  ///< seeds the law's own draws (numbering, translation) and the ranks' tuning
    /// The steps of a history. If there are any, `selection` is empty and `levels` is 1.
    std::vector<Step> steps;
};

/// Removes the steps that begin a new history, for laws that inspect a single input.
[[nodiscard]] inline Case without_rewrites(Case c) {
    std::erase_if(c.steps, [](const Step& step) { return step.action == Action::rewrite; });
    return c;
}

/// The case with Closure::regular and the scheme that it requires. Steps are not taken back: with
/// this closure, the children of a refinement may be descendants of a parent that it did not
/// bisect.
[[nodiscard]] inline Case regular(Case c) {
    c.closure = Closure::regular;
    c.scheme = Scheme::eight;
    std::erase_if(c.steps, [](const Step& step) {
        return step.action == Action::take_back || step.action == Action::again;
    });
    for (Step& step : c.steps) step.scheme = Scheme::eight;
    return c;
}

}  // namespace octetra::properties
