#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
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
#include "files/input/tokens.hpp"
#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"

namespace octetra {
namespace {

/// The first entry of a section with a vertex that there is not.
struct OutOfRange {
    std::uint64_t entry = 0;
    VertexIndex vertex;
};

/// Where the entries of a section were found.
struct Section {
    std::uint64_t keyword_line = 0;          ///< 0: there was no such section
    std::uint64_t first_line = 0;            ///< of the first entry
    bool consecutive = true;                 ///< entry i begins on line first_line + i
    std::optional<OutOfRange> out_of_range;  ///< looked for while streaming
};

class MeditReader {
public:
    /// Without a sink, reads the mesh into memory.
    MeditReader(const std::filesystem::path& path, const ReadOptions& options, MeshSink* sink,
                Streamed streamed = Streamed::everything)
        : reader_(path), tokens_(reader_), options_(&options), growing_(sink, true, streamed) {
        mesh_.index_base = 1;
    }

    /// Returns the mesh, if it is not streamed.
    Mesh read() {
        read_head();
        while (read_section()) {
        }
        if (growing_.is_streaming()) {
            check_streamed<CellIndex>(tetrahedra_, "cell");
            check_streamed<FacetIndex>(triangles_, "triangle");
            check_streamed<EdgeIndex>(edges_, "edge");
        } else {
            check_mesh();
        }
        growing_.finish();
        return std::move(mesh_);
    }

    /// Reads all of the file and tells the sink of points, and of nothing else. Returns their
    /// number.
    std::uint64_t read_points() {
        read_head();
        while (read_section()) {
        }
        return growing_.facts().vertices;
    }

private:
    void check_mesh() {
        check_entities(mesh_.cells, tetrahedra_, "cell");
        check_cells();
        check_entities(mesh_.facets, triangles_, "triangle");
        check_entities(mesh_.edges, edges_, "edge");
        if (options_->only_syntax) return;
        const WrongFacets wrong = find_wrong_facets(mesh_);
        if (const CellIndex cell = wrong.overlap.cell; !cell.is_none()) {
            fail_entry(tetrahedra_, cell, "cell",
                       describe_overlap(wrong, mesh_, lines_of(tetrahedra_)));
        }
        refuse_if_wrong(wrong.tagged, triangles_, "triangle", mesh_.facet_markers);
        refuse_if_wrong(find_wrong_edge(mesh_), edges_, "edge", mesh_.edge_markers);
    }

    void read_head() {
        if (const std::string_view token = tokens_.text(); token != "MeshVersionFormatted") {
            reader_.fail(
                fmt::format("a Medit file begins with MeshVersionFormatted, not {}", shown(token)));
        }
        const std::uint64_t version = tokens_.unsigned_integer("the format's version");
        if (version < 1 || version > 4) {
            reader_.fail(fmt::format("the Medit format has versions 1 to 4, not {}", version));
        }
    }

    /// Reads one section; false at the end.
    bool read_section() {
        const std::string keyword{tokens_.text()};
        if (keyword.empty()) {
            if (vertices_.keyword_line == 0) reader_.fail("there is no section Vertices");
            options_->note(note_on_missing_end(reader_.path()));
            return false;
        }
        if (keyword == "End") {
            if (vertices_.keyword_line == 0) reader_.fail("there is no section Vertices");
            if (!tokens_.text().empty()) reader_.fail("text after the keyword End");
            return false;
        }
        if (keyword == "Dimension") {
            const std::uint64_t dimension = tokens_.unsigned_integer("the dimension");
            if (dimension != 3) {
                reader_.fail(fmt::format("dimension 3 expected, {} found", dimension));
            }
        } else if (keyword == "Vertices") {
            read_vertices();
        } else if (keyword == "Tetrahedra") {
            read_entities(cell_kind, tetrahedra_, "tetrahedra");
        } else if (keyword == "Triangles") {
            read_entities(facet_kind, triangles_, "triangles");
        } else if (keyword == "Edges") {
            read_entities(edge_kind, edges_, "edges");
        } else {
            read_other(keyword);
        }
        return true;
    }

