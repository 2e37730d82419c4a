#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"
#include "properties/small_complexes.hpp"

/// Nearly regular cells, glued together or apart, whose edges have any order by length that is
/// asked for. Coordinates are whole numbers of at most 22 bits.
namespace octetra::properties {

/// Up to three cells, each in the order of its edges that is given for it. A cell lists first what
/// it shares with those before it: nothing; vertex 0; the ends of the edge 01; or a face of the
/// first cell, which goes round anticlockwise as seen from outside. New vertices ascend. The order
/// of a cell at a face is for its corners named so that the edges 01, 02 and 12, those of the face,
/// descend.
[[nodiscard]] Mesh glued(const Complex& complex, const std::vector<Order>& orders);

}  // namespace octetra::properties
