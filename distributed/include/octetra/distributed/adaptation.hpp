#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/entity_transfer.hpp>
#include <octetra/distributed/merged_values.hpp>
#include <octetra/distributed/refine.hpp>

namespace octetra::distributed {

/// A vertex that coarsening has removed: the midpoint of an edge whose ends remain.
struct RemovedVertex {
    VertexIndex before;  ///< its number before the step
    EdgeVertices ends;   ///< of the edge that it halved, by their numbers after the step
    /// A quarter of the volume of those cells of this process that had the vertex: this process's
    /// contribution to the integral of its hat function.
    double volume = 0;
};

/// The effect of a step of an AdaptiveMesh on this process's part: the map from all entities after
/// the step to those before it. All numbers are local. It stays valid independently of later
/// changes of the mesh. No function is collective.
///
/// In refinement, vertices keep their numbers, and new ones are appended, unless the closure is
/// Closure::regular: then they keep their order, and new ones are inserted. In coarsening, the
/// remaining vertices keep their order.
struct Adaptation {
    /// Whether anything changed on any process; the same on all.
    bool changed = false;
    EntityTransfer cells;   ///< the map of cells
    EntityTransfer facets;  ///< tagged ones
    EntityTransfer edges;   ///< tagged ones
    std::size_t vertex_count_before = 0;
    /// The ends of the edge of which each new vertex is the midpoint, lower first, by their numbers
    /// after the step. Unless there are vertices_before, the first new vertex has the number
    /// vertex_count_before.
    std::vector<EdgeVertices> new_vertex_ends;
    /// Coarsening and refinement with Closure::regular: the number of each vertex before the step;
    /// none() for new vertices.
    std::vector<VertexIndex> vertices_before;
    /// Coarsening only: the vertices of this process that were removed, ascending.
    std::vector<RemovedVertex> removed_vertices;
    SynchronisationCounts synchronisation;

    /// Returns whether the step was coarsening.
    [[nodiscard]] bool is_coarser() const { return cells.merges(); }

    /// Returns the number of vertices after the step.
    [[nodiscard]] std::size_t vertex_count() const {
        return vertices_before.empty() ? vertex_count_before + new_vertex_ends.size()
                                       : vertices_before.size();
    }

    /// Transfers a continuous, piecewise linear function (P1), given by `components` values for
    /// each vertex. A new vertex gets the mean of the ends of its edge, where the function has this
    /// value; other vertices keep their values. So refinement preserves the function, and
    /// coarsening interpolates it: its integral changes unless the function is linear near the
    /// removed vertices. transfer_conservatively() preserves the integral. T is a real or complex
    /// type. Throws std::invalid_argument if the values do not fit the mesh before the step, or for
    /// whole numbers in refinement, as these have no mean.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_vertices(std::vector<T> values,
                                                   std::size_t components = 1) const {
        check(values.size(), vertex_count_before, components);
        if (is_coarser()) return kept(std::move(values), components);
        if (std::is_integral_v<T>) {
            throw std::invalid_argument(
                "whole numbers of an edge's ends have no mean for its midpoint");
        }
        if (!vertices_before.empty()) return inserted(values, components);
        for (const EdgeVertices& ends : new_vertex_ends) append_mean(values, ends, components);
        return values;
    }

    /// Transfers values of cells, `components` for each. By default children get the value of their
    /// parent, and coarsening computes the mean weighted by volumes, which preserves the integral
    /// of a piecewise constant function up to rounding. Takes time proportional to the changed
    /// cells if the others keep their numbers. Throws std::invalid_argument if the values do not
    /// fit the mesh before the step, if T is not a number and values are to be divided or merged,
    /// and if a mean or fractions of whole numbers are requested.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_cells(std::vector<T> values, std::size_t components = 1,
                                                CellValues children = CellValues::copied) const {
        check(values.size(), cells.count_before(), components);
        constexpr bool is_number = requires(T value) { value += value / T(1U); };
        if (!is_number && (is_coarser() || children == CellValues::divided)) {
            throw std::invalid_argument("values of this type can only be copied");
        }
        if (std::is_integral_v<T> && (children == CellValues::averaged ||
                                      (children == CellValues::divided && !is_coarser()))) {
            throw std::invalid_argument("whole numbers cannot be averaged or divided");
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
        // The first child has the number of its parent, so its value is changed after all others
        // are computed.
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
    /// Appends the mean of the values of two vertices.
    template <class T>
    static void append_mean(std::vector<T>& values, const EdgeVertices& ends,
                            std::size_t components) {
        const auto& [a, b] = ends;
        for (std::size_t k = 0; k < components; ++k) {
            values.push_back(
                (values[a.value() * components + k] + values[b.value() * components + k]) /
                Real<T>(2));
        }
    }
    /// Returns the values with those of new vertices between them; the ends of an edge precede its
    /// midpoint.
    template <class T>
    std::vector<T> inserted(const std::vector<T>& values, std::size_t components) const {
        std::vector<T> after;
        after.reserve(vertices_before.size() * components);
        auto new_ends = new_vertex_ends.begin();
        for (const VertexIndex before : vertices_before) {
            if (before.is_none()) {
                append_mean(after, *new_ends++, components);
                continue;
            }
            for (std::size_t k = 0; k < components; ++k) {
                after.push_back(values[before.value() * components + k]);
            }
        }
        return after;
    }
    /// Vertices are ascending, so no value is overwritten before it is moved.
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