    void read_other(const std::string& keyword) {
        const std::uint64_t line = reader_.line_number();
        const auto skipped = std::ranges::find(skipped_sections, keyword, &SkippedSection::keyword);
        if (skipped != skipped_sections.end()) {
            const std::uint64_t count = tokens_.unsigned_integer("the number of entries");
            reader_.check_count(count, skipped->numbers_per_entry, "entries");
            for (std::uint64_t i = 0; i < count * skipped->numbers_per_entry; ++i) {
                (void)tokens_.real("a number of this section");
            }
            if (count > 0) {
                options_->note(note_on_skipped(reader_.path(), line, count, keyword));
            }
            return;
        }
        if (std::ranges::find(second_order_sections, keyword) != second_order_sections.end()) {
            reader_.fail(fmt::format("second-order elements ({}) are not supported", keyword));
        }
        if (std::ranges::find(other_cell_shapes, keyword) != other_cell_shapes.end()) {
            if (tokens_.unsigned_integer("the number of entries") == 0) return;
            reader_.fail(
                fmt::format("only tetrahedral meshes are supported, and this one has {}", keyword),
                line);
        }
        reader_.fail(fmt::format("a keyword expected, {} found", shown(keyword)));
    }

    /// Reads a section's count and its entries, each by read_entry().
    Section read_entries(const Section& earlier, std::size_t field_count, std::string_view name,
                         auto&& expect, auto&& read_entry) {
        Section section{.keyword_line = reader_.line_number()};
        if (earlier.keyword_line != 0) {
            reader_.fail(fmt::format("a second section of {}; the first is on line {}", name,
                                     earlier.keyword_line));
        }
        const std::uint64_t count = tokens_.unsigned_integer("the number of entries");
        reader_.check_count(count, field_count, name);
        expect(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            read_entry([&] {
                if (section.first_line == 0) section.first_line = reader_.line_number();
                if (reader_.line_number() != section.first_line + i) section.consecutive = false;
            });
        }
        return section;
    }

    void read_vertices() {
        vertices_ = read_entries(
            vertices_, 4, "vertices",
            [&](std::uint64_t count) {
                if (vertices_ahead_ && *vertices_ahead_ != count) {
                    reader_.fail("the file has changed while it was read");
                }
                if (growing_.is_streaming()) streamed_vertices_ = VertexIndex{count};
                growing_.expect_points(count, 0, true);
            },
            [&](auto&& started) {
                const double x = tokens_.coordinate("x");
                started();
                const double y = tokens_.coordinate("y");
                const double z = tokens_.coordinate("z");
                mesh_.points.push_back({x, y, z});
                mesh_.point_markers.push_back(tokens_.marker("the vertex's reference"));
                growing_.point_complete();
            });
        growing_.points_complete();
    }

    template <class I, std::size_t N>
    void read_entities(const EntityKind<I, N>& kind, Section& section, std::string_view name) {
        std::optional<OutOfRange> out_of_range;
        std::uint64_t entry = 0;
        section = read_entries(
            section, N + 1, name,
            [&](std::uint64_t count) {
                if (growing_.is_streaming()) stream_points_first();
                growing_.expect(kind, count, true);
            },
            [&](auto&& started) {
                std::array<VertexIndex, N> vertices;
                for (VertexIndex& vertex : vertices) {
                    const std::uint64_t number = tokens_.unsigned_integer("a vertex number");
                    started();
                    if (number == 0 || number > VertexIndex::limit) {
                        reader_.fail(fmt::format("there is no vertex {}", number));
                    }
                    vertex = VertexIndex{number - 1};
                }
                (mesh_.*kind.list).push_back(vertices);
                (mesh_.*kind.markers).push_back(tokens_.marker("the reference"));
                if (growing_.is_streaming()) {
                    look_for_out_of_range(vertices, entry++, out_of_range);
                }
                growing_.entity_complete(kind);
            });
        section.out_of_range = out_of_range;
        growing_.all_complete(kind);
    }

    /// From the first entry on that has a vertex that there is not, the sink hears nothing.
    void look_for_out_of_range(std::span<const VertexIndex> vertices, std::uint64_t entry,
                               std::optional<OutOfRange>& first) {
        for (const VertexIndex vertex : vertices) {
            if (vertex < streamed_vertices_ || first) continue;
            first = {entry, vertex};
            growing_.stream_only(Streamed::nothing);
        }
    }

    /// A sink hears of points before what refers to them: where they stand behind it, the file is
    /// read to its end for them first.
    void stream_points_first() {
        if (vertices_.keyword_line != 0 || growing_.streamed() != Streamed::everything) return;
        const ReadOptions quiet{.only_syntax = true};
        MeditReader ahead(reader_.path(), quiet, growing_.sink(), Streamed::points);
        vertices_ahead_ = ahead.read_points();
        streamed_vertices_ = VertexIndex{*vertices_ahead_};
        growing_.stream_only(Streamed::all_but_points);
    }

