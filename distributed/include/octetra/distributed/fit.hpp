#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <octetra/distributed/adaptive_mesh.hpp>

/// Refinement and coarsening of a mesh until its cells have a target size.
namespace octetra::distributed {

/// Must be the same on all processes.
struct FitOptions {
    StepOptions step;  ///< of the steps that refine; `is_last` must be false
    /// If set, cells may migrate before a step that refines; `may_forget_history` must be false.
    std::optional<BalanceOptions> balance;
    /// At most this many steps that refine in a sequence, and steps that coarsen in total.
    int levels = 50;
};

/// The numbers of cells of the whole mesh whose longest edge is not between half the target size
/// and the target size.
struct MisfitCells {
    std::uint64_t too_long = 0;
    std::uint64_t too_short = 0;
    /// Those of the cells that are too short which are roots: coarsening cannot merge them.
    std::uint64_t too_short_roots = 0;
};

/// Fits a mesh to a target size h of its cells, by steps that the caller follows with its own data:
///
///     Fit fit(mesh);
///     while (const auto step = fit.next(mesh.cell_values(size, fields))) {
///         // transfer the fields with step->move and step->step
///     }
///
/// First, cells with an edge longer than h are refined until there are none. Then cells are merged
/// if their longest edge is at most h/2; cells that this leaves longer than their target size are
/// refined again; and so on, until a round of both leaves as many cells as before. So at the end no
/// cell has an edge longer than h, unless `levels` steps in a sequence did not suffice, and no cell
/// can be merged. Cells shorter than h/2 remain where the input is finer, where a merged
/// cell would be too long, or where conformity requires them. The result is the same for any number
/// of processes. A second fit to the same sizes leaves the mesh unchanged, except that it may merge
/// and bisect again cells that lie between two sizes.
class Fit {
public:
    /// Refers to the mesh, which only the steps of this object should change. Not collective.
    explicit Fit(AdaptiveMesh& mesh, const FitOptions& options = {});
    ~Fit();
    Fit(Fit&&) noexcept;
    Fit& operator=(Fit&&) noexcept;
    Fit(const Fit&) = delete;
    Fit& operator=(const Fit&) = delete;

    /// Collective. Performs the next step. `sizes` has the target size of each cell of this process
    /// in the present mesh, above 0; infinity means no limit. Returns nothing on all processes when
    /// the mesh fits. Throws InputError on all processes for other sizes or another number of them,
    /// invalid or different options, and as AdaptiveMesh::refine() does.
    [[nodiscard]] std::optional<EvenStep> next(std::span<const double> sizes);

    /// Collective. Compares the cells of the present mesh with their target sizes.
    [[nodiscard]] MisfitCells misfit_cells(std::span<const double> sizes) const;

    /// The numbers of steps so far.
    [[nodiscard]] int refined() const;
    [[nodiscard]] int coarsened() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace octetra::distributed
