#include <array>
#include <exception>
#include <new>
#include <optional>
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
#include "files/medit/medit_text.hpp"
#include "files/medit/sol_sections.hpp"
#include "files/shares/shares.hpp"

namespace octetra {
namespace {

/// Reads a text file, or the share of a process of a group.
class SolTextReader {
public:
    SolTextReader(const std::filesystem::path& path, const std::optional<EntityCounts>& expected,
                  const ProcessGroup& group)
        : text_(path, group), expected_(&expected) {}

    /// Collective.
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
        const std::size_t width = section.width();
        rows.first = text_.read_entries(
            section.count,
            [&](std::uint64_t room) {
                if (is_kept) rows.values.reserve(room * width);
            },
            [&] {
                for (std::size_t k = 0; k < width; ++k) {
                    const double value = take_sol_value(tokens_, reader_);
                    if (is_kept) rows.values.push_back(value);
                }
            });
        if (is_kept) {
            fields_.lists.push_back(std::move(rows));
        } else if (section.count > 0) {
            fields_.notes.push_back(note_on_skipped(reader_.path(), line, section.count,
                                                    sol_keywords.at(keyword).keyword));
        }
    }

    MeditText text_;
    LineReader& reader_ = text_.reader();
    Tokens& tokens_ = text_.tokens();
    const std::optional<EntityCounts>* expected_;
    std::array<bool, kept_sol_keywords> is_there_{};
    SolFields fields_;
};

/// Reads a binary file, or the share of a process of a group.
SolFields read_solb(const std::filesystem::path& path, const std::optional<EntityCounts>& expected,
                    const ProcessGroup& group) {
    ByteReader reader(path);
    SolbLayout layout = read_solb_layout(reader, expected);
    SolFields fields{.notes = std::move(layout.notes)};
    for (const SolSection& section : layout.sections) {
        FieldRows rows = section.without_rows();
        const RowShare share = share_of_rows(section.count, group);
        rows.first = share.first;
        rows.values = read_solb_rows(reader, layout.format, section, share.first, share.count);
        fields.lists.push_back(std::move(rows));
    }
    return fields;
}

/// Collective. Reads this process's share of a file: all of it in a group of one process.
SolFields read_share(const std::filesystem::path& path, const std::optional<EntityCounts>& expected,
                     const ProcessGroup& group) {
    if (path.extension() == ".solb") return read_solb(path, expected, group);
    return SolTextReader(path, expected, group).read();
}

}  // namespace

SolFields read_sol(const std::filesystem::path& path, const std::optional<EntityCounts>& expected) {
    const StandardArithmetic standard;
    return read_share(path, expected, ProcessGroup::alone());
}

std::optional<SolFields> read_sol_share(const std::filesystem::path& path,
                                        const EntityCounts& expected, const ProcessGroup& group) {
    const StandardArithmetic standard;
    try {
        return group.transaction([&] { return read_share(path, expected, group); });
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // is reported by the process that reads the file alone
    }
    return std::nullopt;
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
