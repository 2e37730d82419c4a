#include <array>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/checks/cell_check.hpp"
#include "files/checks/conflicts.hpp"
#include "files/checks/repeated_cells.hpp"
#include "files/checks/tagged_entities.hpp"
#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/line_reader.hpp"
#include "files/tetgen/tetgen.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// The numbers of a header line; those that the line leaves out have TetGen's defaults.
template <std::size_t N>
std::array<std::uint64_t, N> read_header(LineReader& reader,
                                         const std::array<std::string_view, N>& names,
                                         const std::array<std::uint64_t, N>& defaults) {
    if (!reader.next()) reader.fail("the file ends before its header line");
    Fields fields(reader);
    std::array<std::uint64_t, N> values = defaults;
    for (std::size_t k = 0; k < N && (k == 0 || !fields.at_end()); ++k) {
        values[k] = fields.unsigned_integer(names[k]);
    }
    fields.expect_end(N);
    return values;
}

/// Reads the rest of the file: `count` lines, each with its number and what read_entry(fields)
/// takes, `field_count` fields in all; complete() follows each. Returns the first entry's number: 0
/// or 1.
std::uint32_t read_entries(LineReader& reader, std::uint64_t count, std::size_t field_count,
                           std::optional<std::uint32_t> index_base, auto&& read_entry,
                           auto&& complete) {
    std::uint32_t first = index_base.value_or(0);
    for (std::uint64_t i = 0; i < count; ++i) {
        if (!reader.next()) {
            reader.fail(fmt::format("the file ends after {} of {} entries", i, count));
        }
        Fields fields(reader);
        const std::uint64_t number = fields.unsigned_integer("the entry's number");
        if (i == 0 && !index_base && number == 1) first = 1;
        if (number != i + first) {
            reader.fail(fmt::format("entry number {} expected, {} found{}", i + first, number,
                                    i == 0 && !index_base ? "; numbering begins with 0 or 1" : ""));
        }
        read_entry(fields);
        fields.expect_end(field_count);
        complete();
    }
    if (reader.next()) reader.fail(fmt::format("more lines than the {} entries announced", count));
    return first;
}

/// The line on which an entry of a file stands. (Reads it again: only errors ask.)
std::uint64_t line_of_entry(const fs::path& path, std::uint64_t entry) {
    LineReader reader(path);
    for (std::uint64_t line = 0; line < entry + 2; ++line) (void)reader.next();  // the header, too
    return reader.line_number();
}

[[noreturn]] void fail_entry(const fs::path& path, std::uint64_t entry, std::string_view what) {
    LineReader(path).fail(what, line_of_entry(path, entry));
}

LineOf lines_of(const fs::path& path) {
    return [path](std::uint64_t entry) { return line_of_entry(path, entry); };
}

/// What files call the vertices of a mesh: `count` numbers from `first`.
struct NumberedVertices {
    std::uint64_t first;
    std::uint64_t count;
};

NumberedVertices vertex_numbers(const GrowingMesh& growing) {
    return {growing.mesh.index_base, growing.facts().vertices};
}

[[noreturn]] void refuse_vertex(std::uint64_t number, const LineReader& reader,
                                NumberedVertices numbers) {
    reader.fail(fmt::format("there is no vertex {}: the {} vertices are numbered from {}", number,
                            numbers.count, numbers.first));
}

VertexIndex read_vertex(Fields& fields, const LineReader& reader, NumberedVertices numbers) {
    const std::uint64_t number = fields.unsigned_integer("a vertex number");
    const std::uint64_t index = number - numbers.first;  // wraps round below the first
    if (index >= numbers.count) refuse_vertex(number, reader, numbers);
    return VertexIndex{index};
}

