#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/index.hpp>

/// Violations of a mesh, of a mesh as the refinement of another, or of a mesh as the result of
/// coarsening.
namespace octetra::verify {

enum class Code : std::uint8_t {
    // of any mesh
    vertex_out_of_range,  ///< a cell, facet or edge refers to a missing vertex
    list_length,          ///< a list of tags, markers or attributes has a wrong length
    not_finite,           ///< a coordinate is infinite or not a number
    repeated_vertex,      ///< a cell, facet or edge has a vertex twice
    repeated_cell,        ///< two cells have the same vertices
    unused_vertex,        ///< a vertex of no cell; in a refinement, also not coarse
    coincident_vertices,  ///< two vertices with the same coordinates
    stray_facet,          ///< a tagged facet is a face of no cell
    stray_edge,           ///< a tagged edge is an edge of no cell
    conflicting_markers,  ///< a facet or edge is listed twice, with different markers
    inverted_cell,        ///< a cell of negative volume
    flat_cell,            ///< a cell of no volume
    face_of_many_cells,   ///< a face of three cells or more
    cells_on_one_side,    ///< two cells lie on the same side of their face
    hanging_vertex,       ///< a vertex on an edge or face of a cell, but not its corner
    vertex_in_cell,       ///< a vertex inside a cell
    boundary_crosses,     ///< an edge and a face meet, one on the boundary, not in a vertex
    // of a refinement
    lost_vertex,           ///< a vertex of the coarse mesh is not in the fine one
    not_a_midpoint,        ///< a new vertex is no midpoint of an edge
    not_tiled,             ///< no fine cells fill this coarse cell
    cell_of_no_parent,     ///< a fine cell is not contained in a coarse cell
    open_face,             ///< a fine boundary face is not on the coarse boundary
    boundary_moved,        ///< the pieces of a coarse boundary face have a different area
    wrong_volume,          ///< the pieces of a coarse cell have a different volume
    wrong_sum,             ///< the volume of a region or the area of a marker differs
    wrong_parent,          ///< the parent map refers to a different coarse cell
    wrong_midpoint_edge,   ///< the map of midpoints refers to a different edge
    wrong_region,          ///< the region tag differs from that of the parent
    wrong_facet_marker,    ///< the marker differs from that of the coarse facet
    missing_facet,         ///< a piece of a tagged coarse facet is not tagged
    extra_facet,           ///< a tagged facet is not a piece of a tagged coarse facet
    wrong_edge_marker,     ///< the marker differs from that of the coarse edge
    missing_edge,          ///< a piece of a tagged coarse edge is not tagged
    extra_edge,            ///< a tagged edge is not a piece of a tagged coarse edge
    wrong_vertex_marker,   ///< a vertex does not have the inherited marker
    wrong_attribute,       ///< a vertex does not have the inherited attributes
    face_angle_too_small,  ///< less than half of the smallest angle of the coarse face
    dihedral_too_small,    ///< less than the requested lower bound
    // of 8T-LE
    needless_bisection,  ///< an edge is bisected although closure does not mark it
    missing_bisection,   ///< an edge is not bisected although closure marks it
    wrong_pattern,       ///< the right edges are bisected, but in a wrong order
    // of the regular closure
    bisected_transition_cell,  ///< a child of a cell with one to five bisected edges is bisected
    shape_beyond_certificate,  ///< outside the bounds certified for the coarse cell
    // of coarsening
    vertex_not_before,     ///< a vertex is not in the mesh before
    vertex_went,           ///< a vertex was removed although the rules keep it
    vertex_stayed,         ///< a vertex was kept although no rule requires it
    cell_not_before,       ///< a cell is no union of cells of the mesh before
    too_many_generations,  ///< a cell was coarsened by more steps than requested
};
inline constexpr std::size_t code_count = static_cast<std::size_t>(Code::too_many_generations) + 1;

/// Returns the code as it appears in reports: its name above.
[[nodiscard]] std::string_view name(Code code);

/// The mesh of an entity. A single mesh counts as fine; so does the mesh after coarsening, for
/// which the input is coarse.
enum class Which : std::uint8_t { fine, coarse, before };

/// A part of a mesh: a tagged entity, vertex or cell by number, or a face, edge or piece of a cell
/// by its vertices. Numbers count from 0.
struct Entity {
    enum class Kind : std::uint8_t { vertex, cell, facet, tagged_edge, face, edge, piece };
    Kind kind = Kind::vertex;
    Which mesh = Which::fine;
    std::uint32_t number = 0;           ///< of a vertex, cell, facet or tagged edge
    std::vector<VertexIndex> vertices;  ///< of a face, an edge or a piece

    friend bool operator==(const Entity&, const Entity&) = default;
};

/// A violation with its explanation.
struct Violation {
    Code code{};
    std::vector<Entity> entities;
    std::string found;
    std::string expected;
};

}  // namespace octetra::verify
