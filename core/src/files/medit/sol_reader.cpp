#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_formats.hpp>
#include <octetra/core/sol_fields.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "files/input/byte_reader.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/medit_head.hpp"
#include "files/medit/sol_sections.hpp"

namespace octetra {
namespace {

class SolTextReader {
public:
    SolTextReader(const std::filesystem::path& path, const std::optional<EntityCounts>& expected)
        : reader_(path), tokens_(reader_), expected_(&expected) {}

    SolFields read() {
        take_medit_head(tokens_, reader_);
        while (read_section()) {
        }
        return std::move(fields_);
    }

private:
    /// Reads a section; returns false at the end.
    bool read_section() {
        const std::string keyword{tokens_.text()};
        if (keyword.empty()) {
            fields_.notes.push_back(note_on_missing_end(reader_.path()));
            return false;
        }
        if (keyword == "End") {
            if (!tokens_.text().empty()) reader_.fail("text after the keyword End");
            return false;
        }
        if (keyword == "Dimension") {
            take_medit_dimension(tokens_, reader_);
        } else if (const std::size_t found = sol_keyword(keyword); found < sol_keywords.size()) {
            read_values(found);
        } else if (keyword == "Iterations" || keyword == "Time") {
            fields_.notes.push_back(
                note_on_skipped(reader_.path(), reader_.line_number(), 1, keyword));
            (void)tokens_.real("a number of this section");
        } else {
            reader_.fail(fmt::format("a keyword expected, {} found", shown(keyword)));
        }
        return true;
    }

    void read_values(std::size_t keyword) {
        const std::uint64_t line = reader_.line_number();
        const bool is_kept = keyword < kept_sol_keywords;
        if (is_kept && std::exchange(is_there_.at(keyword), true)) {
            reader_.fail(second_sol_section(sol_keywords.at(keyword).keyword));
        }
        const SolSection section = take_sol_head(tokens_, reader_, keyword, *expected_);
        FieldRows rows = section.without_rows();
        const std::uint64_t numbers = section.count * section.width();
        if (is_kept) rows.values.reserve(numbers);
        for (std::uint64_t i = 0; i < numbers; ++i) {
            const double value = take_sol_value(tokens_, reader_);
            if (is_kept) rows.values.push_back(value);
        }
        if (is_kept) {
            fields_.lists.push_back(std::move(rows));
        } else if (section.count > 0) {
            fields_.notes.push_back(note_on_skipped(reader_.path(), line, section.count,
                                                    sol_keywords.at(keyword).keyword));
        }
    }

    LineReader reader_;
    Tokens tokens_;
    const std::optional<EntityCounts>* expected_;
    std::array<bool, kept_sol_keywords> is_there_{};
    SolFields fields_;
};

SolFields read_solb(const std::filesystem::path& path,
                    const std::optional<EntityCounts>& expected) {
    ByteReader reader(path);
    SolbLayout layout = read_solb_layout(reader, expected);
    SolFields fields{.notes = std::move(layout.notes)};
    for (const SolSection& section : layout.sections) {
        FieldRows rows = section.without_rows();
        rows.values = read_solb_rows(reader, layout.format, section, 0, section.count);
        fields.lists.push_back(std::move(rows));
    }
    return fields;
}

}  // namespace

SolFields read_sol(const std::filesystem::path& path, const std::optional<EntityCounts>& expected) {
    const StandardArithmetic standard;
    if (path.extension() == ".solb") return read_solb(path, expected);
    return SolTextReader(path, expected).read();
}

bool is_sol(const std::filesystem::path& path) {
    return path.extension() == ".sol" || path.extension() == ".solb";
}

std::optional<std::filesystem::path> sol_path_for(const std::filesystem::path& path) {
    const MeshFormat format = mesh_format_of(path);
    if (format.format == Format::medit || format.format == Format::meshb) {
        return std::filesystem::path(path).replace_extension(format.extensions[1]);
    }
    return {};
}

bool sol_can_hold(const FieldFacts& field) {
    return sol_type(field.components) != 0 && field.type != FieldType::int64;
}

std::string sol_field_name(std::size_t number) { return fmt::format("sol_{}", number); }

}  // namespace octetra