    // The checks come last because the format lets Vertices stand behind what refers to them. What
    // is streamed is looked at as it comes, but an error of syntax further down is reported first,
    // as it is for a mesh in memory.

    [[nodiscard]] std::string no_such_vertex(VertexIndex vertex) const {
        return fmt::format("there is no vertex {}: the file has {}",
                           std::uint64_t{vertex.value()} + 1, growing_.facts().vertices);
    }

    template <class I>
    void check_streamed(const Section& section, std::string_view name) const {
        if (!section.out_of_range) return;
        const auto& [entry, vertex] = *section.out_of_range;
        fail_entry(section, I{entry}, name, no_such_vertex(vertex));
    }

    template <class I>
    [[noreturn]] void fail_entry(const Section& section, I entry, std::string_view name,
                                 std::string_view what) const {
        if (section.consecutive) reader_.fail(what, section.first_line + entry.value());
        reader_.fail(
            fmt::format("{} {} of this section: {}", name, std::uint64_t{entry.value()} + 1, what),
            section.keyword_line);
    }

    template <class I, std::size_t N>
    void check_entities(const IndexVector<I, std::array<VertexIndex, N>>& list,
                        const Section& section, std::string_view name) {
        for (I i{0}; i < list.end_index(); ++i) {
            for (std::size_t k = 0; k < N; ++k) {
                if (list[i][k] >= mesh_.points.end_index()) {
                    fail_entry(section, i, name, no_such_vertex(list[i][k]));
                }
                for (std::size_t j = 0; j < k; ++j) {
                    if (list[i][j] != list[i][k] || options_->only_syntax) continue;
                    fail_entry(section, i, name,
                               fmt::format("the {} has the same vertex twice", name));
                }
            }
        }
    }

    void check_cells() {
        CellCheck check(mesh_, *options_);
        RepeatedCells repeated(options_->only_syntax ? 0 : mesh_.cells.size());
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            const std::string_view wrong = check.judge(mesh_.cells[c]);
            if (!wrong.empty()) fail_entry(tetrahedra_, c, "cell", wrong);
            if (!options_->only_syntax) repeated.add(mesh_.cells[c]);
        }
        if (check.fixed_count() > 0) {
            options_->note(fmt::format("{}: {} inverted cells were turned round",
                                       reader_.path().native(), check.fixed_count()));
        }
        if (const CellPair pair = repeated.find(mesh_.cells, mesh_.points.size());
            !pair.cell.is_none()) {
            fail_entry(tetrahedra_, pair.cell, "cell",
                       describe_repeated(pair, mesh_, lines_of(tetrahedra_)));
        }
    }

    /// Lines are known where each entry has its own.
    static LineOf lines_of(const Section& section) {
        return [section](std::uint64_t entry) {
            return section.consecutive ? std::optional(section.first_line + entry) : std::nullopt;
        };
    }

    template <class I>
    void refuse_if_wrong(const WrongEntry<I>& wrong, const Section& section, std::string_view name,
                         const IndexVector<I, Marker>& markers) const {
        if (wrong.entry.is_none()) return;
        fail_entry(section, wrong.entry, name,
                   describe_wrong(wrong, name, markers, mesh_, lines_of(section)));
    }

    LineReader reader_;
    Tokens tokens_;
    const ReadOptions* options_;
    GrowingMesh growing_;
    Mesh& mesh_ = growing_.mesh;
    /// While streaming, once it is known: the number of vertices. Else no number reaches it.
    VertexIndex streamed_vertices_ = VertexIndex::none();
    std::optional<std::uint64_t> vertices_ahead_;  ///< as read before the rest
    Section vertices_;
    Section tetrahedra_;
    Section triangles_;
    Section edges_;
};

}  // namespace

std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                            std::uint64_t count, std::string_view keyword) {
    return fmt::format("{}:{}: the {} entries of {} are not kept", path.native(), line, count,
                       keyword);
}

std::string note_on_missing_end(const std::filesystem::path& path) {
    return fmt::format("{}: the file ends without the keyword End", path.native());
}

Mesh read_medit(const std::filesystem::path& path, const ReadOptions& options) {
    return MeditReader(path, options, nullptr).read();
}

void stream_medit(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options) {
    (void)MeditReader(path, options, &sink).read();
}

}  // namespace octetra
