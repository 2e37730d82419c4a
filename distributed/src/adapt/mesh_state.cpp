#include "adapt/mesh_state.hpp"

#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/step_options.hpp"
#include "comm/local_failure.hpp"
#include "profile/recorder.hpp"
#include "sharing/sharing_builder.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

/// The numbers of a level's new vertices; removed by the destructor unless they are kept.
class NewNumbers {
public:
    explicit NewNumbers(CanonicalNumbers& numbers)
        : numbers_(&numbers), end_(numbers.of_vertex.end_index()), count_(numbers.vertex_count) {}
    ~NewNumbers() {
        if (numbers_ != nullptr) numbers_->forget_from(end_, count_);
    }
    NewNumbers(const NewNumbers&) = delete;
    NewNumbers& operator=(const NewNumbers&) = delete;
    NewNumbers(NewNumbers&&) = delete;
    NewNumbers& operator=(NewNumbers&&) = delete;
    void keep() noexcept { numbers_ = nullptr; }

private:
    CanonicalNumbers* numbers_;
    VertexIndex end_;
    std::uint64_t count_;
};

/// Describes a level; to be called before it is committed.
Adaptation adaptation_of(PlannedLevel& plan, const DistributedMesh& mesh) {
    const std::size_t before = mesh.level_begin.back().value();
    const auto new_ends =
        std::span(mesh.midpoint_to_edge).subspan(before - mesh.input_vertices.size());
    std::vector<EdgeVertices> copied;
    reserve_in_huge_pages(copied, new_ends.size());
    copied.assign(new_ends.begin(), new_ends.end());
    ListChanges changes = plan.changes();
    return {.changed = true,
            .cells = std::move(changes.cells),
            .facets = std::move(changes.facets),
            .edges = std::move(changes.edges),
            .vertex_count_before = before,
            .new_vertex_ends = std::move(copied),
            .synchronisation = plan.counts};
}

}  // namespace

Migration unmoved(const DistributedMesh& mesh) {
    return {mesh.processes, mesh.cells.size(), mesh.points.size()};
}

Adaptation unchanged(const DistributedMesh& mesh) {
    return {.changed = false,
            .cells = EntityTransfer(mesh.cells.size()),
            .facets = EntityTransfer(mesh.facets.size()),
            .edges = EntityTransfer(mesh.edges.size()),
            .vertex_count_before = mesh.points.size(),
            .new_vertex_ends = {},
            .synchronisation = {}};
}

RefineOptions level_options(const StepOptions& options) {
    return {.scheme = options.scheme,
            .levels = 1,
            .synchronisation = options.synchronisation,
            .max_cells = options.max_cells,
            .is_last = options.is_last,
            .on_level = {}};
}

std::unique_ptr<AdaptiveMesh::State> AdaptiveMesh::State::make(DistributedMesh part) {
    const Communicator processes = part.processes;
    std::unique_ptr<State> state;
    LocalFailure failure;
    failure.attempt([&] {
        state = std::make_unique<State>();
        state->mesh = std::move(part);
        state->numbers = input_numbers(state->mesh);
    });
    failure.agree(processes);
    state->sharing =
        in_phase(processes, "sharers", [&] { return find_vertex_sharing(state->mesh); });
    return state;
}

Adaptation AdaptiveMesh::State::refine(const std::function<MarkedCells()>& mark,
                                       const StepOptions& options, const Tuning& tuning) {
    const StandardArithmetic standard;
    check_same(mesh.processes, options);
    const RefineOptions refine_options = level_options(options);
    const int level = step_count + 1;
    const Phase phase(mesh.processes, "level", level);
    note_cells_before_level();
    PlannedLevel plan = plan_level(mesh, mark, refine_options, tuning, level);
    return plan.changes_anything() ? take(plan) : unchanged(mesh);
}

Adaptation AdaptiveMesh::State::take(PlannedLevel& plan) {
    Adaptation adaptation;
    NewNumbers new_numbers(numbers);
    SharingBuilder<VertexIndex> shared(sharing, mesh.processes.rank());
    LocalFailure failure;
    {
        const Phase numbering(mesh.processes, "number vertices");
        (void)numbers.number_midpoints(mesh, mesh.points.end_index(), sharing.shared(), failure);
    }
    failure.attempt([&] {
        const Phase sharers(mesh.processes, "sharers");
        auto midpoints = plan.level->shared_midpoints();
        for (std::size_t i = 0; i < midpoints.size(); ++i) {
            shared.share(mesh.interfaces[i].rank, std::move(midpoints[i]));
        }
        shared.prepare(
            [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers.of_vertex[v]); });
    });
    failure.attempt([&] {
        const Phase maps(mesh.processes, "maps");
        adaptation = adaptation_of(plan, mesh);
        note_cells(mesh.processes, step_count + 1, plan.level->cell_count_afterwards(),
                   plan.tested + plan.level->cells_touched());
    });
    failure.agree(mesh.processes);

    plan.commit();
    shared.commit();
    new_numbers.keep();
    ++step_count;
    return adaptation;
}

void AdaptiveMesh::State::note_cells_before_level() const {
    if (Profile* const profile = mesh.processes.profile()) {
        profile->note_first_cells(step_count, mesh.cells.size());
    }
}

void AdaptiveMesh::State::reserve_history() {
    LocalFailure failure;
    failure.attempt([&] { forgotten.reserve(forgotten.size() + 1); });
    failure.agree(mesh.processes);
}

void AdaptiveMesh::State::replace_by(State&& after, std::unique_ptr<CellsAsRoots> roots) noexcept {
    after.forgotten = std::move(forgotten);
    if (roots != nullptr) after.forgotten.push_back(roots->keep());
    *this = std::move(after);
}

}  // namespace octetra::distributed
