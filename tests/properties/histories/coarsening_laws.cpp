#include <optional>

#include <octetra/verify/verify.hpp>

#include "properties/coarser_meshes.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/nesting.hpp"
#include "verify/verdicts.hpp"

/// The laws that compare the meshes before and after a step.
namespace octetra::properties {
namespace {

/// A history made by the ranks and by the reference, which has the meshes and the marks of each
/// step.
struct Both {
    Adapted adapted;
    ReferenceHistory reference;
    std::vector<std::size_t> coarsenings;  ///< the steps that made a coarser mesh
    std::string fault;                     ///< set if the meshes differ
};

Both by_both(const Case& c) {
    Both both{adapted_by_all(c), adapted_by_reference(c), {}, {}};
    for (std::size_t k = 0; k < c.steps.size(); ++k) {
        const Stage& found = both.adapted.stages[k];
        if (!(found.mesh.cells == both.reference.stages[k].mesh.cells)) {
            both.fault = "the cells are not the reference's";
        }
        const Action action = c.steps[k].action;
        const bool coarsens = action == Action::coarsen || action == Action::take_back;
        if (coarsens && found.changed) both.coarsenings.push_back(k);
    }
    return both;
}

const Mesh& mesh_before(const Case& c, const Both& both, std::size_t step) {
    return step == 0 ? c.mesh : both.adapted.stages[step - 1].mesh;
}

/// The volume of all cells; nothing unless each cell has a positive volume.
std::optional<test::Int128> exact_volume(const Mesh& mesh) {
    test::Int128 sum = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const test::Int128 of_cell =
            test::exact_volume(test::corners_of(mesh, c), exact_grid_scale);
        if (of_cell <= 0) return {};
        sum += of_cell;
    }
    return sum;
}

}  // namespace

std::string fault_of_survivors(const Case& c) {
    const Both both = by_both(c);
    if (!both.fault.empty()) return both.fault;
    for (const std::size_t k : both.coarsenings) {
        if (!has_unmarked_cells(mesh_before(c, both, k), both.reference.marked[k],
                                both.adapted.stages[k].mesh)) {
            return "a cell that was not marked is not in the coarser mesh";
        }
    }
    return both.adapted.fault_of_ancestries;
}

std::string fault_of_generations(const Case& drawn) {
    const Case c = without_rewrites(drawn);
    const Both both = by_both(c);
    if (!both.fault.empty()) return both.fault;
    for (const std::size_t k : both.coarsenings) {
        const auto before = reference::replay(both.reference.before[k]);
        const auto after = reference::replay(
            reference::coarsened(both.reference.before[k], both.reference.marked[k], c.closure));
        const reference::Refinement coarser{both.adapted.stages[k].mesh, after.back().maps};
        if (!test::refines(before.back(), coarser, exact_grid_scale)) {
            return "the coarser mesh is not refined by the one before";
        }
        if (!coarsens_by_one_generation(before, coarser, exact_grid_scale)) {
            return "a cell of the coarser mesh is back by two generations";
        }
    }
    if (!both.coarsenings.empty()) {
        const Mesh& coarser = both.adapted.stages[both.coarsenings.back()].mesh;
        const auto verdict = verify::verify_refinement(c.mesh, coarser);
        if (!verdict.valid()) return "the verifier finds: " + test::codes_of(verdict);
    }
    return both.adapted.fault_of_ancestries;
}

std::string fault_of_volumes(const Case& c) {
    const auto expected = exact_volume(c.mesh);
    const Adapted adapted = adapted_by_all(c);
    for (const Stage& stage : adapted.stages) {
        if (exact_volume(stage.mesh) != expected) return "the volume has changed";
    }
    return {};
}

}  // namespace octetra::properties
