#pragma once

#include <string>
#include <vector>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/group_names.hpp>
#include <octetra/quality/mesh_statistics.hpp>

/// Mesh statistics for people and for programs.
///
/// The JSON is one object. Names stay; new ones may be added. Numbers are as measured, written so
/// that they read back to the same bits; null stands for what a mesh without cells does not have,
/// and for a number that is not finite.
///
///     counts               vertices, edges, faces, cells, boundary_faces, nonmanifold_faces,
///                          listed_facets, listed_edges, unused_vertices, components,
///                          euler_characteristic: integers; see EntityCounts
///     bounding_box         {low: [x, y, z], high: [x, y, z]}, or null
///     volume               of all cells
///     boundary_area        of all faces of exactly one cell
///     regions              [{tag, cells, volume}, ...] ascending by tag; [] without tags; of a
///                          group that has one also its name
///     facet_markers        [{marker, facets, area}, ...] ascending by marker, of tagged facets;
///                          likewise
///     edge_markers         [{marker, edges, length}, ...] of tagged edges; likewise
///     features             {corners, required_vertices, ridges, required_edges, required_facets,
///                          required_cells}: how many
///     edge_length          {min, max}, or null
///     cell_volume          {min, max}, or null
///     face_angle           {min, max} in degrees, or null
///     dihedral_angle       {min, max} in degrees, or null
///     eta                  {min, mean, max}, or null; 1 is a regular tetrahedron
///     dihedral_histogram   {low, high, counts: [...]}: bins of equal width over low..high degrees
///     eta_histogram        likewise
///     adjacency            cells_per_edge, cells_per_vertex, edges_per_vertex, faces_per_edge
///                          (means), max_cells_at_edge, max_cells_at_vertex; or null
///     history              of a checkpoint alone: {steps: [{cells_before, cells_cut, bytes}, ...],
///                          fields: [{name, on: "vertices" or "cells", components}, ...]}
namespace octetra::cli {

/// Lines of at most 80 columns, numbers with six significant digits.
[[nodiscard]] std::string format_table(const quality::MeshStatistics& statistics,
                                       const std::vector<GroupName>& names = {});

/// Indented JSON, and a line end; of a checkpoint with what it tells of its history.
[[nodiscard]] std::string format_json(const quality::MeshStatistics& statistics,
                                      const CheckpointFacts* checkpoint = nullptr,
                                      const std::vector<GroupName>& names = {});

/// The same, to stdout. Throws std::system_error where that fails.
void print_table(const quality::MeshStatistics& statistics, const std::vector<GroupName>& names);
void print_json(const quality::MeshStatistics& statistics, const CheckpointFacts* checkpoint,
                const std::vector<GroupName>& names);
/// The steps and fields of a checkpoint, to stdout.
void print_history(const CheckpointFacts& facts);

}  // namespace octetra::cli
