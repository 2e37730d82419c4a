#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/in_order.hpp"
#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/medit_head.hpp"
#include "files/medit/medit_text.hpp"

namespace octetra {
namespace {

/// The first entry of a section that refers to a missing vertex.
struct OutOfRange {
    std::uint64_t entry = 0;
    VertexIndex vertex;
};

/// A section of a text file.
struct SectionOfText {
    std::uint64_t keyword_line = 0;          ///< 0: no such section
    std::uint64_t first_line = 0;            ///< line of the first entry
    bool consecutive = true;                 ///< entry i begins on line first_line + i
    std::uint64_t largest = 0;               ///< largest vertex number
    std::optional<OutOfRange> out_of_range;  ///< determined only while streaming
};

/// A section of a feature.
struct FeatureSection {
    std::uint64_t keyword_line = 0;  ///< 0: no such section
    std::uint64_t largest = 0;       ///< its largest number, counted from 1
    std::uint64_t largest_line = 0;  ///< line of its first occurrence
};

class MeditReader final : private EntryPositions {
public:
    MeditReader(const std::filesystem::path& path, const ReadOptions& options, GrowingMesh& growing)
        : text_(path, growing.group()), options_(&options), growing_(growing) {
        mesh_.index_base = 1;
    }

    void read() {
        take_medit_head(tokens_, reader_);
        while (read_section()) {
        }
        if (growing_.is_streaming()) {
            for (const Listed list : {Listed::cells, Listed::facets, Listed::edges}) {
                check_streamed(list);
            }
        } else if (growing_.is_share()) {
            check_share();
        } else {
            check_listed(mesh_, *options_, reader_.path(), *this,
                         tetrahedra_.largest <= mesh_.points.size());
        }
        for (const Feature feature : all_features) finish_feature(feature);
    }

