#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/marks.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "level/planned_level.hpp"
#include "level/tuning.hpp"
#include "regular/regular_step.hpp"

namespace octetra::distributed {
namespace {

/// Collective, within a transaction. Returns the number of cells of the whole mesh after a level.
std::uint64_t cells_after_level(DistributedMesh& mesh, const MarkedCells& marked,
                                const RefineOptions& options) {
    const PlannedLevel plan = close_level(
        mesh, [&] { return marked; }, options, Tuning{});
    return mesh.processes.sum(plan.changes_anything() ? plan.level->cell_count_afterwards()
                                                      : mesh.cells.size());
}

/// Collective, within a transaction. The same for a step with the regular closure, which is
/// performed and reverted.
std::uint64_t cells_after_regular_step(AdaptiveMesh::State& state, const MarkedCells& marked,
                                       const RefineOptions& options) {
    RegularStep step(state, options, Tuning{});
    (void)step.plan(marked);
    return state.mesh.processes.sum(state.mesh.cells.size());
}

bool is_positive(double rank) { return rank > 0; }

/// Collective, within a transaction. Returns the total number of positive ranks.
std::uint64_t count_positive(const Communicator& processes, std::span<const double> ranks) {
    return processes.sum(static_cast<std::size_t>(std::ranges::count_if(ranks, is_positive)));
}

/// The numbers of marks between which a search continues, and of cells that they make.
struct Bracket {
    std::uint64_t fitting = 0;
    std::uint64_t exceeding = 0;
    std::uint64_t cells_fitting = 0;
    std::uint64_t cells_exceeding = 0;

    [[nodiscard]] std::uint64_t width() const { return exceeding - fitting; }
    /// Returns the number between both at which linear interpolation expects this many cells.
    [[nodiscard]] std::uint64_t interpolated(std::uint64_t cells) const {
        const double share = static_cast<double>(cells - cells_fitting) /
                             static_cast<double>(cells_exceeding - cells_fitting);
        const auto guess = static_cast<std::uint64_t>(share * static_cast<double>(width()));
        return fitting + std::clamp<std::uint64_t>(guess, 1, width() - 1);
    }
    [[nodiscard]] std::uint64_t middle() const { return fitting + width() / 2; }
};

/// Collective, within a transaction. Returns `base` and the cells with the greatest positive ranks,
/// as many as make at most `limit` cells; of cells with the same rank all are marked or none.
/// cells_after(marks) is at most `limit` for `base`. All cells of positive rank together exceed it.
std::vector<std::uint8_t> add_by_rank(const Communicator& processes,
                                      const std::vector<std::uint8_t>& base,
                                      std::span<const double> ranks, std::uint64_t limit,
                                      auto&& cells_after) {
    const auto all = static_cast<double>(processes.sum(ranks.size()));
    const auto marks_of = [&](std::uint64_t count) {
        // The product of the fraction and the number of cells is rounded up to `count`.
        std::vector<std::uint8_t> marks =
            mark_fraction(processes, ranks, (static_cast<double>(count) - 0.5) / all);
        std::ranges::transform(marks, base, marks.begin(), std::bit_or<>());
        return marks;
    };
    std::vector<std::uint8_t> best = base;
    Bracket bracket{.exceeding = count_positive(processes, ranks),
                    .cells_fitting = cells_after(base)};
    bracket.cells_exceeding = cells_after(marks_of(bracket.exceeding));
    // Interpolation is fast where the number of cells grows evenly; every other step halves.
    for (bool halves = false; bracket.width() > 1; halves = !halves) {
        const std::uint64_t count = halves ? bracket.middle() : bracket.interpolated(limit);
        std::vector<std::uint8_t> marks = marks_of(count);
        const std::uint64_t cells = cells_after(marks);
        if (cells <= limit) {
            bracket.fitting = count;
            bracket.cells_fitting = cells;
            best = std::move(marks);
        } else {
            bracket.exceeding = count;
            bracket.cells_exceeding = cells;
        }
    }
    return best;
}

/// Collective, within a transaction. Returns ranks above 0, which descend with the number of the
/// cell, for the cells with the longest of the lengths of cells that are not in `best`, else 0.
std::vector<double> ranks_by_number(const AdaptiveMesh& mesh, std::span<const double> lengths,
                                    const std::vector<std::uint8_t>& best) {
    const Communicator& processes = mesh.processes();
    const std::vector<std::uint64_t> numbers = mesh.cell_numbers();
    std::vector<double> ranks(lengths.size(), 0);
    // Positive doubles have the order of their bits.
    std::uint64_t longest = 0;
    for (std::size_t c = 0; c < lengths.size(); ++c) {
        if (best[c] == 0) longest = std::max(longest, std::bit_cast<std::uint64_t>(lengths[c]));
    }
    longest = processes.max(longest);
    const std::uint64_t all = processes.sum(lengths.size());
    for (std::size_t c = 0; c < lengths.size(); ++c) {
        const bool is_longest = std::bit_cast<std::uint64_t>(lengths[c]) == longest;
        if (is_longest && best[c] == 0 && longest != 0) {
            ranks[c] = static_cast<double>(all - numbers[c]);
        }
    }
    return ranks;
}

}  // namespace

std::uint64_t AdaptiveMesh::cells_after(std::span<const std::uint8_t> marks,
                                        const StepOptions& options) {
    const StandardArithmetic standard;
    const Phase phase(processes(), "predict");
    return processes().transaction([&] {
        check_same(processes(), options);
        check_closure(*state_, options);
        const MarkedCells marked = marked_by_bytes(state_->mesh, marks);
        RefineOptions without_limit = level_options(options);
        without_limit.max_cells = std::numeric_limits<std::uint64_t>::max();
        if (options.closure == Closure::regular) {
            return cells_after_regular_step(*state_, marked, without_limit);
        }
        return cells_after_level(state_->mesh, marked, without_limit);
    });
}

std::vector<std::uint8_t> AdaptiveMesh::marks_within(std::span<const std::uint8_t> marks,
                                                     std::uint64_t cells,
                                                     const StepOptions& options) {
    const auto after = [&](std::span<const std::uint8_t> trial) {
        return cells_after(trial, options);
    };
    return processes().transaction([&] {
        processes().check_same("cells", std::to_string(cells));
        if (after(marks) <= cells) return std::vector<std::uint8_t>(marks.begin(), marks.end());
        std::vector<double> lengths = cell_values(Expression("longest"));
        for (std::size_t c = 0; c < lengths.size(); ++c) {
            if (marks[c] == 0) lengths[c] = 0;
        }
        const std::vector<std::uint8_t> none(lengths.size(), 0);
        if (after(none) > cells) return none;
        const std::vector<std::uint8_t> best =
            add_by_rank(processes(), none, lengths, cells, after);
        return add_by_rank(processes(), best, ranks_by_number(*this, lengths, best), cells, after);
    });
}

}  // namespace octetra::distributed
