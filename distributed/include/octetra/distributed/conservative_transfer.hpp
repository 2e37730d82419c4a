#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>

namespace octetra::distributed {

/// Collective. Transfers a continuous, piecewise linear function (P1) from the mesh before `step`,
/// which must be the last step of `mesh`, to the mesh after it, and preserves its integral over the
/// whole mesh up to rounding. `values` has `components` values for each vertex of this process
/// before the step; the result has as many for each vertex after it.
///
/// Refinement preserves the function itself. Coarsening keeps the values of the remaining vertices
/// and adds a correction: with I the interpolation at the remaining vertices, P its prolongation to
/// the mesh before, and lumped masses M before and m after, the result is
/// I u + m^-1 P^T M (u - P I u). The deviation of the function from its interpolant at a removed
/// vertex is distributed in equal halves to the two ends of the edge that the vertex halved. A
/// function that is linear on the cells after the step is unchanged. The result may exceed the
/// range of the values before.
///
/// T is a floating-point or complex type. All copies of a vertex get equal values. Throws
/// InputError on all processes if on any process the values do not fit the mesh before the step, or
/// the step does not lead to the current mesh.
template <class T>
requires(std::floating_point<T> || is_complex<T>)
    [[nodiscard]] std::vector<T> transfer_conservatively(const AdaptiveMesh& mesh,
                                                         const Adaptation& step,
                                                         std::vector<T> values,
                                                         std::size_t components = 1) {
    return mesh.processes().transaction([&] {
        if (values.size() != step.vertex_count_before * components) {
            throw InputError("values do not fit the mesh as it was before the step");
        }
        const std::size_t count = step.vertex_count();
        if (count != mesh.points().size() || step.cells.count() != mesh.cells().size()) {
            throw InputError("the step did not lead to the current mesh");
        }
        std::vector<T> after = step.transfer_vertices(values, components);
        if (!step.is_coarser()) return after;
        std::vector<T> corrections(after.size(), T{});
        for (const auto& [before, ends, volume] : step.removed_vertices) {
            const auto& [a, b] = ends;
            for (std::size_t k = 0; k < components; ++k) {
                const T mean =
                    (after[a.value() * components + k] + after[b.value() * components + k]) /
                    Real<T>(2);
                const T half = (values[before.value() * components + k] - mean) *
                               static_cast<Real<T>>(volume / 2);
                corrections[a.value() * components + k] += half;
                corrections[b.value() * components + k] += half;
            }
        }
        const std::vector<double> volumes = mesh.vertex_volumes();
        combine_everywhere(mesh.processes(), mesh.vertex_sharing(), volumes.size(), corrections,
                           std::plus<>{}, components);
        for (std::size_t i = 0; i < after.size(); ++i) {
            if (corrections[i] == T{}) continue;
            after[i] += corrections[i] / static_cast<Real<T>>(volumes[i / components]);
        }
        return after;
    });
}

}  // namespace octetra::distributed
