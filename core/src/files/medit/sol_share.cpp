#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

#include <octetra/core/sol_fields.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "files/input/byte_reader.hpp"
#include "files/input/fields.hpp"
#include "files/input/input_file.hpp"
#include "files/input/line_reader.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/medit_head.hpp"
#include "files/medit/sol_sections.hpp"
#include "files/shares/keyword_scan.hpp"
#include "files/shares/shares.hpp"
#include "files/shares/status.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// Throws for files that read_sol() rejects, or that one process must read.
[[noreturn]] void throw_unsuitable_sol() { throw std::runtime_error("not a row a line"); }

/// A section of a text file, and the position of its rows.
struct TextSection {
    SolSection head;
    FileRange rows;
};

/// Reads the sections at the keywords; not collective.
std::vector<TextSection> sections_of_text(const fs::path& path,
                                          const std::vector<NumberedLine>& keywords,
                                          std::uint64_t file_size, const EntityCounts& expected) {
    std::vector<TextSection> sections;
    if (keywords.empty() || LineReader(path, 0, keywords.front().position).next()) {
        throw_unsuitable_sol();
    }
    bool has_end = false;
    for (std::size_t k = 0; k < keywords.size(); ++k) {
        const bool is_last = k + 1 == keywords.size();
        const std::uint64_t end = is_last ? file_size : keywords[k + 1].position;
        LineReader reader(path, keywords[k].position, end);
        Tokens tokens(reader);
        if (k == 0) {
            take_medit_head(tokens, reader);
            if (!tokens.text().empty()) throw_unsuitable_sol();
            continue;
        }
        const std::string keyword{tokens.text()};
        if (const std::size_t found = sol_keyword(keyword); found < kept_sol_keywords) {
            const auto is_it = [&](const TextSection& one) { return one.head.keyword == found; };
            if (std::ranges::any_of(sections, is_it)) throw_unsuitable_sol();
            const SolSection head = take_sol_head(tokens, reader, found, expected);
            if (!tokens.at_line_end()) throw_unsuitable_sol();
            sections.push_back({head, {reader.next_position(), end}});
            continue;
        }
        if (keyword == "Dimension") {
            take_medit_dimension(tokens, reader);
        } else if (keyword == "End" && is_last) {
            has_end = true;
        } else {
            throw_unsuitable_sol();
        }
        if (!tokens.text().empty()) throw_unsuitable_sol();
    }
    if (!has_end) throw_unsuitable_sol();  // read_sol() has a note on this
    return sections;
}

/// Returns the values in this process's lines of a section.
std::vector<double> values_of_share(const fs::path& path, const FileRange& share) {
    LineReader reader(path, share.begin, share.end);
    std::vector<double> values;
    while (reader.next()) {
        Fields fields(reader);
        while (!fields.at_end()) values.push_back(take_sol_value(fields, reader));
    }
    return values;
}

/// Collective. Numbers the rows of a list; returns false on all processes if a row is incomplete,
/// or the number of rows differs from the announced one.
bool number_rows(FieldRows& list, const ProcessGroup& group) {
    const std::size_t width = list.width();
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): a list of no field was refused.
    const bool are_whole = list.values.size() % width == 0;
    const std::uint64_t rows = list.values.size() / width;
    list.first = group.sum_before(rows);
    const bool are_consistent = group.sum(rows) == list.count;
    return group.sum(are_whole ? 0 : 1) == 0 && are_consistent;
}

/// Collective. Reads a text file.
std::optional<SolFields> read_text_share(const fs::path& path, const EntityCounts& expected,
                                         const ProcessGroup& group) {
    CollectiveStatus status(group);
    std::uint64_t file_size = 0;
    status.attempt([&] { file_size = InputFile(path).size(); });
    if (!status.all_succeeded()) return std::nullopt;
    const auto keywords = scan_for_keywords(status, path, file_size);
    if (!keywords) return std::nullopt;
    SolFields fields;
    status.attempt([&] {
        for (const auto& [head, rows] : sections_of_text(path, *keywords, file_size, expected)) {
            FieldRows& list = fields.lists.emplace_back(head.without_rows());
            list.values =
                values_of_share(path, share_of_lines(path, rows, group.rank(), group.size()));
        }
    });
    if (!status.all_succeeded()) return std::nullopt;
    bool are_consistent = true;
    for (FieldRows& list : fields.lists)
        are_consistent = number_rows(list, group) && are_consistent;
    if (!are_consistent) return std::nullopt;
    return fields;
}

/// Collective. Reads a binary file.
std::optional<SolFields> read_binary_share(const fs::path& path, const EntityCounts& expected,
                                           const ProcessGroup& group) {
    CollectiveStatus status(group);
    SolFields fields;
    status.attempt([&] {
        ByteReader reader(path);
        SolbLayout layout = read_solb_layout(reader, expected);
        fields.notes = std::move(layout.notes);
        for (const SolSection& section : layout.sections) {
            FieldRows& list = fields.lists.emplace_back(section.without_rows());
            const RowShare share = share_of_rows(section.count, group);
            list.first = share.first;
            list.values = read_solb_rows(reader, layout.format, section, share.first, share.count);
        }
    });
    if (!status.all_succeeded()) return std::nullopt;
    return fields;
}

}  // namespace

std::optional<SolFields> read_sol_share(const fs::path& path, const EntityCounts& expected,
                                        const ProcessGroup& group) {
    const StandardArithmetic standard;
    try {
        return group.transaction([&] {
            return path.extension() == ".solb" ? read_binary_share(path, expected, group)
                                               : read_text_share(path, expected, group);
        });
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // is reported by the process that reads the file alone
    }
    return std::nullopt;
}

}  // namespace octetra
