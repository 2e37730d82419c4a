#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/repeated_cells.hpp>

#include "files/checks/cell_check.hpp"
#include "files/checks/conflicts.hpp"
#include "files/checks/tagged_entities.hpp"
#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/line_reader.hpp"
#include "files/shares/shares.hpp"
#include "files/tetgen/lines.hpp"
#include "files/tetgen/tetgen.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace tetgen;

/// The entries of a file that this process reads: all lines after the header or, if several
/// processes read the file, its share of them.
class Entries {
public:
    /// `reader`: on the header line, which announces `count` entries; it must outlive the object.
    Entries(LineReader& reader, std::uint64_t count, const ProcessGroup& group)
        : reader_(&reader), count_(count), room_(count), group_(&group) {
        if (!is_share()) return;
        const FileRange lines{reader.next_position(), reader.file_size()};
        const FileRange share = share_of_lines(reader.path(), lines, group.rank(), group.size());
        room_ = room_for(count, share, lines);
        reader.seek(share.begin, share.end, 0);
    }

    /// The number of entries to make room for.
    [[nodiscard]] std::uint64_t room() const { return room_; }

    /// Collective. Reads the entries, each with its number and the fields read by
    /// read_entry(fields), `field_count` fields in total; calls complete() after each. Returns the
    /// number of the first entry of the file, 0 or 1: `index_base`, if that is known.
    [[nodiscard]] std::uint32_t read(std::size_t field_count,
                                     std::optional<std::uint32_t> index_base, auto&& read_entry,
                                     auto&& complete) {
        std::uint64_t first = index_base.value_or(0);
        std::uint64_t i = 0;
        for (; reader_->next(); ++i) {
            if (i == count_) {
                reader_->fail(fmt::format("more lines than the {} entries announced", count_));
            }
            Fields fields(*reader_);
            const std::uint64_t number = fields.unsigned_integer("the entry's number");
            if (i == 0 && (is_share() || (!index_base && number == 1))) first = number;
            if (number != i + first) {
                reader_->fail(
                    fmt::format("entry number {} expected, {} found{}", i + first, number,
                                i == 0 && !index_base ? "; numbering begins with 0 or 1" : ""));
            }
            read_entry(fields);
            fields.expect_end(field_count);
            complete();
        }
        if (is_share()) return common_base(i, first, index_base);
        if (i < count_) {
            reader_->fail(fmt::format("the file ends after {} of {} entries", i, count_));
        }
        return static_cast<std::uint32_t>(first);
    }

private:
    [[nodiscard]] bool is_share() const { return group_->size() > 1; }
    /// Collective. Returns the number of the first entry of the file. Throws unless the numbers of
    /// this process, which are consecutive and begin with `first`, continue those of lower ranks.
    [[nodiscard]] std::uint32_t common_base(std::uint64_t read, std::uint64_t first,
                                            std::optional<std::uint32_t> index_base) const {
        const std::uint64_t before = number_share(*group_, read, count_);
        const std::uint64_t found = group_->sum(before == 0 && read > 0 ? first : 0);
        const std::uint64_t base = index_base.value_or(static_cast<std::uint32_t>(found));
        if (found > 1 || (read > 0 && first != before + base)) {
            reader_->fail("the entries are not numbered consecutively from 0 or 1");
        }
        return static_cast<std::uint32_t>(base);
    }

    LineReader* reader_;
    std::uint64_t count_;
    std::uint64_t room_;
    const ProcessGroup* group_;
};

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
    Entries entries(reader, head.count, growing.group());
    growing.expect_points(head.count, head.attributes, head.markers == 1, entries.room());
    Mesh& mesh = growing.mesh;
    mesh.index_base = entries.read(
        head.field_count(), std::nullopt, [&](Fields& fields) { read_point(fields, head, mesh); },
        [&] { growing.point_complete(); });
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
    Entries entries(reader, head.count, growing.group());
    growing.expect(cell_kind, head.count, head.attributes == 1, entries.room());
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
        (void)entries.read(head.field_count(), mesh.index_base, read_cell, complete);
    } catch (const InputError&) {
        if (cells) cells->check_entities();  // an error in an earlier line takes precedence
        throw;
    }
    growing.all_complete(cell_kind);
    if (cells) cells->finish(options);
}

/// Collective. Returns whether the lines of a file end with adjacent cells, given whether those of
/// this process do. Throws if only those of some processes do.
bool have_adjacent_cells(std::optional<bool> here, const ProcessGroup& group) {
    const std::uint64_t with = group.sum(here == true ? 1 : 0);
    const std::uint64_t without = group.sum(here == false ? 1 : 0);
    if (with > 0 && without > 0) throw InputError("adjacent cells of some entries only");
    return with > 0;
}

/// Reads a `.face` or `.edge` file: entities of N vertices.
template <class I, std::size_t N>
void read_entities(const fs::path& path, std::string_view name, const EntityKind<I, N>& kind,
                   const ReadOptions& options, GrowingMesh& growing) {
    LineReader reader(path);
    const ListHead head = read_list_head(reader, N);
    Entries entries(reader, head.count, growing.group());
    growing.expect(kind, head.count, head.markers == 1, entries.room());
    const NumberedVertices numbers = vertex_numbers(growing);
    Mesh& mesh = growing.mesh;
    std::optional<bool> has_adjacent_cells;  // determined by the first entry
    const auto read_entity = [&](Fields& fields) {
        read_tagged(fields, reader, name, kind, head, numbers, options.only_syntax, mesh);
        if (!has_adjacent_cells) has_adjacent_cells = ends_with_adjacent_cells<N>(fields, head);
        if (*has_adjacent_cells) skip_adjacent_cells<N>(fields);
    };
    (void)entries.read(1 + N + head.markers, mesh.index_base, read_entity,
                       [&] { growing.entity_complete(kind); });
    growing.all_complete(kind);
    if (have_adjacent_cells(has_adjacent_cells, growing.group())) {
        options.note(note_on_adjacent_cells(path, name));
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

void require_companion(const fs::path& path, const fs::path& other) {
    if (!is_there(other) && is_there(path)) {
        throw InputError(
            fmt::format("{}: the accompanying file {} is missing", path.native(), other.native()));
    }
}

}  // namespace

void read_tetgen(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
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
}

}  // namespace octetra
