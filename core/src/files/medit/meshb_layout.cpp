#include "files/medit/meshb_layout.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"

namespace octetra {
namespace {

/// More than any mesh has: who makes up a file must not make us remember it.
constexpr std::size_t most_sections = 1000;

/// Cells that the text reader does not know by name: of higher order, polygons and polyhedra.
bool is_of_other_cells(std::int32_t code) {
    return code == 27 || code == 33 || code == 46 || code == 47 || (code >= 86 && code <= 93) ||
           (code >= 96 && code <= 103);
}

/// What stands between a keyword's code and the next keyword.
struct Record {
    std::int32_t code = 0;
    std::uint64_t keyword_at = 0;
    std::uint64_t end = 0;  ///< of the section
    bool is_last = false;   ///< no other keyword is announced
};

class LayoutReader {
public:
    explicit LayoutReader(ByteReader& reader) : reader_(&reader) {}

    MeshbLayout read() {
        read_head();
        while (read_section()) {
        }
        if (!layout_.lists.vertices.is_there()) reader_->fail("there is no section Vertices");
        return std::move(layout_);
    }

private:
    [[nodiscard]] const MeshbFormat& format() const { return layout_.lists.format; }

    void read_head() {
        const auto one = reader_->take<std::int32_t>("the number 1");
        reader_->swap_bytes(one == 0x01000000);
        if (one != 1 && !reader_->swaps_bytes()) {
            reader_->fail(fmt::format("a binary Medit file begins with the number 1, of 32 bits in "
                                      "either byte order, not with {}",
                                      one),
                          0);
        }
        const auto version = reader_->take<std::int32_t>("the format's version");
        if (version < 1 || version > 4) {
            reader_->fail(fmt::format("the Medit format has versions 1 to 4, not {}", version), 4);
        }
        layout_.lists.format = {version, reader_->swaps_bytes()};
    }

    std::int64_t take_position() {
        constexpr std::string_view what = "the position of the next keyword";
        if (format().position_size() == 4) return reader_->take<std::int32_t>(what);
        return reader_->take<std::int64_t>(what);
    }

    std::uint64_t take_count() {
        constexpr std::string_view what = "the number of entries";
        const std::uint64_t at = reader_->position();
        const std::int64_t count = format().integer_size() == 4
                                       ? std::int64_t{reader_->take<std::int32_t>(what)}
                                       : reader_->take<std::int64_t>(what);
        if (count < 0) {
            reader_->fail(fmt::format("the number of entries should be from 0, not {}", count), at);
        }
        return static_cast<std::uint64_t>(count);
    }

    /// Reads one section's head, and goes to the next; false at the end.
    bool read_section() {
        if (reader_->remaining() == 0) return false;
        if (++sections_ > most_sections) {
            reader_->fail(fmt::format("more than {} keywords; is this a mesh?", most_sections));
        }
        Record record{.keyword_at = reader_->position()};
        record.code = reader_->take<std::int32_t>("a keyword");
        if (record.code == meshb_code::end) {
            read_end();
            return false;
        }
        const std::uint64_t position_at = reader_->position();
        const std::int64_t next = take_position();
        record.is_last = next == 0;
        record.end = record.is_last ? reader_->size() : static_cast<std::uint64_t>(next);
        // Positions ascend, so that a file has an end.
        if (next != 0 && (next < 0 || record.end < reader_->position())) {
            reader_->fail(
                fmt::format("the next keyword is said to be at byte {}, before this one's end",
                            next),
                position_at);
        }
        if (record.end > reader_->size()) {
            reader_->fail(fmt::format("the next keyword is said to be at byte {}, but the file has "
                                      "{}; was it cut off?",
                                      next, reader_->size()),
                          position_at);
        }
        take_section(record);
        reader_->seek(record.end);
        return !record.is_last;
    }

    /// Some programs write a position behind the last keyword, others do not.
    void read_end() {
        layout_.lists.has_end = true;
        if (reader_->remaining() == 0) return;
        const std::uint64_t at = reader_->position();
        const std::int64_t next = take_position();
        if (next != 0 && static_cast<std::uint64_t>(next) != reader_->size()) {
            reader_->fail(fmt::format("a keyword behind End is said to be at byte {}", next), at);
        }
        if (reader_->remaining() > 0) reader_->fail("bytes behind the keyword End");
    }

