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
};

struct Step {
    Action action = Action::refine;
    Selection selection;            ///< of refine and coarsen
    Scheme scheme = Scheme::eight;  ///< of refine
    int ranks = 1;                  ///< of reload; a run that has fewer takes all
};

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

}  // namespace octetra::properties
