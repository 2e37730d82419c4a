#include "adapt/marked_cells.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/marks.hpp"
#include "output/check_fields.hpp"
#include "select/select_cells.hpp"

namespace octetra::distributed {
namespace {

void check_history(const AdaptiveMesh::State& state, const Selection& selection) {
    if (state.forgotten.empty() || !uses_history(selection)) return;
    throw InputError(
        "generation needs the history of the mesh, which was forgotten when cells moved: recall "
        "it, or do not allow this");
}

/// Collective, within a transaction.
std::vector<std::uint8_t> select(const AdaptiveMesh::State& state, const Selection& selection,
                                 std::span<const Field> fields,
                                 std::span<const Background> backgrounds) {
    check_history(state, selection);
    return select_cells(state.mesh, selection,
                        {fields, &state.sharing, &state.numbers, backgrounds});
}

/// Collective.
void check_same_names(const Communicator& processes, std::span<const Background> backgrounds) {
    std::string names;
    for (const Background& background : backgrounds) names += background.name() + "; ";
    processes.check_same("backgrounds", names);
}

/// Collective. Returns the result of `work`, in a transaction that checks the values first.
auto with_values(const AdaptiveMesh::State& state, std::span<const Field> fields,
                 std::span<const Background> backgrounds, auto&& work) {
    const StandardArithmetic standard;
    const Communicator& processes = state.mesh.processes;
    const Phase phase(processes, "select");
    return processes.transaction([&] {
        check_sizes(state.mesh, fields);
        check_same(processes, fields);
        check_same_names(processes, backgrounds);
        return work();
    });
}

}  // namespace

std::function<MarkedCells()> marks_of(const AdaptiveMesh::State& state,
                                      const Selection& selection) {
    // Processes with different selections must not call different collective functions.
    const bool is_compound_here = is_compound(selection);
    if (state.mesh.processes.max(is_compound_here ? 1 : 0) == 0) {
        return [&] { return mark_cells(state.mesh, selection, false); };
    }
    return [&] { return marked_by_bytes(state.mesh, select(state, selection, {}, {})); };
}

std::vector<std::uint8_t> AdaptiveMesh::marked_cells(
    const Selection& selection, std::span<const Field> fields,
    std::span<const Background> backgrounds) const {
    return with_values(*state_, fields, backgrounds,
                       [&] { return select(*state_, selection, fields, backgrounds); });
}

std::vector<double> AdaptiveMesh::cell_values(const Expression& expression,
                                              std::span<const Field> fields,
                                              std::span<const Background> backgrounds) const {
    return with_values(*state_, fields, backgrounds, [&] {
        check_history(*state_, {.where = {expression}});
        return evaluate_cells(state_->mesh, expression,
                              {fields, &state_->sharing, &state_->numbers, backgrounds});
    });
}

}  // namespace octetra::distributed
