#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "checkpoint/load.hpp"
#include "checkpoint/load_fields.hpp"
#include "checkpoint/save.hpp"
#include "history/cut_marks.hpp"
#include "history/cut_roots.hpp"
#include "history/steps_of.hpp"
#include "level/incremental/adjacency.hpp"
#include "regular/transition_cells_of.hpp"

namespace octetra::distributed {
namespace {

/// Returns the steps of a part with this many roots, each as runs over all its cells.
std::vector<CutRuns> joined_steps(const CutRoots& cuts, std::size_t root_count,
                                  std::size_t step_count) {
    RootJoiner steps(step_count);
    RootBytes rest = cuts.bytes;
    std::size_t next = 0;
    for (const CutRoots::Root& root : cuts.roots) {
        steps.append_whole(root.index - next);
        (void)steps.append(rest.first(root.bytes));
        rest = rest.subspan(root.bytes);
        next = root.index + std::size_t{1};
    }
    steps.append_whole(root_count - next);
    return std::move(steps).finish();
}

/// Collective. Replays the steps as marks for refinement. If the history is damaged or forged,
/// closure may add marks; the result then differs from the history in the file.
void redo(AdaptiveMesh::State& state, CutRoots cuts, const CheckpointFacts& facts) {
    const Communicator& processes = state.mesh.processes;
    const auto given = joined_steps(cuts, state.mesh.cells.size(), facts.steps.size());
    CutMarks marks(std::move(cuts));
    for (std::size_t t = 0; t < facts.steps.size(); ++t) {
        const bool all = processes.max(marks.next_is_uniform(state.mesh) ? 0 : 1) == 0;
        const auto next_marks = [&] {
            return all ? marks.next_of_all(state.mesh) : marks.next(state.mesh);
        };
        (void)state.refine(next_marks, {});
    }
    {
        const CanonicalOrder order(state.mesh);
        if (steps_of(state.mesh) != given) {
            throw InputError("its steps are inconsistent with each other or with the cells");
        }
    }
    if (processes.sum(state.mesh.cells.size()) != facts.cells_now ||
        state.numbers.vertex_count != facts.vertices_now) {
        throw InputError("its steps produce a mesh of another size than its table states");
    }
}

/// Makes a mesh one that was refined with the regular closure. Throws InputError if it was not.
void set_regular(DistributedMesh& mesh) {
    restore_canonical_order(mesh);
    (void)transition_cells_of(mesh);
    mesh.closure = Closure::regular;
}

/// Adds the name of the file to the messages of InputErrors about the mesh.
auto with_file_name(const std::filesystem::path& path, auto&& work) {
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.native(), error.what()));
    }
}

}  // namespace

void AdaptiveMesh::save(const std::filesystem::path& path, std::span<const Field> fields,
                        const std::optional<SavedState>& state) const {
    const StandardArithmetic standard;
    DistributedMesh& mesh = state_->mesh;
    mesh.processes.transaction([&] {
        const CanonicalOrder order(mesh);
        const std::vector<CutRuns> steps = steps_of(mesh);
        const DistributedMesh input = input_of(mesh);
        distributed::save({.mesh = &mesh,
                           .cells_before = order.cells_before(),
                           .numbers = &state_->numbers,
                           .sharing = &state_->sharing,
                           .input = &input,
                           .state = &state,
                           .steps = steps},
                          fields, path);
    });
}

AdaptiveMesh AdaptiveMesh::load(const Communicator& processes, const std::filesystem::path& path,
                                const Partition& partition, std::vector<Field>* fields) {
    const StandardArithmetic standard;
    std::vector<Field> loaded;
    auto state = processes.transaction([&] {
        const CheckpointReader file(path);
        processes.check_same("partition", text_of(partition));
        LoadedPart part = load_part(processes, file, path, partition);
        auto made = with_file_name(path, [&] {
            auto of_file = State::make(distribute_parts(processes, std::move(part.input)));
            of_file->mesh.features = std::move(part.features);
            redo(*of_file, std::move(part.cuts), file.facts());
            if (file.facts().closure == Closure::regular) set_regular(of_file->mesh);
            return of_file;
        });
        if (fields != nullptr) {
            const CanonicalOrder order(made->mesh);
            loaded = load_fields(made->mesh, order.cells_before(), made->numbers, file);
        }
        return made;
    });
    if (fields != nullptr) *fields = std::move(loaded);
    return AdaptiveMesh(std::move(state));
}

}  // namespace octetra::distributed
