#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/maps.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "properties/histories/ancestries.hpp"

/// Values of a program on vertices and cells, transferred through the steps of a history.
namespace octetra::properties {

/// The values of a process, by local index.
struct CarriedValues {
    std::vector<double> of_vertices;  ///< a piecewise linear function
    std::vector<double> of_cells;     ///< distributed in proportion to volume, and summed
};

/// A whole number for each vertex and each cell of the input; repeated halves of it are exact.
[[nodiscard]] double value_of_input_vertex(std::uint64_t number);
[[nodiscard]] double value_of_root(std::uint64_t root);

/// The values of a mesh to which no step has been applied.
[[nodiscard]] CarriedValues first_values(const distributed::AdaptiveMesh& mesh,
                                         const Ancestries& ancestries);
[[nodiscard]] CarriedValues after_step(CarriedValues values, const distributed::Adaptation& step);
/// Collective.
[[nodiscard]] CarriedValues moved(CarriedValues values, const distributed::Migration& move);

/// Fields to be saved with the mesh.
[[nodiscard]] std::vector<distributed::Field> fields_of(const CarriedValues& values);
/// The inverse of fields_of(), from the last two fields.
[[nodiscard]] CarriedValues values_of(const std::vector<distributed::Field>& fields);

/// The values of the whole mesh, in its order.
struct WholeValues {
    std::vector<double> of_vertices;
    std::vector<double> of_cells;
    std::string fault;  ///< set if a vertex has different values on two processes
};

/// Collective among the mesh's processes. Returns the values on the first one, whose `whole` is the
/// collected mesh; nothing on the others.
[[nodiscard]] WholeValues gather_values(const CarriedValues& values,
                                        const distributed::AdaptiveMesh& mesh, const Mesh& whole);

/// On the first rank: describes a wrong value on a mesh that descends from this input, or returns
/// an empty string. Midpoints have the mean of their ends. A cell has a fraction of its root's
/// value in proportion to its volume; coordinates multiplied by `scale` are integers of at most 40
/// bits.
[[nodiscard]] std::string fault_of_values_on(const Mesh& mesh, const RefinementMaps& maps,
                                             const Mesh& input, const WholeValues& values,
                                             double scale);

}  // namespace octetra::properties