void read_node(const fs::path& path, GrowingMesh& growing) {
    LineReader reader(path);
    const auto header = read_header<4>(reader,
                                       {"the number of vertices", "the dimension",
                                        "the number of attributes per vertex", "the markers flag"},
                                       {0, 3, 0, 0});
    const std::uint64_t count = header[0];
    const std::uint64_t dimension = header[1];
    const std::uint64_t attributes = header[2];
    const std::uint64_t markers = header[3];
    if (dimension != 3) reader.fail(fmt::format("dimension 3 expected, {} found", dimension));
    if (markers > 1) reader.fail(fmt::format("the markers flag is 0 or 1, not {}", markers));
    constexpr std::uint64_t most_attributes = 1000;
    if (attributes > most_attributes) {
        reader.fail(fmt::format("{} attributes per vertex; at most {} are supported", attributes,
                                most_attributes));
    }
    const std::size_t field_count = 4 + attributes + markers;
    reader.check_count(count, field_count, "vertices");

    growing.expect_points(count, attributes, markers == 1);
    Mesh& mesh = growing.mesh;
    const auto read_point = [&](Fields& fields) {
        const double x = fields.coordinate("x");
        const double y = fields.coordinate("y");
        const double z = fields.coordinate("z");
        mesh.points.push_back({x, y, z});
        for (std::uint64_t k = 0; k < attributes; ++k) {
            mesh.point_attributes.push_back(fields.real("an attribute of the vertex"));
        }
        if (markers == 1) mesh.point_markers.push_back(fields.marker("the vertex's marker"));
    };
    mesh.index_base = read_entries(reader, count, field_count, std::nullopt, read_point,
                                   [&] { growing.point_complete(); });
    growing.points_complete();
}

void read_ele(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
    LineReader reader(path);
    const auto header = read_header<3>(reader,
                                       {"the number of cells", "the number of vertices per cell",
                                        "the number of attributes per cell"},
                                       {0, 4, 0});
    const std::uint64_t count = header[0];
    const std::uint64_t corners = header[1];
    const std::uint64_t attributes = header[2];
    if (corners == 10) {
        reader.fail(
            "these are second-order cells (10 vertices each); only those with 4 are "
            "supported");
    }
    if (corners != 4) reader.fail(fmt::format("4 vertices per cell expected, {} found", corners));
    if (attributes > 1) {
        reader.fail(fmt::format("{} attributes per cell; only one, the region tag, is supported",
                                attributes));
    }
    const std::size_t field_count = 5 + attributes;
    reader.check_count(count, field_count, "cells");

    growing.expect(cell_kind, count, attributes == 1);
    const NumberedVertices numbers = vertex_numbers(growing);
    Mesh& mesh = growing.mesh;
    CellCheck check(mesh, options);
    RepeatedCells repeated(options.only_syntax ? 0 : count);
    const auto read_cell = [&](Fields& fields) {
        CellVertices cell;
        for (VertexIndex& vertex : cell) vertex = read_vertex(fields, reader, numbers);
        const std::string_view wrong = check.judge(cell);
        if (!wrong.empty()) reader.fail(wrong);
        mesh.cells.push_back(cell);
        if (!options.only_syntax) repeated.add(cell);
        if (attributes == 1) mesh.regions.push_back(fields.marker("the region tag"));
    };
    read_entries(reader, count, field_count, mesh.index_base, read_cell,
                 [&] { growing.entity_complete(cell_kind); });
    growing.all_complete(cell_kind);
    if (check.fixed_count() > 0) {
        options.note(fmt::format("{}: {} inverted cells were turned round", path.native(),
                                 check.fixed_count()));
    }
    if (const CellPair pair = repeated.find(mesh); !pair.cell.is_none()) {
        fail_entry(path, pair.cell.value(), describe_repeated(pair, mesh, lines_of(path)));
    }
}

