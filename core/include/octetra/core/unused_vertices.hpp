#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

namespace octetra {

/// Removes the vertices of no cell from a mesh in which every facet and edge belongs to a cell,
/// with their markers, attributes and features. The other vertices keep their order and are
/// renumbered. Returns the number of removed vertices.
std::uint64_t drop_unused_vertices(Mesh& mesh);

}  // namespace octetra
