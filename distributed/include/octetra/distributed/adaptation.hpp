#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/distributed/succession.hpp>

namespace octetra::distributed {

/// What the children of a cell get of a value that it had; and of values that pieces had, what
/// their whole gets.
enum class CellValues {
    copied,    ///< each the same, and the mean: an indicator, a level
    averaged,  ///< each the same, and the mean weighted by volumes: a density
    divided,   ///< by their shares in its volume, and the sum: a mass, a count
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
    SynchronisationCounts synchronisation;

    /// Was this coarsening?
    [[nodiscard]] bool is_coarser() const { return cells.merges(); }

    /// Values of a continuous, piecewise linear function (P1), `components` for each vertex: of new
    /// vertices the mean of the edge's ends, which is what the function is there; of vertices that
    /// stay, their own. Takes the values, and gives them back with more behind, or fewer. Throws
    /// std::invalid_argument where they do not fit.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_vertices(std::vector<T> values,
                                                   std::size_t components = 1) const {
        check(values.size(), vertex_count_before, components);
        if (is_coarser()) return kept(std::move(values), components);
        for (const auto& [a, b] : new_vertex_ends) {
            for (std::size_t k = 0; k < components; ++k) {
                values.push_back(
                    (values[a.value() * components + k] + values[b.value() * components + k]) / 2);
            }
        }
        return values;
    }

    /// Values of cells, `components` for each. Takes time in proportion to the cells that changed
    /// where they keep their numbers. Throws std::invalid_argument where the values do not fit, or
    /// T is no kind of number and they are to be divided or were pieces.
    template <class T>
    [[nodiscard]] std::vector<T> transfer_cells(std::vector<T> values, std::size_t components = 1,
                                                CellValues children = CellValues::copied) const {
        check(values.size(), cells.count_before(), components);
        constexpr bool is_number = requires(T value) { value += value / T(1U); };
        if (!is_number && (is_coarser() || children == CellValues::divided)) {
            throw std::invalid_argument("values of this type can be copied, and nothing else");
        }
        if constexpr (is_number) {
            if (is_coarser()) return merged(values, components, children);
        }
        const auto share = [&](const T& value, [[maybe_unused]] unsigned halvings) {
            if constexpr (is_number) {
                if (children == CellValues::divided) {
                    return static_cast<T>(value / static_cast<T>(1U << halvings));
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

    template <class T>
    std::vector<T> merged(const std::vector<T>& values, std::size_t components,
                          CellValues how) const {
        const auto whole_of = cells.whole_of();
        std::vector<std::uint8_t> pieces(cells.count(), 0);
        for (const std::uint32_t whole : whole_of) ++pieces[whole];
        std::vector<T> wholes(cells.count() * components);
        for (std::size_t c = 0; c < whole_of.size(); ++c) {
            const std::uint32_t whole = whole_of[c];
            for (std::size_t k = 0; k < components; ++k) {
                const T& value = values[c * components + k];
                T& sum = wholes[whole * components + k];
                if (pieces[whole] == 1) {
                    sum = value;
                } else if (how == CellValues::averaged) {
                    sum += value / static_cast<T>(1U << cells.halvings()[c]);
                } else if (how == CellValues::copied) {
                    sum += value / static_cast<T>(pieces[whole]);
                } else {
                    sum += value;
                }
            }
        }
        return wholes;
    }

    static void check(std::size_t size, std::size_t count, std::size_t components) {
        if (size != count * components) {
            throw std::invalid_argument("values do not fit the mesh as it was before the step");
        }
    }
};

}  // namespace octetra::distributed