/// Reads a `.face` or `.edge` file: entities of N vertices each.
template <class I, std::size_t N>
void read_entities(const fs::path& path, std::string_view name, const EntityKind<I, N>& kind,
                   const ReadOptions& options, GrowingMesh& growing) {
    LineReader reader(path);
    const auto header =
        read_header<2>(reader, {"the number of entries", "the markers flag"}, {0, 0});
    const std::uint64_t count = header[0];
    const std::uint64_t markers = header[1];
    if (markers > 1) reader.fail(fmt::format("the markers flag is 0 or 1, not {}", markers));
    const std::size_t field_count = 1 + N + markers;
    reader.check_count(count, field_count, "entries");

    growing.expect(kind, count, markers == 1);
    const NumberedVertices numbers = vertex_numbers(growing);
    Mesh& mesh = growing.mesh;
    // With -nn TetGen adds the cells at each face (two) or edge (one), and tells nobody.
    constexpr std::size_t adjacent_cells = N == 3 ? 2 : 1;
    std::optional<bool> has_adjacent_cells;  // as the first entry has them
    const auto read_entity = [&](Fields& fields) {
        std::array<VertexIndex, N> vertices;
        for (VertexIndex& vertex : vertices) vertex = read_vertex(fields, reader, numbers);
        for (std::size_t k = 0; k < N; ++k) {
            if (!options.only_syntax && vertices[k] == vertices[(k + 1) % N]) {
                reader.fail(fmt::format("the {} has the same vertex twice", name));
            }
        }
        (mesh.*kind.list).push_back(vertices);
        if (markers == 1) (mesh.*kind.markers).push_back(fields.marker("the marker"));
        if (!has_adjacent_cells) {
            has_adjacent_cells = markers == 1 && fields.count_left() == adjacent_cells;
        }
        for (std::size_t k = 0; *has_adjacent_cells && k < adjacent_cells; ++k) {
            (void)fields.marker("an adjacent cell");
        }
    };
    read_entries(reader, count, field_count, mesh.index_base, read_entity,
                 [&] { growing.entity_complete(kind); });
    growing.all_complete(kind);
    if (has_adjacent_cells == true) {
        options.note(
            fmt::format("{}: the adjacent cells of each {} are not kept", path.native(), name));
    }
}

template <class I>
void refuse_if_wrong(const WrongEntry<I>& wrong, std::string_view name,
                     const IndexVector<I, Marker>& markers, const Mesh& mesh,
                     const fs::path& path) {
    if (wrong.entry.is_none()) return;
    fail_entry(path, wrong.entry.value(),
               describe_wrong(wrong, name, markers, mesh, lines_of(path)));
}

void check_facets(const Mesh& mesh, const fs::path& face, const fs::path& ele) {
    const WrongFacets wrong = find_wrong_facets(mesh);
    if (const CellIndex cell = wrong.overlap.cell; !cell.is_none()) {
        fail_entry(ele, cell.value(), describe_overlap(wrong, mesh, lines_of(ele)));
    }
    refuse_if_wrong(wrong.tagged, "face", mesh.facet_markers, mesh, face);
}

fs::path companion(fs::path path, std::string_view extension) {
    return path.replace_extension(extension);
}

/// Is there anything of this name? What is there but cannot be read must be opened, to be reported.
bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() != fs::file_type::not_found;
}

void require_companion(const fs::path& path, const fs::path& other) {
    if (!is_there(other) && is_there(path)) {
        throw InputError(fmt::format("{}: the file {} is missing, which belongs to it",
                                     path.native(), other.native()));
    }
}

/// Reads all files into `growing`.
void read_files(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
    const fs::path node = companion(path, ".node");
    const fs::path ele = companion(path, ".ele");
    if (!is_there(ele) && !is_there(node)) LineReader missing(path);  // says so by its name
    require_companion(ele, node);
    require_companion(node, ele);

    read_node(node, growing);
    read_ele(ele, options, growing);
    if (const fs::path face = companion(path, ".face"); is_there(face)) {
        read_entities(face, "face", facet_kind, options, growing);
        if (!options.only_syntax) check_facets(growing.mesh, face, ele);
    }
    if (const fs::path edge = companion(path, ".edge"); is_there(edge)) {
        read_entities(edge, "edge", edge_kind, options, growing);
        const Mesh& mesh = growing.mesh;
        const auto wrong = options.only_syntax ? WrongEntry<EdgeIndex>{} : find_wrong_edge(mesh);
        refuse_if_wrong(wrong, "edge", mesh.edge_markers, mesh, edge);
    }
    growing.finish();
}

}  // namespace

Mesh read_tetgen(const fs::path& path, const ReadOptions& options) {
    GrowingMesh growing(nullptr, false);
    read_files(path, options, growing);
    return std::move(growing.mesh);
}

void stream_tetgen(const fs::path& path, MeshSink& sink, const ReadOptions& options) {
    GrowingMesh growing(&sink, false);
    read_files(path, options, growing);
}

}  // namespace octetra
