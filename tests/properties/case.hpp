#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/refine.hpp>

namespace octetra::properties {

/// What a step of a history does.
enum class Action {
    refine,     ///< the cells that are selected
    coarsen,    ///< the cells that are selected may go
    take_back,  ///< coarsen the cells that the step before made; none, if it did not refine
    again,      ///< refine what was marked for the step that was just taken back; else nothing
    reload,     ///< save, and load on the first few ranks, or all
    rebalance,  ///< cells move to where all ranks have about as many
    scatter,    ///< cells move to ranks drawn for their roots; some may have none then
    rewrite,    ///< write, and read again: what was done so far cannot be taken back any more
};

struct Step {
    Action action = Action::refine;
    Selection selection;            ///< of refine and coarsen
    Scheme scheme = Scheme::eight;  ///< of refine
    int ranks = 1;                  ///< of reload; a run that has fewer takes all
    std::string format;             ///< of rewrite: a name of formats()
};

/// Histories that are drawn exact have coordinates of less than 16 on a grid of 2^-16, and each of
/// their up to twelve steps halves that: times this they are integers.
inline constexpr double exact_grid_scale = 0x1p28;

/// No step of a history makes more cells: one that would is refused.
inline constexpr std::size_t most_cells_of_a_history = 3000;

/// One refinement, or history, that laws are held against: everything that it depends on, and
/// nothing else.
struct Case {
    std::string kind;  ///< how the mesh was made, for people
    Mesh mesh;         ///< valid, as the verifier sees it
    Selection selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    /// One for each cell. Ranks that a run does not have stand for those left over by division.
    std::vector<int> cell_to_rank;
    std::uint64_t seed =
        0;  ///< of what a law draws by itself (a numbering, a translation), and of the ranks' ways
    /// Of a history. Its selection is then empty, and `levels` 1.
    std::vector<Step> steps;
};

/// Without steps that begin a new history, where a law looks at the one input.
[[nodiscard]] inline Case of_one_input(Case c) {
    std::erase_if(c.steps, [](const Step& step) { return step.action == Action::rewrite; });
    return c;
}

}  // namespace octetra::properties
