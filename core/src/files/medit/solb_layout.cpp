#include <algorithm>

#include <fmt/format.h>

#include "files/input/byte_reader.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/meshb_sections.hpp"
#include "files/medit/sol_sections.hpp"

namespace octetra {
namespace {

class SolbLayoutReader {
public:
    SolbLayoutReader(ByteReader& reader, const std::optional<EntityCounts>& expected)
        : reader_(&reader), sections_(reader), expected_(&expected) {}

    SolbLayout read() {
        layout_.format = sections_.format();
        const bool has_end =
            sections_.for_each([&](const MeshbRecord& record) { take_section(record); });
        if (!has_end) layout_.notes.push_back(note_on_missing_end(reader_->path()));
        return std::move(layout_);
    }

private:
    void take_section(const MeshbRecord& record) {
        if (record.code == meshb_code::dimension) return sections_.take_dimension();
        const std::size_t keyword = sol_keyword(record.code);
        if (keyword < kept_sol_keywords) return take_values(keyword, record);
        if (record.code <= 0 || record.code > static_cast<std::int32_t>(MeshbSections::most)) {
            reader_->fail(fmt::format("a keyword expected, {} found", record.code),
                          record.keyword_at);
        }
        layout_.notes.push_back(note_on_section(reader_->path(), record.keyword_at, record.code));
    }

    void take_values(std::size_t keyword, const MeshbRecord& record) {
        const std::string_view name = sol_keywords.at(keyword).keyword;
        if (std::ranges::find(layout_.sections, keyword, &SolSection::keyword) !=
            layout_.sections.end()) {
            reader_->fail(second_sol_section(name), record.keyword_at);
        }
        SolSection section{.keyword = keyword, .keyword_at = record.keyword_at};
        const std::uint64_t count_at = reader_->position();
        section.count = sections_.take_count();
        refuse(wrong_sol_count(section, *expected_), count_at);
        const auto fields = take("the number of fields", wrong_field_count);
        for (std::int32_t f = 0; f < fields; ++f) {
            const auto type = take("the type of a field", wrong_sol_type);
            section.components.push_back(sol_components.at(static_cast<std::size_t>(type) - 1));
        }
        section.rows_at = reader_->position();
        sections_.check_rows(section.count, section.width() * layout_.format.real_size(),
                             "rows of values", count_at, record);
        layout_.sections.push_back(std::move(section));
    }

    std::int32_t take(std::string_view what, auto&& wrong) {
        const std::uint64_t at = reader_->position();
        const auto number = reader_->take<std::int32_t>(what);
        refuse(wrong(number), at);
        return number;
    }
    void refuse(const std::string& wrong, std::uint64_t at) const {
        if (!wrong.empty()) reader_->fail(wrong, at);
    }

    ByteReader* reader_;
    MeshbSections sections_;
    const std::optional<EntityCounts>* expected_;
    SolbLayout layout_;
};

}  // namespace

SolbLayout read_solb_layout(ByteReader& reader, const std::optional<EntityCounts>& expected) {
    return SolbLayoutReader(reader, expected).read();
}

std::vector<double> read_solb_rows(ByteReader& reader, const MeshbFormat& format,
                                   const SolSection& section, std::uint64_t first,
                                   std::uint64_t count) {
    const std::size_t size = format.real_size();
    reader.swap_bytes(format.swapped);
    reader.seek(section.rows_at + first * section.width() * size);
    std::vector<double> values(count * section.width());
    for (double& value : values) {
        const std::uint64_t at = reader.position();
        value = size == 4 ? double{reader.take<float>("a value")} : reader.take<double>("a value");
        if (const std::string wrong = wrong_value(value); !wrong.empty()) reader.fail(wrong, at);
    }
    return values;
}

}  // namespace octetra
