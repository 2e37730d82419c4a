#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>

#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/in_order.hpp"
#include "files/input/line_reader.hpp"

/// The lines of TetGen files: the header line, and the fields of each further line.
namespace octetra::tetgen {

/// The header line of a `.node` file.
struct NodeHead {
    std::uint64_t count = 0;
    std::uint64_t attributes = 0;
    std::uint64_t markers = 0;  ///< 1: each vertex has a marker

    [[nodiscard]] std::size_t field_count() const { return 4 + attributes + markers; }
};

/// The header line of an `.ele` file.
struct EleHead {
    std::uint64_t count = 0;
    std::uint64_t attributes = 0;  ///< 1: each cell has a region tag

    [[nodiscard]] std::size_t field_count() const { return 5 + attributes; }
};

/// The header line of a `.face` or `.edge` file.
struct ListHead {
    std::uint64_t count = 0;
    std::uint64_t markers = 0;  ///< 1: each entry has a marker
};

/// Read a header line; throw for counts that the file cannot hold and for unsupported contents.
[[nodiscard]] NodeHead read_node_head(LineReader& reader);
[[nodiscard]] EleHead read_ele_head(LineReader& reader);
/// For a file whose entries have `vertices` vertices.
[[nodiscard]] ListHead read_list_head(LineReader& reader, std::size_t vertices);

/// The numbers of the vertices in files: `count` numbers from `first`.
struct NumberedVertices {
    std::uint64_t first;
    std::uint64_t count;
};

[[noreturn]] void refuse_vertex(std::uint64_t number, const LineReader& reader,
                                NumberedVertices numbers);

[[nodiscard]] inline VertexIndex read_vertex(Fields& fields, const LineReader& reader,
                                             NumberedVertices numbers) {
    const std::uint64_t number = fields.unsigned_integer("a vertex number");
    const std::uint64_t index = number - numbers.first;  // wraps around below the first
    if (index >= numbers.count) refuse_vertex(number, reader, numbers);
    return VertexIndex{index};
}

template <std::size_t N>
[[nodiscard]] std::array<VertexIndex, N> read_vertices(Fields& fields, const LineReader& reader,
                                                       NumberedVertices numbers) {
    return taken_in_order<N>([&] { return read_vertex(fields, reader, numbers); });
}

inline void read_point(Fields& fields, const NodeHead& head, Mesh& mesh) {
    const double x = fields.coordinate("x");
    const double y = fields.coordinate("y");
    const double z = fields.coordinate("z");
    mesh.points.push_back({x, y, z});
    for (std::uint64_t k = 0; k < head.attributes; ++k) {
        mesh.point_attributes.push_back(fields.real("an attribute of the vertex"));
    }
    if (head.markers == 1) mesh.point_markers.push_back(fields.marker("the vertex's marker"));
}

inline void read_region(Fields& fields, const EleHead& head, Mesh& mesh) {
    if (head.attributes == 1) mesh.regions.push_back(fields.marker("the region tag"));
}

/// The number of adjacent cells that TetGen appends to each face (two) or edge (one) with -nn,
/// without announcing them in the header.
template <std::size_t N>
inline constexpr std::size_t adjacent_cells = N == 3 ? 2 : 1;

/// Reads the vertices and the marker of a facet or edge, named `name` in messages.
template <class I, std::size_t N>
void read_tagged(Fields& fields, const LineReader& reader, std::string_view name,
                 const EntityKind<I, N>& kind, const ListHead& head, NumberedVertices numbers,
                 bool only_syntax, Mesh& mesh) {
    const auto vertices = read_vertices<N>(fields, reader, numbers);
    for (std::size_t k = 0; k < N; ++k) {
        if (!only_syntax && vertices[k] == vertices[(k + 1) % N]) {
            reader.fail(fmt::format("the {} has the same vertex twice", name));
        }
    }
    (mesh.*kind.list).push_back(vertices);
    if (head.markers == 1) (mesh.*kind.markers).push_back(fields.marker("the marker"));
}

/// Returns whether this line, from which a facet or edge and its marker have been read, ends with
/// as many fields as there are adjacent cells. If the first line does, all lines do.
template <std::size_t N>
[[nodiscard]] bool ends_with_adjacent_cells(const Fields& fields, const ListHead& head) {
    return head.markers == 1 && fields.count_left() == adjacent_cells<N>;
}
template <std::size_t N>
void skip_adjacent_cells(Fields& fields) {
    for (std::size_t k = 0; k < adjacent_cells<N>; ++k) (void)fields.marker("an adjacent cell");
}

[[nodiscard]] inline std::string note_on_adjacent_cells(const std::filesystem::path& path,
                                                        std::string_view name) {
    return fmt::format("{}: the adjacent cells of each {} are not kept", path.native(), name);
}

/// Returns `path` with another extension.
[[nodiscard]] std::filesystem::path companion(std::filesystem::path path,
                                              std::string_view extension);

/// Returns whether the path exists. An existing but unreadable file must be opened, so that it is
/// reported.
[[nodiscard]] bool is_there(const std::filesystem::path& path);

}  // namespace octetra::tetgen
