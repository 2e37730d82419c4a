#pragma once

#include <string>

#include <octetra/core/mesh.hpp>

#include "coarsening/kept_vertices.hpp"
#include "coarsening/lineage.hpp"
#include "findings/findings.hpp"

/// Checks of a coarsened mesh. Each adds its violations to the findings and returns its note. They
/// require of the mesh after only that its numbers are in range.
namespace octetra::verify {

/// For each vertex of the mesh after, its vertex in the lineage; none() if there is none.
using VertexMatch = IndexVector<VertexIndex, VertexIndex>;

/// Checks that the vertices of the mesh after are those that are kept. Fills `match`: by number, if
/// the vertices are exactly those kept, in order; otherwise by coordinates, with preference for
/// kept vertices.
std::string check_kept_vertices(const Lineage& lineage, const Remainder& rest, const Mesh& after,
                                VertexMatch& match, Findings& findings);

/// Checks that each cell of the mesh after is a cell of the mesh before, or can be divided into
/// such cells by bisections at vertices of the mesh before, or into eight; and that it is at most
/// `levels` steps coarser than any of them.
std::string check_unions(const Lineage& lineage, int levels, const Mesh& after,
                         const VertexMatch& match, Findings& findings);

/// Checks that each cell of the mesh after is one that the steps create from the kept vertices.
std::string check_pieces(const Remainder& rest, const Mesh& after, const VertexMatch& match,
                         Findings& findings);

}  // namespace octetra::verify
