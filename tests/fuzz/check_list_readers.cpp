#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/distributed/partition.hpp>

#include "fuzz/check_readers.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::test {
namespace {

namespace fs = std::filesystem;

void expect(bool holds, const char* promise) {
    if (!holds) throw BrokenPromise(std::string("not so: ") + promise);
}

/// Calls `read`, and then `check` with what it returned unless it refused the file.
void check_unless_refused(const fs::path& folder, auto&& read, auto&& check) {
    decltype(read()) result;
    try {
        result = read();
    } catch (const InputError& error) {
        check_message(error.what(), folder);
        return;
    }
    check(result);
}

void check_written_maps(const RefinementMaps& maps, std::uint32_t index_base,
                        const fs::path& path) {
    constexpr std::size_t most_vertices = 100'000;  // maximum for the meshes that are made below
    const std::size_t vertices = maps.first_midpoint.value() + maps.midpoint_to_edge.size();
    if (vertices > most_vertices) return;
    Mesh mesh;
    mesh.points.resize(vertices);
    mesh.cells.resize(maps.cell_to_parent.size());
    mesh.index_base = index_base;
    WholeMesh source(mesh, &maps);
    write_maps(source, path);
    expect(read_maps(path, index_base) == maps, "maps written and read are the same");
}

void check_cells(const std::vector<GlobalCell>& cells, std::uint32_t index_base,
                 std::size_t cell_count, const fs::path& path) {
    expect(std::ranges::is_sorted(cells, std::ranges::less_equal{}), "cells ascend, each once");
    std::string text = "# the same cells\n";
    for (const GlobalCell cell : cells) {
        const auto number = static_cast<std::uint64_t>(cell);
        expect(number < cell_count, "there is such a cell");
        text += fmt::format("{}\n", number + index_base);
    }
    write_file(path, text);
    expect(read_cell_list(path, index_base, cell_count) == cells,
           "cells written and read are the same");
}

/// The lines of a part file that must contain a number each.
std::vector<std::string_view> lines_with_content(std::string_view text) {
    std::vector<std::string_view> lines;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // as other programs may begin
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!line.empty() && line.front() != '#') lines.push_back(line);
    }
    return lines;
}

/// Returns whether this text is the number, possibly with leading zeros.
bool says(std::string_view text, int number) {
    while (text.size() > 1 && text.front() == '0') text.remove_prefix(1);
    return text == std::to_string(number);
}

void check_parts(const std::vector<int>& parts, int part_count,
                 const std::vector<std::string_view>& lines) {
    expect(std::ranges::equal(parts, lines, [](int part, auto line) { return says(line, part); }),
           "the parts are those of the lines");
    for (const int part : parts) expect(part >= 0 && part < part_count, "there is such a part");
}

}  // namespace

void check_maps(std::string_view input, const fs::path& folder) {
    write_file(folder / "in", input);
    for (const std::uint32_t index_base : {0U, 1U}) {
        check_unless_refused(
            folder, [&] { return read_maps(folder / "in", index_base); },
            [&](const auto& maps) { check_written_maps(maps, index_base, folder / "out"); });
    }
}

void check_cell_list(std::string_view input, const fs::path& folder) {
    write_file(folder / "in", input);
    for (const std::uint32_t index_base : {0U, 1U}) {
        for (const std::size_t cell_count : {0U, 100U, CellIndex::limit}) {
            check_unless_refused(
                folder, [&] { return read_cell_list(folder / "in", index_base, cell_count); },
                [&](const auto& cells) {
                    check_cells(cells, index_base, cell_count, folder / "out");
                });
        }
    }
}

void check_part_file(std::string_view input, const fs::path& folder) {
    write_file(folder / "in", input);
    const std::vector<std::string_view> lines = lines_with_content(input);
    Mesh mesh;
    mesh.cells.resize(lines.size());
    constexpr int part_count = 12;
    const auto read = [&](const fs::path& path) {
        return distributed::partition_cells(
            mesh, part_count, {.method = distributed::PartitionMethod::file, .path = path});
    };
    check_unless_refused(
        folder, [&] { return read(folder / "in"); },
        [&](const auto& parts) {
            check_parts(parts, part_count, lines);
            write_list(parts, folder / "out");
            expect(read(folder / "out") == parts, "parts written and read are the same");
        });
    mesh.cells.resize(lines.size() + 1);
    check_unless_refused(
        folder, [&] { return read(folder / "in"); },
        [](const auto&) { throw BrokenPromise("a cell more than parts, and it was not noticed"); });
}

}  // namespace octetra::test
