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

/// How many bytes are compressed at a time: what a reader can skip to.
constexpr std::size_t vtu_block_size = std::size_t{1} << 17U;

/// One array of a .vtu file: what the XML says of it, and where its values come from.
struct VtuArray {
    std::string name;
    const char* type = "";  ///< VTK's name of it
    std::size_t value_size = 0;
    std::size_t components = 1;         ///< as the XML declares them
    std::size_t values_per_entity = 1;  ///< these, or 4 for the connectivity, a flat list
    std::uint64_t entities = 0;
    /// Collective. The bytes of this process's slice.
    std::function<void(const Window&, std::vector<char>&)> bytes_of_slice;

    [[nodiscard]] std::size_t entity_size() const { return value_size * values_per_entity; }
};

/// Collective. Calls take(window, bytes) with this process's slices of an array, one after the
/// other through its stretch of the array, large enough to be few, small enough for a buffer.
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

/// What each point and each cell has beside its place, in the order of the file.
struct VtuData {
    std::vector<VtuArray> of_points;
    std::vector<VtuArray> of_cells;
    std::string point_attributes;  ///< what XML says of the points' arrays: which are global ids
};

[[nodiscard]] VtuArray vtu_coordinates(MeshSource& mesh);
/// The vertices of all entities of a list, by their numbers from 0.
template <std::size_t N>
[[nodiscard]] VtuArray vtu_connectivity(
    MeshSource& mesh, std::uint64_t count,
    std::span<const VertexNumbers<N>> (MeshSource::*list)(const Window&));
/// The markers of all entities of a list: 0 for each, if the mesh has none.
[[nodiscard]] VtuArray vtu_markers(MeshSource& mesh, std::uint64_t count, bool has_markers,
                                   std::span<const Marker> (MeshSource::*markers)(const Window&));
/// connectivity, offsets, types.
[[nodiscard]] std::vector<VtuArray> vtu_cells(MeshSource& mesh);

/// Markers, attributes, region tags and parents, as far as the mesh has them, and its fields. No
/// two arrays of points, or of cells, have one name: that of a field gets `_field` behind it.
[[nodiscard]] VtuData vtu_data(MeshSource& mesh);
/// These, and for a piece of a mesh the numbers of its vertices in the whole, and the piece's rank.
[[nodiscard]] VtuData vtu_data_of_piece(MeshSource& piece, int rank);

/// What of a name may not stand in XML, in XML's words.
[[nodiscard]] std::string xml_escaped(const std::string& text);

/// `type="..." Name="..." NumberOfComponents="..."`.
[[nodiscard]] std::string vtu_attributes(const VtuArray& array);

}  // namespace octetra
