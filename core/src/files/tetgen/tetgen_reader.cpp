#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/repeated_cells.hpp>

#include "files/checks/cell_check.hpp"
#include "files/checks/conflicts.hpp"
#include "files/checks/tagged_entities.hpp"
#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/line_reader.hpp"
#include "files/tetgen/lines.hpp"
#include "files/tetgen/tetgen.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace tetgen;

/// Reads the rest of the file: `count` lines, each with its number and the fields read by
/// read_entry(fields), `field_count` fields in total; calls complete() after each. Returns the
/// number of the first entry: 0 or 1.
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

/// Advances the reader from the beginning of the file to the line of an entry. Used only for
/// errors.
void seek_entry(LineReader& reader, std::uint64_t entry) {
    for (std::uint64_t line = 0; line < entry + 2; ++line) (void)reader.next();  // and the header
}

[[noreturn]] void fail_entry(const fs::path& path, std::uint64_t entry, std::string_view what) {
    LineReader reader(path);
    seek_entry(reader, entry);
    reader.fail(what);
}

LineOf lines_of(const fs::path& path) {
    return [path](std::uint64_t entry) {
        LineReader reader(path);
        seek_entry(reader, entry);
        return reader.line_number();
    };
}

NumberedVertices vertex_numbers(const GrowingMesh& growing) {
    return {growing.mesh.index_base, growing.facts().vertices};
}

void read_node(const fs::path& path, GrowingMesh& growing) {
    LineReader reader(path);
    const NodeHead head = read_node_head(reader);
    growing.expect_points(head.count, head.attributes, head.markers == 1);
    Mesh& mesh = growing.mesh;
    mesh.index_base = read_entries(
        reader, head.count, head.field_count(), std::nullopt,
        [&](Fields& fields) { read_point(fields, head, mesh); }, [&] { growing.point_complete(); });
    growing.points_complete();
}

/// Checks the cells of an `.ele` file, in batches, while they are read.
class CellsOfFile {
public:
    CellsOfFile(Mesh& mesh, const fs::path& path, std::uint64_t count, const ReadOptions& options)
        : mesh_(&mesh), path_(&path), check_(mesh, options), repeated_(count) {}

    /// Called after a cell has been read.
    void cell_read() {
        if (mesh_->cells.size() - judged_ == at_once) check_entities();
    }
    /// Throws InputError if one of the cells read since the last call is invalid.
    void check_entities() {
        const auto cells = std::span(mesh_->cells).subspan(judged_);
        const auto [cell, wrong] = check_.check_entities(cells);
        if (!wrong.empty()) fail_entry(*path_, judged_ + cell, wrong);
        for (const CellVertices& vertices : cells) repeated_.add(vertices);
        judged_ = mesh_->cells.size();
    }
    /// Called after all cells have been read.
    void finish(const ReadOptions& options) {
        check_entities();
        if (check_.fixed_count() > 0) {
            options.note(fmt::format("{}: {} inverted cells were reversed", path_->native(),
                                     check_.fixed_count()));
        }
        const CellPair pair = repeated_.find(mesh_->cells, mesh_->points.size());
        if (pair.cell.is_none()) return;
        fail_entry(*path_, pair.cell.value(), describe_repeated(pair, *mesh_, lines_of(*path_)));
    }

private:
    static constexpr std::size_t at_once = 256;

    Mesh* mesh_;
    const fs::path* path_;
    CellCheck check_;
    RepeatedCells repeated_;
    std::size_t judged_ = 0;
};

void read_ele(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
    LineReader reader(path);
    const EleHead head = read_ele_head(reader);
    growing.expect(cell_kind, head.count, head.attributes == 1);
    const NumberedVertices numbers = vertex_numbers(growing);
    Mesh& mesh = growing.mesh;
    std::optional<CellsOfFile> cells;
    if (!options.only_syntax) cells.emplace(mesh, path, head.count, options);
    const auto read_cell = [&](Fields& fields) {
        mesh.cells.push_back(read_vertices<4>(fields, reader, numbers));
        read_region(fields, head, mesh);
    };
    const auto complete = [&] {
        growing.entity_complete(cell_kind);
        if (cells) cells->cell_read();
    };
    try {
        read_entries(reader, head.count, head.field_count(), mesh.index_base, read_cell, complete);
    } catch (const InputError&) {
        if (cells) cells->check_entities();  // an error in an earlier line takes precedence
        throw;
    }
    growing.all_complete(cell_kind);
    if (cells) cells->finish(options);
}

/// Reads a `.face` or `.edge` file: entities of N vertices.
template <class I, std::size_t N>
void read_entities(const fs::path& path, std::string_view name, const EntityKind<I, N>& kind,
                   const ReadOptions& options, GrowingMesh& growing) {
    LineReader reader(path);
    const ListHead head = read_list_head(reader, N);
    growing.expect(kind, head.count, head.markers == 1);
    const NumberedVertices numbers = vertex_numbers(growing);
    Mesh& mesh = growing.mesh;
    std::optional<bool> has_adjacent_cells;  // determined by the first entry
    const auto read_entity = [&](Fields& fields) {
        read_tagged(fields, reader, name, kind, head, numbers, options.only_syntax, mesh);
        if (!has_adjacent_cells) has_adjacent_cells = ends_with_adjacent_cells<N>(fields, head);
        if (*has_adjacent_cells) skip_adjacent_cells<N>(fields);
    };
    read_entries(reader, head.count, 1 + N + head.markers, mesh.index_base, read_entity,
                 [&] { growing.entity_complete(kind); });
    growing.all_complete(kind);
    if (has_adjacent_cells == true) options.note(note_on_adjacent_cells(path, name));
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

void require_companion(const fs::path& path, const fs::path& other) {
    if (!is_there(other) && is_there(path)) {
        throw InputError(
            fmt::format("{}: the accompanying file {} is missing", path.native(), other.native()));
    }
}

/// Reads all files into `growing`.
void read_files(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
    const fs::path node = companion(path, ".node");
    const fs::path ele = companion(path, ".ele");
    if (!is_there(ele) && !is_there(node)) LineReader missing(path);  // throws, naming the path
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
