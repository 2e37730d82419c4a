#pragma once

#include <string>

#include <octetra/core/mesh.hpp>

#include "coarsening/lineage.hpp"
#include "coarsening/staying.hpp"
#include "findings/findings.hpp"

/// The checks of what coarsening has left. Each adds its violations to the findings and returns its
/// note. Of the mesh after they ask only that its numbers are in range.
namespace octetra::verify {

/// Of each vertex of the mesh after, that of the lineage; none() if there is none.
using VertexMatch = IndexVector<VertexIndex, VertexIndex>;

/// The vertices of the mesh after are those that stay. Fills `match`: by number, if they are those
/// that stay, in order; else by place, those that stay first.
std::string check_staying(const Lineage& lineage, const Remainder& rest, const Mesh& after,
                          VertexMatch& match, Findings& findings);

/// Each cell of the mesh after is one of the mesh before, or is cut into such by bisections at
/// vertices of the mesh before, or into eight; and each of them has it among its ancestors' pieces,
/// not more than so many steps back.
std::string check_unions(const Lineage& lineage, int levels, const Mesh& after,
                         const VertexMatch& match, Findings& findings);

/// Each cell of the mesh after is one of those that the steps make of the vertices that stay.
std::string check_pieces(const Remainder& rest, const Mesh& after, const VertexMatch& match,
                         Findings& findings);

}  // namespace octetra::verify
