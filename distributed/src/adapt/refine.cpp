#include <octetra/distributed/refine.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/select_cells.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_level.hpp"
#include "adapt/marks.hpp"
#include "adapt/step_options.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"
#include "select/select_cells.hpp"

namespace octetra::distributed {
namespace {

/// The state of a mesh that has only its history. The destructor returns the mesh.
class BorrowedMesh {
public:
    /// Collective, within a transaction.
    explicit BorrowedMesh(DistributedMesh& mesh) : mesh_(&mesh), state_(state_of(mesh)) {}
    ~BorrowedMesh() { *mesh_ = std::move(state_->mesh); }
    BorrowedMesh(const BorrowedMesh&) = delete;
    BorrowedMesh& operator=(const BorrowedMesh&) = delete;
    BorrowedMesh(BorrowedMesh&&) = delete;
    BorrowedMesh& operator=(BorrowedMesh&&) = delete;

    [[nodiscard]] const AdaptiveMesh::State& state() const { return *state_; }

private:
    DistributedMesh* mesh_;
    std::unique_ptr<AdaptiveMesh::State> state_;
};

/// Collective. Performs a level, preceded by a migration if the options request it. Returns false
/// on all processes if nothing is marked. On failure, only the order and the roots of the mesh may
/// have changed.
bool refine_level(DistributedMesh& mesh, const std::function<MarkedCells()>& mark,
                  const RefineOptions& options, const Tuning& tuning, int level,
                  std::uint64_t& accumulated_idle, SynchronisationCounts& total) {
    const Communicator processes = mesh.processes;
    std::uint64_t idle = accumulated_idle;
    SynchronisationCounts counts;
    std::optional<BorrowedMesh> borrowed;
    MovedLevel moved;
    PlannedLevel plan;
    processes.transaction([&] {
        plan = close_level(mesh, mark, options, tuning);
        if (!plan.changes_anything()) return;
        counts = plan.counts;
        std::optional<UnevenLevel> uneven;
        if (options.balance) {
            uneven = uneven_level(mesh, plan, *options.balance, options, tuning, idle);
        }
        if (!uneven) return bisect_level(plan, mesh, options, level);
        uneven->keep_mesh();
        moved = moved_level(borrowed.emplace(mesh).state(), *uneven, options, tuning);
        plan = std::move(moved.plan);
        bisect_level(plan, moved.to.state->mesh, options, level);
    });
    if (!plan.changes_anything()) return false;
    const std::size_t touched = plan.tested + plan.level->cells_touched();
    plan.commit();
    plan = {};
    borrowed.reset();
    if (moved.to.state != nullptr) mesh = std::move(moved.to.state->mesh);
    accumulated_idle = idle;
    total += counts;
    note_cells(processes, level, mesh.cells.size(), touched);
    return true;
}

}  // namespace

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options, const Tuning& tuning) {
    const StandardArithmetic standard;
    SynchronisationCounts total;
    RefineOptions of_level = options;
    if (options.balance) {
        const Phase phase(mesh.processes, "select");
        mesh.processes.transaction([&] {
            check_same(mesh.processes, *options.balance);
            if (uses_history(selection)) of_level.balance->may_forget_history = false;
        });
    }
    note_cells(mesh.processes, 0, mesh.cells.size(), 0);
    std::uint64_t accumulated_idle = 0;
    for (int level = 1; level <= options.levels; ++level) {
        const Phase phase(mesh.processes, "level", level);
        const auto mark = [&] {
            if (!is_compound(selection)) return mark_cells(mesh, selection, level > 1);
            return marked_by_bytes(mesh, select_cells(mesh, selection));
        };
        of_level.is_last = options.is_last && level == options.levels;
        if (!refine_level(mesh, std::ref(mark), of_level, tuning, level, accumulated_idle, total)) {
            break;  // nor would any later level change anything
        }
        const std::uint64_t cells = mesh.processes.sum(mesh.cells.size());
        if (options.on_level && mesh.processes.is_first()) options.on_level(level, cells);
    }
    return total;
}

SynchronisationCounts refine(DistributedMesh& mesh, const Selection& selection,
                             const RefineOptions& options) {
    return refine(mesh, selection, options, Tuning{});
}

}  // namespace octetra::distributed
