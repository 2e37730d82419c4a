#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/maps.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "properties/histories/pasts.hpp"

/// Values that a program has on vertices and cells, as they go along with the steps of a history.
namespace octetra::properties {

/// Of a process, by local number.
struct CarriedValues {
    std::vector<double> of_vertices;  ///< of a piecewise linear function
    std::vector<double> of_cells;     ///< divided by shares in the volume, and summed
};

/// A whole number for each vertex, and each cell, of an input: halves of halves of it are exact.
[[nodiscard]] double value_of_input_vertex(std::uint64_t number);
[[nodiscard]] double value_of_root(std::uint64_t root);

/// Of a mesh that nothing was done to.
[[nodiscard]] CarriedValues first_values(const distributed::AdaptiveMesh& mesh, const Pasts& pasts);
[[nodiscard]] CarriedValues after_step(CarriedValues values, const distributed::Adaptation& step);
/// Collective.
[[nodiscard]] CarriedValues moved(CarriedValues values, const distributed::Migration& move);

/// To save with the mesh.
[[nodiscard]] std::vector<distributed::Field> fields_of(const CarriedValues& values);
/// The last two.
[[nodiscard]] CarriedValues values_of(const std::vector<distributed::Field>& fields);

/// Of the whole mesh, in its order.
struct WholeValues {
    std::vector<double> of_vertices;
    std::vector<double> of_cells;
    std::string fault;  ///< where a vertex has different values on two processes
};

/// Collective among the mesh's processes. On the first one, whose `whole` is the mesh as it was
/// collected; nothing on the others.
[[nodiscard]] WholeValues of_the_whole(const CarriedValues& values,
                                       const distributed::AdaptiveMesh& mesh, const Mesh& whole);

/// On the first rank: what is wrong with values on a mesh that descends so from this input, or
/// nothing. Midpoints have the mean of their ends. A cell has the share of its root's value that it
/// has of its volume; coordinates times `scale` are integers of at most 40 bits.
[[nodiscard]] std::string fault_of_values_on(const Mesh& mesh, const RefinementMaps& maps,
                                             const Mesh& input, const WholeValues& values,
                                             double scale);

}  // namespace octetra::properties
