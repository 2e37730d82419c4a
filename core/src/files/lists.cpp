#include <octetra/core/files/lists.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"
#include "files/output/text_row.hpp"

namespace octetra {

std::vector<GlobalCell> read_cell_list(const std::filesystem::path& path, std::uint32_t index_base,
                                       std::size_t cell_count) {
    LineReader reader(path);
    std::vector<GlobalCell> cells;
    while (reader.next()) {
        Fields fields(reader);
        while (!fields.at_end()) {
            const std::uint64_t number = fields.unsigned_integer("a cell number");
            const std::uint64_t index = number - index_base;  // wraps around below index_base
            if (index >= cell_count) {
                reader.fail(fmt::format("there is no cell {}: the {} cells are numbered from {}",
                                        number, cell_count, index_base));
            }
            cells.push_back(GlobalCell{index});
        }
    }
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

std::vector<TextLine> read_lines(const std::filesystem::path& path) {
    LineReader reader(path);
    std::vector<TextLine> lines;
    while (reader.next()) lines.push_back({reader.line_number(), std::string(reader.full_line())});
    return lines;
}

void write_list(const std::vector<int>& numbers, const std::filesystem::path& path) {
    OutputFile out(path);
    for (const int number : numbers) {
        put_line(out, number);
    }
    out.commit();
}

void write_text(std::string_view text, const std::filesystem::path& path) {
    OutputFile out(path);
    out.put(text);
    out.commit();
}

}  // namespace octetra
