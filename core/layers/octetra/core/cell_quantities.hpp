#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/core/group_names.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/select_cells.hpp>

/// Values of the external terms of expressions.
namespace octetra {

/// Returns the generation of each cell: the greatest generation of its vertices. A vertex of the
/// input has generation 0, a midpoint one more than the greater one of its edge's ends. Vertex
/// first_midpoint + i is the midpoint of edge i.
[[nodiscard]] std::vector<double> generations_of(std::span<const CellVertices> cells,
                                                 std::size_t first_midpoint,
                                                 std::span<const EdgeVertices> midpoint_to_edge);

/// Returns the markers of facets that the name of a term denotes: the number that it is, or those
/// of the groups of facets with this name; none if there is no such group.
[[nodiscard]] std::vector<Marker> markers_of(const std::string& name,
                                             std::span<const GroupName> groups);
/// Throws InputError, which lists the markers and the groups of facets that exist.
[[noreturn]] void refuse_marker(const Term& term, const std::set<Marker>& markers,
                                std::span<const GroupName> groups);
/// Throws InputError, which lists the fields that exist.
[[noreturn]] void refuse_field(const Term& term, const std::vector<std::string>& fields);

/// The power of two by which lengths are divided so that `extent` is about 1.
[[nodiscard]] int exponent_of_extent(double extent);
[[nodiscard]] Point scaled_by(const Point& p, int exponent);

/// Returns the values of the external terms of a selection for a whole mesh with these maps from
/// its input. Throws InputError for fields, which a Mesh does not have, for background meshes and
/// graded sizes, and for markers that no facet has.
[[nodiscard]] TermValues term_values(const Selection& selection, const Mesh& mesh,
                                     const RefinementMaps& maps);

}  // namespace octetra
