#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"
#include "properties/small_complexes.hpp"

/// Nearly regular cells, glued together or apart, whose edges have any prescribed order by length.
/// Coordinates are whole numbers of at most 22 bits.
namespace octetra::properties {

/// Up to three cells with the given orders of their edges. A cell lists first what it shares with
/// previous cells: nothing; vertex 0; the ends of the edge 01; or a face of the first cell,
/// anticlockwise as seen from outside. New vertices ascend. The order of a cell at a face refers to
/// its corners named so that the edges 01, 02 and 12, those of the face, descend.
[[nodiscard]] Mesh glued(const Complex& complex, const std::vector<Order>& orders);

}  // namespace octetra::properties
