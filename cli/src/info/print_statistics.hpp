#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/group_names.hpp>
#include <octetra/quality/mesh_statistics.hpp>

/// Output of mesh statistics as a table or JSON.
///
/// The JSON text is one object. Names are stable; new ones may be added. Numbers are printed such
/// that they read back to the same bits; null represents values that a mesh without cells does not
/// have, and numbers that are not finite.
///
///     counts               vertices, edges, faces, cells, boundary_faces, nonmanifold_faces,
///                          listed_facets, listed_edges, unused_vertices, components,
///                          euler_characteristic: integers; see EntityCounts
///     bounding_box         {low: [x, y, z], high: [x, y, z]}, or null
///     volume               of all cells
///     boundary_area        of all faces of exactly one cell
///     regions              [{tag, cells, volume}, ...] ascending by tag; [] without tags; also the
///                          name of the group, if it has one
///     facet_markers        [{marker, facets, area}, ...] of tagged facets, ascending by marker;
///                          also names
///     edge_markers         [{marker, edges, length}, ...] of tagged edges; also names
///     features             {corners, required_vertices, ridges, required_edges, required_facets,
///                          required_cells}: numbers of entities
///     edge_length          {min, max}, or null
///     cell_volume          {min, max}, or null
///     face_angle           {min, max} in degrees, or null
///     dihedral_angle       {min, max} in degrees, or null
///     eta                  {min, mean, max}, or null; 1 is a regular tetrahedron
///     dihedral_histogram   {low, high, counts: [...]}: bins of equal width over low..high degrees
///     eta_histogram        as above, of eta
///     adjacency            cells_per_edge, cells_per_vertex, edges_per_vertex, faces_per_edge
///                          (means), max_cells_at_edge, max_cells_at_vertex; or null
///     history              only for a checkpoint: {steps: [{cells_before, cells_cut, bytes}, ...],
///                          levels: [{step, vertices}, ...] for multigrid, from the input on,
///                          fields: [{name, on: "vertices" or "cells", components}, ...]}
namespace octetra::cli {

/// A level for multigrid solvers: the mesh after the first steps of the history.
struct LevelFacts {
    std::size_t step = 0;  ///< number of those steps
    std::uint64_t vertices = 0;
};

struct History {
    CheckpointFacts facts;
    std::vector<LevelFacts> levels;
};

/// Returns lines of at most 80 columns, with numbers of six significant digits.
[[nodiscard]] std::string format_table(const quality::MeshStatistics& statistics,
                                       const std::vector<GroupName>& names = {});

/// Returns indented JSON with a line end, including the history of a checkpoint.
[[nodiscard]] std::string format_json(const quality::MeshStatistics& statistics,
                                      const History* history = nullptr,
                                      const std::vector<GroupName>& names = {});

/// As above, to stdout. Throws std::system_error if writing fails.
void print_table(const quality::MeshStatistics& statistics, const std::vector<GroupName>& names);
void print_json(const quality::MeshStatistics& statistics, const History* history,
                const std::vector<GroupName>& names);
/// Prints the steps, levels and fields of a checkpoint to stdout.
void print_history(const History& history);

}  // namespace octetra::cli
