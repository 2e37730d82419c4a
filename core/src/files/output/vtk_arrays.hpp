#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/mesh_source.hpp>

#include "files/output/text_slices.hpp"

namespace octetra {

/// The size of blocks that are compressed separately, and thus the granularity of random access.
constexpr std::size_t vtu_block_size = std::size_t{1} << 17U;

/// An array of a .vtu file: its declaration in XML and the source of its values.
struct VtuArray {
    std::string name;
    const char* type = "";  ///< VTK's name of the type
    std::size_t value_size = 0;
    std::size_t components = 1;         ///< as declared in XML
    std::size_t values_per_entity = 1;  ///< components, or 4 for the connectivity, a flat list
    std::uint64_t entities = 0;
    /// Collective. Returns the bytes of this process's slice.
    std::function<void(const Window&, std::vector<char>&)> bytes_of_slice;

    [[nodiscard]] std::size_t entity_size() const { return value_size * values_per_entity; }
};

/// Collective. Calls take(window, bytes) for consecutive slices of this process's share of an
/// array, with buffers of at most about 2 MiB.
void for_each_slice(const VtuArray& array, const ProcessGroup& group, auto&& take) {
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 21U;
    const std::uint64_t length =
        std::max<std::uint64_t>(most_bytes / array.entity_size(), std::uint64_t{1});
    std::vector<char> bytes;
    for_each_piece(share_window(array.entities, group), length, [&](const Window& window) {
        array.bytes_of_slice(window, bytes);
        take(window, static_cast<const std::vector<char>&>(bytes));
    });
}

/// Data of points and cells other than coordinates and connectivity, in file order.
struct VtuData {
    std::vector<VtuArray> of_points;
    std::vector<VtuArray> of_cells;
    std::string point_attributes;  ///< XML attributes of the point data: the array of global ids
};

[[nodiscard]] VtuArray vtu_coordinates(MeshSource& mesh);
/// The vertex numbers of all entities of a list, counted from 0.
template <std::size_t N>
[[nodiscard]] VtuArray vtu_connectivity(
    MeshSource& mesh, std::uint64_t count,
    std::span<const VertexNumbers<N>> (MeshSource::*list)(const Window&));
/// The markers of all entities of a list; all 0 if the mesh has none.
[[nodiscard]] VtuArray vtu_markers(MeshSource& mesh, std::uint64_t count, bool has_markers,
                                   std::span<const Marker> (MeshSource::*markers)(const Window&));
/// Returns connectivity, offsets and types.
[[nodiscard]] std::vector<VtuArray> vtu_cells(MeshSource& mesh);

/// Returns the markers, attributes, region tags and parents that the mesh has, and its fields.
/// Names of point arrays are unique, as are those of cell arrays: `_field` is appended to the name
/// of a field if necessary.
[[nodiscard]] VtuData vtu_data(MeshSource& mesh);
/// As above, and for a piece of a mesh the global numbers of its vertices and its rank.
[[nodiscard]] VtuData vtu_data_of_piece(MeshSource& piece, int rank);

/// Escapes the characters that XML does not allow in attribute values.
[[nodiscard]] std::string xml_escaped(const std::string& text);

/// Returns `type="..." Name="..." NumberOfComponents="..."`.
[[nodiscard]] std::string vtu_attributes(const VtuArray& array);

}  // namespace octetra