    void take_section(const Record& record) {
        MeshbLists& lists = layout_.lists;
        const auto entity = [&](std::size_t vertices) { return format().entity_size(vertices); };
        switch (record.code) {
            case meshb_code::dimension: return take_dimension();
            case meshb_code::vertices:
                return take_list(record, lists.vertices, format().point_size(), "vertices");
            case meshb_code::tetrahedra:
                return take_list(record, lists.tetrahedra, entity(4), "tetrahedra");
            case meshb_code::triangles:
                return take_list(record, lists.triangles, entity(3), "triangles");
            case meshb_code::edges: return take_list(record, lists.edges, entity(2), "edges");
            default: return take_other(record);
        }
    }

    void take_dimension() {
        const std::uint64_t at = reader_->position();
        const auto dimension = reader_->take<std::int32_t>("the dimension");
        if (dimension != 3) {
            reader_->fail(fmt::format("dimension 3 expected, {} found", dimension), at);
        }
    }

    void take_list(const Record& record, MeshbSection& section, std::size_t row_size,
                   std::string_view name) {
        if (section.is_there()) {
            reader_->fail(fmt::format("a second section of {}; the first is at byte {}", name,
                                      section.keyword_at),
                          record.keyword_at);
        }
        const std::uint64_t count_at = reader_->position();
        section = {record.keyword_at, 0, take_count(), record.code};
        section.rows_at = reader_->position();
        reader_->check_count(section.count, row_size, name, count_at);
        const std::uint64_t end = section.rows_at + section.count * row_size;
        if (end == record.end) return;
        reader_->fail(fmt::format("{} {} announced, which end at byte {}, but the next keyword is "
                                  "said to be at byte {}",
                                  section.count, name, end, record.end),
                      count_at);
    }

    /// Of what is no list of the mesh.
    void take_other(const Record& record) {
        const auto named = [&](const auto& keywords) {
            using Keyword = std::ranges::range_value_t<decltype(keywords)>;
            const auto found = std::ranges::find(keywords, record.code, &Keyword::code);
            return found == keywords.end() ? std::string_view{} : found->keyword;
        };
        if (const auto name = named(second_order_sections); !name.empty()) {
            reader_->fail(fmt::format("second-order elements ({}) are not supported", name),
                          record.keyword_at);
        }
        if (const auto name = named(other_cell_shapes); !name.empty()) {
            if (take_count() == 0) return;
            reader_->fail(
                fmt::format("only tetrahedral meshes are supported, and this one has {}", name),
                record.keyword_at);
        }
        if (is_of_other_cells(record.code)) {
            reader_->fail(fmt::format("only tetrahedral meshes are supported, and this one has "
                                      "cells with keyword {}",
                                      record.code),
                          record.keyword_at);
        }
        if (record.code <= 0 || record.code > static_cast<std::int32_t>(most_sections)) {
            reader_->fail(fmt::format("a keyword expected, {} found", record.code),
                          record.keyword_at);
        }
        MeshbSection section{.keyword_at = record.keyword_at, .code = record.code};
        if (!named(skipped_sections).empty()) {
            const std::uint64_t count_at = reader_->position();
            section.count = take_count();
            section.rows_at = reader_->position();
            reader_->check_count(section.count, format().integer_size(), "entries", count_at);
            if (section.count == 0) return;
        }
        layout_.skipped.push_back(section);
    }

    ByteReader* reader_;
    MeshbLayout layout_;
    std::size_t sections_ = 0;
};

}  // namespace

MeshbLayout read_meshb_layout(ByteReader& reader) { return LayoutReader(reader).read(); }

std::vector<std::string> notes_on(const std::filesystem::path& path, bool has_end,
                                  const std::vector<MeshbSection>& skipped) {
    std::vector<std::string> notes;
    for (const MeshbSection& section : skipped) {
        const auto known = std::ranges::find(skipped_sections, section.code, &SkippedSection::code);
        notes.push_back(known == skipped_sections.end()
                            ? fmt::format("{}: at byte {}: the section with keyword {} is not kept",
                                          path.native(), section.keyword_at, section.code)
                            : fmt::format("{}: at byte {}: the {} entries of {} are not kept",
                                          path.native(), section.keyword_at, section.count,
                                          known->keyword));
    }
    if (!has_end) notes.push_back(note_on_missing_end(path));
    return notes;
}

}  // namespace octetra
