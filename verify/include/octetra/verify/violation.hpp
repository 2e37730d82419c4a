#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/index.hpp>

/// What can be wrong with a mesh, with a mesh as the refinement of another, or with what coarsening
/// has left of one.
namespace octetra::verify {

enum class Code : std::uint8_t {
    // of any mesh
    vertex_out_of_range,  ///< a cell, facet or edge names a vertex that there is not
    list_length,          ///< a list of tags, markers or attributes has not one for each entity
    not_finite,           ///< a coordinate is infinite or not a number
    repeated_vertex,      ///< a cell, facet or edge has a vertex twice
    repeated_cell,        ///< two cells have the same vertices
    unused_vertex,        ///< in a refinement, a vertex of no cell that the coarse mesh has not
    coincident_vertices,  ///< two vertices at one place
    stray_facet,          ///< a tagged facet is a face of no cell
    stray_edge,           ///< a tagged edge is an edge of no cell
    conflicting_markers,  ///< a facet or edge is listed twice, with different markers
    inverted_cell,        ///< a cell of negative volume
    flat_cell,            ///< a cell of no volume
    face_of_many_cells,   ///< a face of three cells or more
    cells_on_one_side,    ///< two cells lie on the same side of their face
    hanging_vertex,       ///< a vertex on an edge or face of a cell that does not have it
    vertex_in_cell,       ///< a vertex inside a cell
    boundary_crosses,     ///< an edge meets a face, one of them on the boundary, not in a vertex
    // of a refinement
    lost_vertex,           ///< a vertex of the coarse mesh is not in the fine one
    not_a_midpoint,        ///< a new vertex halves no edge
    not_tiled,             ///< no fine cells fill this coarse cell
    cell_of_no_parent,     ///< a fine cell that is part of no coarse cell
    open_face,             ///< a fine face with one cell that is not on the coarse boundary
    boundary_moved,        ///< the pieces of a coarse boundary face have another area than it
    wrong_volume,          ///< the pieces of a coarse cell have another volume than it
    wrong_sum,             ///< a region has another volume, or a marker another area
    wrong_parent,          ///< the parent map names another coarse cell
    wrong_midpoint_edge,   ///< the parent map names another edge for a new vertex
    wrong_region,          ///< another region tag than the parent's
    wrong_facet_marker,    ///< another marker than the coarse facet's
    missing_facet,         ///< a piece of a tagged coarse facet is not tagged
    extra_facet,           ///< a tagged facet is no piece of a tagged coarse facet
    wrong_edge_marker,     ///< another marker than the coarse edge's
    missing_edge,          ///< a piece of a tagged coarse edge is not tagged
    extra_edge,            ///< a tagged edge is no piece of a tagged coarse edge
    wrong_vertex_marker,   ///< a vertex has not the marker that it inherits
    wrong_attribute,       ///< a vertex has not the attributes that it inherits
    face_angle_too_small,  ///< less than half of the smallest angle of the coarse face
    dihedral_too_small,    ///< less than the least dihedral angle that was asked for
    // of 8T-LE
    needless_bisection,  ///< an edge is bisected that the closure does not mark
    missing_bisection,   ///< an edge is not bisected that the closure marks
    wrong_pattern,       ///< the right edges are bisected, but in a wrong order
    // of coarsening
    vertex_not_before,     ///< a vertex that the mesh before has not
    vertex_went,           ///< a vertex is gone that the rules keep
    vertex_stayed,         ///< a vertex is still there, and nothing keeps it
    cell_not_before,       ///< a cell that is neither one of the mesh before nor a union of such
    too_many_generations,  ///< a cell went back by more steps than were asked for
};
inline constexpr std::size_t code_count = static_cast<std::size_t>(Code::too_many_generations) + 1;

/// The code as it stands in reports: its name above.
[[nodiscard]] std::string_view name(Code code);

/// A mesh judged alone counts as fine; so does one after coarsening, of which coarse is the input.
enum class Which : std::uint8_t { fine, coarse, before };

/// Something in a mesh: a tagged entity, vertex or cell by its number, or a face, edge or piece of
/// a cell by its vertices. Numbers count from 0.
struct Entity {
    enum class Kind : std::uint8_t { vertex, cell, facet, tagged_edge, face, edge, piece };
    Kind kind = Kind::vertex;
    Which mesh = Which::fine;
    std::uint32_t number = 0;           ///< of a vertex, cell, facet or tagged edge
    std::vector<VertexIndex> vertices;  ///< of a face, an edge or a piece

    friend bool operator==(const Entity&, const Entity&) = default;
};

/// One thing that is wrong, in terms that explain it.
struct Violation {
    Code code{};
    std::vector<Entity> entities;
    std::string found;
    std::string expected;
};

}  // namespace octetra::verify