    /// Reads the whole file, passes only points to the sink, and returns their number.
    std::uint64_t read_points() {
        take_medit_head(tokens_, reader_);
        while (read_section()) {
        }
        return growing_.facts().vertices;
    }

private:
    /// Reads one section. Returns false at the end of the file.
    bool read_section() {
        const std::string keyword = next_keyword();
        if (keyword.empty()) {
            if (vertices_.keyword_line == 0) reader_.fail("there is no section Vertices");
            if (tetrahedra_.keyword_line == 0) reader_.fail(std::string(truncated_file_error));
            options_->note(note_on_missing_end(reader_.path()));
            return false;
        }
        if (keyword == "End") {
            if (vertices_.keyword_line == 0) reader_.fail("there is no section Vertices");
            if (!tokens_.text().empty()) reader_.fail("text after the keyword End");
            return false;
        }
        if (keyword == "Dimension") {
            take_medit_dimension(tokens_, reader_);
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

    std::string next_keyword() {
        if (keyword_ahead_.empty()) return std::string(tokens_.text());
        return std::exchange(keyword_ahead_, {});
    }

    void read_other(const std::string& keyword) {
        const std::uint64_t line = reader_.line_number();
        const std::size_t feature = feature_with(&MeditKeyword::keyword, std::string_view(keyword));
        if (feature < feature_count) return read_feature(all_features.at(feature));
        const auto skipped = std::ranges::find(skipped_sections, keyword, &SkippedSection::keyword);
        if (skipped != skipped_sections.end()) {
            const std::uint64_t count = tokens_.unsigned_integer("the number of entries");
            reader_.check_count(count, skipped->numbers_per_entry, "entries");
            (void)text_.read_entries(
                count, [](std::uint64_t) {},
                [&] {
                    for (std::size_t i = 0; i < skipped->numbers_per_entry; ++i) {
                        (void)tokens_.real("a number of this section");
                    }
                });
            if (count > 0) {
                options_->note(note_on_skipped(reader_.path(), line, count, keyword));
            }
            return;
        }
        if (std::ranges::find(sections_without_count, keyword) != sections_without_count.end()) {
            return skip_numbers(keyword);
        }
        if (std::ranges::find(second_order_sections, keyword, &MeditKeyword::keyword) !=
            second_order_sections.end()) {
            reader_.fail(fmt::format(no_second_order, keyword));
        }
        if (std::ranges::find(other_cell_shapes, keyword, &MeditKeyword::keyword) !=
            other_cell_shapes.end()) {
            if (tokens_.unsigned_integer("the number of entries") == 0) return;
            reader_.fail(
                fmt::format("only tetrahedral meshes are supported, and this one has {}", keyword),
                line);
        }
        reader_.fail(fmt::format("a keyword expected, {} found", shown(keyword)));
    }

    /// Skips numbers up to the next keyword.
    void skip_numbers(std::string_view section) {
        options_->note(note_on_skipped(reader_.path(), reader_.line_number(), section));
        const auto is_number = [](std::string_view token) {
            return token.find_first_not_of("0123456789+-") == std::string_view::npos;
        };
        std::string_view token = tokens_.text();
        while (!token.empty() && is_number(token)) token = tokens_.text();
        keyword_ahead_ = token;
    }

    void read_feature(Feature feature) {
        FeatureSection& section = features_[feature];
        if (section.keyword_line != 0) {
            reader_.fail(fmt::format("a second section {}; the first is on line {}",
                                     keyword_of(feature).keyword, section.keyword_line));
        }
        section.keyword_line = reader_.line_number();
        const std::uint64_t count = tokens_.unsigned_integer("the number of entries");
        reader_.check_count(count, 1, "entries");
        std::vector<std::uint64_t>& numbers = mesh_.features[feature];
        const std::string_view name = numbered_by(feature, {}).name;
        const auto read_number = [&] {
            const std::uint64_t number = tokens_.unsigned_integer("a number");
            if (number == 0 || number > VertexIndex::limit) {
                reader_.fail(fmt::format("there is no {} {}", name, number));
            }
            if (number > section.largest) {
                section.largest = number;
                section.largest_line = reader_.line_number();
            }
            if (!growing_.is_streaming()) numbers.push_back(number - 1);
        };
        (void)text_.read_entries(
            count, [&](std::uint64_t room) { growing_.expect_numbers(feature, count, room); },
            read_number);
    }

    /// Checks the numbers of a feature at the end, since the section that they refer to may follow.
    void finish_feature(Feature feature) {
        const Numbered numbered = numbered_by(feature, growing_.facts());
        const auto& [keyword_line, largest, line] = features_[feature];
        if (largest > numbered.count) {
            reader_.fail(no_such_entity(numbered, static_cast<std::int64_t>(largest)), line);
        }
    }

    /// Reads the count of a section and its entries, calling read_entry() for each.
    SectionOfText read_entries(const SectionOfText& earlier, std::size_t field_count,
                               std::string_view name, auto&& expect, auto&& read_entry) {
        SectionOfText section{.keyword_line = reader_.line_number()};
        if (earlier.keyword_line != 0) {
            reader_.fail(fmt::format("a second section of {}; the first is on line {}", name,
                                     earlier.keyword_line));
        }
        const std::uint64_t count = tokens_.unsigned_integer("the number of entries");
        reader_.check_count(count, field_count, name);
        std::uint64_t i = 0;
        const auto started = [&] {
            if (section.first_line == 0) section.first_line = reader_.line_number();
            if (reader_.line_number() != section.first_line + i) section.consecutive = false;
        };
        (void)text_.read_entries(
            count, [&](std::uint64_t room) { expect(count, room); },
            [&] {
                read_entry(started);
                ++i;
            });
        return section;
    }

    void read_vertices() {
        vertices_ = read_entries(
            vertices_, 4, "vertices",
            [&](std::uint64_t count, std::uint64_t room) {
                if (vertices_ahead_ && *vertices_ahead_ != count) {
                    reader_.fail("the file has changed while it was read");
                }
                if (growing_.is_streaming()) streamed_vertices_ = VertexIndex{count};
                growing_.expect_points(count, 0, true, room);
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
    void read_entities(const EntityKind<I, N>& kind, SectionOfText& section,
                       std::string_view name) {
        std::optional<OutOfRange> out_of_range;
        std::uint64_t entry = 0;
        std::uint64_t largest = 0;
        section = read_entries(
            section, N + 1, name,
            [&](std::uint64_t count, std::uint64_t room) {
                if (growing_.is_streaming()) stream_points_first();
                growing_.expect(kind, count, true, room);
            },
            [&](auto&& started) {
                const auto vertices = taken_in_order<N>([&] {
                    const std::uint64_t number = tokens_.unsigned_integer("a vertex number");
                    started();
                    if (number == 0 || number > VertexIndex::limit) {
                        reader_.fail(fmt::format("there is no vertex {}", number));
                    }
                    largest = std::max(largest, number);
                    return VertexIndex{number - 1};
                });
                (mesh_.*kind.list).push_back(vertices);
                (mesh_.*kind.markers).push_back(tokens_.marker("the reference"));
                if (growing_.is_streaming()) {
                    find_out_of_range(vertices, entry++, out_of_range);
                }
                growing_.entity_complete(kind);
            });
        section.out_of_range = out_of_range;
        section.largest = largest;
        growing_.all_complete(kind);
    }

    /// Records the first entry that refers to a missing vertex, and stops streaming from there on.
    void find_out_of_range(std::span<const VertexIndex> vertices, std::uint64_t entry,
                           std::optional<OutOfRange>& first) {
        for (const VertexIndex vertex : vertices) {
            if (vertex < streamed_vertices_ || first) continue;
            first = {entry, vertex};
            growing_.stream_only(Streamed::nothing);
        }
    }

    /// Streams the points before other entities. If the Vertices section follows entities that
    /// refer to it, the file is first read to its end for the points alone.
    void stream_points_first() {
        if (vertices_.keyword_line != 0 || growing_.streamed() != Streamed::everything) return;
        const ReadOptions quiet{.only_syntax = true};
        GrowingMesh points(true, *growing_.sink());
        points.stream_only(Streamed::points);
        vertices_ahead_ = MeditReader(reader_.path(), quiet, points).read_points();
        streamed_vertices_ = VertexIndex{*vertices_ahead_};
        growing_.stream_only(Streamed::all_but_points);
    }

    // Checks are made last because in this format Vertices may follow the entities that refer to
    // them. Streamed entities are examined as they are read, but a syntax error further on takes
    // precedence, as for a mesh in memory.

    void check_streamed(Listed list) const {
        const SectionOfText& section = section_of(list);
        if (!section.out_of_range) return;
        const auto& [entry, vertex] = *section.out_of_range;
        fail_entry(list, entry,
                   no_such_vertex(std::int64_t{vertex.value()} + 1, growing_.facts().vertices));
    }

    void check_share() const {
        const std::uint64_t largest =
            std::max({tetrahedra_.largest, triangles_.largest, edges_.largest});
        if (largest > growing_.facts().vertices) reader_.fail("there is no such vertex");
    }

    [[nodiscard]] const SectionOfText& section_of(Listed list) const {
        switch (list) {
            case Listed::cells: return tetrahedra_;
            case Listed::facets: return triangles_;
            case Listed::edges: break;
        }
        return edges_;
    }

    [[noreturn]] void fail_entry(Listed list, std::uint64_t entry,
                                 std::string_view what) const override {
        const SectionOfText& section = section_of(list);
        if (section.consecutive) reader_.fail(what, section.first_line + entry);
        reader_.fail(fmt::format("{} {} of this section: {}", entry_name(list), entry + 1, what),
                     section.keyword_line);
    }

    /// Lines are known only if every entry begins on its own line.
    [[nodiscard]] LineOf lines_of(Listed list) const override {
        return [section = section_of(list)](std::uint64_t entry) {
            return section.consecutive ? std::optional(section.first_line + entry) : std::nullopt;
        };
    }

    MeditText text_;
    LineReader& reader_ = text_.reader();
    Tokens& tokens_ = text_.tokens();
    std::string keyword_ahead_;  ///< keyword of the next section, if already read
    const ReadOptions* options_;
    GrowingMesh& growing_;
    Mesh& mesh_ = growing_.mesh;
    /// The number of vertices, while streaming, once known; otherwise greater than any vertex
    /// number.
    VertexIndex streamed_vertices_ = VertexIndex::none();
    std::optional<std::uint64_t> vertices_ahead_;  ///< number of vertices, if they were read first
    SectionOfText vertices_;
    SectionOfText tetrahedra_;
    SectionOfText triangles_;
    SectionOfText edges_;
    PerFeature<FeatureSection> features_;
};

}  // namespace

std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                            std::uint64_t count, std::string_view keyword) {
    return fmt::format("{}:{}: the {} entries of {} are not kept", path.native(), line, count,
                       keyword);
}

std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                            std::string_view keyword) {
    return fmt::format("{}:{}: the section {} is not kept", path.native(), line, keyword);
}

std::string note_on_missing_end(const std::filesystem::path& path) {
    return fmt::format("{}: the file ends without the keyword End: was it cut off?", path.native());
}

void read_medit(const std::filesystem::path& path, const ReadOptions& options,
                GrowingMesh& growing) {
    MeditReader(path, options, growing).read();
}

}  // namespace octetra
