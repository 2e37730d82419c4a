#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/merged_values.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/distributed/succession.hpp>

namespace octetra::distributed {

/// A vertex that coarsening has removed: the midpoint of an edge whose ends stay.
struct RemovedVertex {
    VertexIndex before;  ///< the number that it had
    EdgeVertices ends;   ///< of the edge that it halved, by the numbers that they have now
    /// A quarter of the volume of those cells of this process that had the vertex: this process's
    /// part of the integral of its hat function.
    double volume = 0;
};

/// What a step of an AdaptiveMesh did to this process's part: for everything that there is now,
/// what it was before. All numbers are local. It stays valid whatever becomes of the mesh. No
/// function is collective.
///
/// Of refinement: vertices keep their numbers; new ones follow behind them. Of coarsening: the
/// vertices that stay keep their order.
struct Adaptation {
    /// Did anything change, on any process? The same on all.
    bool changed = false;
    Succession cells;
    Succession facets;  ///< tagged ones
    Succession edges;   ///< tagged ones
    std::size_t vertex_count_before = 0;
    /// The ends of the edge that each new vertex is the midpoint of, lower first: number
    /// vertex_count_before is that of the first.
    std::vector<EdgeVertices> new_vertex_ends;
    /// Of coarsening: for each vertex, the number that it had.
    std::vector<VertexIndex> vertices_before;
    /// After coarsening: the vertices of this process that were removed, ascending.
    std::vector<RemovedVertex> removed_vertices;
    SynchronisationCounts synchronisation;

    /// Was this coarsening?
    [[nodiscard]] bool is_coarser() const { return cells.merges(); }

    /// Values of a continuous, piecewise linear function (P1), `components` for each vertex: of new
    /// vertices the mean of the edge's ends, which is what the function is there; of vertices that
    /// stay, their own. Refinement so keeps the function, and coarsening interpolates it: its
    /// integral changes, unless it is linear where vertices went. transfer_conservatively() keeps
    /// the integral. T is a real or complex type. Takes the values, and gives them back with more
    /// behind, or fewer. Throws std::invalid_argument where they do not fit, or are to be refined
    /// and are whole numbers, which have no mean.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_vertices(std::vector<T> values,
                                                   std::size_t components = 1) const {
        check(values.size(), vertex_count_before, components);
        if (is_coarser()) return kept(std::move(values), components);
        if (std::is_integral_v<T>) {
            throw std::invalid_argument(
                "whole numbers of an edge's ends have no mean for its midpoint");
        }
        for (const auto& [a, b] : new_vertex_ends) {
            for (std::size_t k = 0; k < components; ++k) {
                values.push_back(
                    (values[a.value() * components + k] + values[b.value() * components + k]) /
                    Real<T>(2));
            }
        }
        return values;
    }

    /// Values of cells, `components` for each. By default children get the value of their parent,
    /// and coarsening takes the mean of the pieces weighted by volumes, so that the integral of a
    /// piecewise constant function is kept, but for rounding. Takes time in proportion to the cells
    /// that changed where they keep their numbers. Throws std::invalid_argument where the values do
    /// not fit, where T is no kind of number and they are to be divided or were pieces, and where
    /// they are whole numbers of which a mean or shares are wanted.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_cells(std::vector<T> values, std::size_t components = 1,
                                                CellValues children = CellValues::copied) const {
        check(values.size(), cells.count_before(), components);
        constexpr bool is_number = requires(T value) { value += value / T(1U); };
        if (!is_number && (is_coarser() || children == CellValues::divided)) {
            throw std::invalid_argument("values of this type can be copied, and nothing else");
        }
        if (std::is_integral_v<T> && (children == CellValues::averaged ||
                                      (children == CellValues::divided && !is_coarser()))) {
            throw std::invalid_argument("whole numbers cannot be averaged, nor divided");
        }
        if constexpr (is_number) {
            if (is_coarser()) return merged_values(values, components, cells, children);
        }
        const auto share = [&](const T& value, [[maybe_unused]] unsigned halvings) {
            if constexpr (is_number) {
                if (children == CellValues::divided) {
                    return static_cast<T>(value / static_cast<Real<T>>(1U << halvings));
                }
            }
            return value;
        };
        if (!cells.keeps_numbers()) {
            std::vector<T> after(cells.count() * components);
            cells.for_each_new([&](std::size_t number, std::size_t before, unsigned halvings) {
                for (std::size_t k = 0; k < components; ++k) {
                    after[number * components + k] =
                        share(values[before * components + k], halvings);
                }
            });
            return after;
        }
        values.resize(cells.count() * components);
        // The first piece of a cell has its place, so its value is changed when all others have
        // theirs.
        cells.for_each_new([&](std::size_t number, std::size_t before, unsigned halvings) {
            if (number == before) return;
            for (std::size_t k = 0; k < components; ++k) {
                values[number * components + k] = share(values[before * components + k], halvings);
            }
        });
        if (children != CellValues::divided) return values;
        cells.for_each_new([&](std::size_t number, std::size_t before, unsigned halvings) {
            if (number != before) return;
            for (std::size_t k = 0; k < components; ++k) {
                values[number * components + k] = share(values[number * components + k], halvings);
            }
        });
        return values;
    }

private:
    /// Vertices ascend, so no value is overwritten before it has its place.
    template <class T>
    std::vector<T> kept(std::vector<T> values, std::size_t components) const {
        for (std::size_t v = 0; v < vertices_before.size(); ++v) {
            for (std::size_t k = 0; k < components; ++k) {
                values[v * components + k] = values[vertices_before[v].value() * components + k];
            }
        }
        values.resize(vertices_before.size() * components);
        return values;
    }

    static void check(std::size_t size, std::size_t count, std::size_t components) {
        if (size != count * components) {
            throw std::invalid_argument("values do not fit the mesh as it was before the step");
        }
    }
};

}  // namespace octetra::distributed
