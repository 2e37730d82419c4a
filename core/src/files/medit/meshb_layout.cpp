#include "files/medit/meshb_layout.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/meshb_sections.hpp"

namespace octetra {
namespace {

/// Returns whether the keyword denotes cells for which the text format has no name: of higher
/// order, polygons and polyhedra.
bool is_of_other_cells(std::int32_t code) {
    return code == 27 || code == 33 || code == 46 || code == 47 || (code >= 86 && code <= 93) ||
           (code >= 96 && code <= 103);
}

class LayoutReader {
public:
    explicit LayoutReader(ByteReader& reader) : reader_(&reader), sections_(reader) {}

    MeshbLayout read() {
        layout_.lists.format = sections_.format();
        layout_.lists.has_end =
            sections_.for_each([&](const MeshbRecord& record) { take_section(record); });
        if (!layout_.lists.vertices.is_there()) reader_->fail("there is no section Vertices");
        return std::move(layout_);
    }

private:
    [[nodiscard]] const MeshbFormat& format() const { return sections_.format(); }

    void take_section(const MeshbRecord& record) {
        MeshbLists& lists = layout_.lists;
        const auto entity = [&](std::size_t vertices) { return format().entity_size(vertices); };
        switch (record.code) {
            case meshb_code::dimension: return sections_.take_dimension();
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

    void take_list(const MeshbRecord& record, MeshbSection& section, std::size_t row_size,
                   std::string_view name) {
        if (section.is_there()) {
            reader_->fail(fmt::format("a second section of {}; the first is at byte {}", name,
                                      section.keyword_at),
                          record.keyword_at);
        }
        const std::uint64_t count_at = reader_->position();
        section = {record.keyword_at, 0, sections_.take_count(), record.code};
        section.rows_at = reader_->position();
        sections_.check_rows(section.count, row_size, name, count_at, record);
    }

    /// Reads a section that is not one of the lists of vertices and elements.
    void take_other(const MeshbRecord& record) {
        const std::size_t feature = feature_with(&MeditKeyword::code, record.code);
        if (feature < feature_count) {
            return take_list(record, layout_.lists.features[all_features.at(feature)],
                             format().integer_size(), feature_sections.at(feature).keyword);
        }
        const auto named = [&](const auto& keywords) {
            using Keyword = std::ranges::range_value_t<decltype(keywords)>;
            const auto found = std::ranges::find(keywords, record.code, &Keyword::code);
            return found == keywords.end() ? std::string_view{} : found->keyword;
        };
        if (const auto name = named(second_order_sections); !name.empty()) {
            reader_->fail(fmt::format(no_second_order, name), record.keyword_at);
        }
        if (const auto name = named(other_cell_shapes); !name.empty()) {
            if (sections_.take_count() == 0) return;
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
        if (record.code <= 0 || record.code > static_cast<std::int32_t>(MeshbSections::most)) {
            reader_->fail(fmt::format("a keyword expected, {} found", record.code),
                          record.keyword_at);
        }
        MeshbSection section{.keyword_at = record.keyword_at, .code = record.code};
        if (!named(skipped_sections).empty()) {
            const std::uint64_t count_at = reader_->position();
            section.count = sections_.take_count();
            section.rows_at = reader_->position();
            reader_->check_count(section.count, format().integer_size(), "entries", count_at);
            if (section.count == 0) return;
        }
        layout_.skipped.push_back(section);
    }

    ByteReader* reader_;
    MeshbSections sections_;
    MeshbLayout layout_;
};

}  // namespace

std::string note_on_section(const std::filesystem::path& path, std::uint64_t keyword_at,
                            std::int32_t code) {
    return fmt::format("{}: at byte {}: the section with keyword {} is not kept", path.native(),
                       keyword_at, code);
}

MeshbLayout read_meshb_layout(ByteReader& reader) { return LayoutReader(reader).read(); }

std::vector<std::string> notes_on(const std::filesystem::path& path, bool has_end,
                                  const std::vector<MeshbSection>& skipped) {
    std::vector<std::string> notes;
    for (const MeshbSection& section : skipped) {
        const auto known = std::ranges::find(skipped_sections, section.code, &SkippedSection::code);
        notes.push_back(known == skipped_sections.end()
                            ? note_on_section(path, section.keyword_at, section.code)
                            : fmt::format("{}: at byte {}: the {} entries of {} are not kept",
                                          path.native(), section.keyword_at, section.count,
                                          known->keyword));
    }
    if (!has_end) notes.push_back(note_on_missing_end(path));
    return notes;
}

}  // namespace octetra
