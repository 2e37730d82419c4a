#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/index.hpp>

/// Text files of lists and lines.
namespace octetra {

/// Reads a list of cell numbers, separated by blanks or line ends, with comments from `#` to the
/// line end. Numbers count from `index_base` and must be less than `cell_count` + `index_base`.
/// Returns them ascending, without duplicates, counted from 0. Throws InputError or SystemError.
[[nodiscard]] std::vector<GlobalCell> read_cell_list(const std::filesystem::path& path,
                                                     std::uint32_t index_base,
                                                     std::size_t cell_count);

/// A non-blank line of a text file.
struct TextLine {
    std::uint64_t number = 0;  ///< counted from 1
    std::string text;          ///< without line end
};

/// Reads the lines of a text file that contain more than blanks and a comment, which `#` starts,
/// and keeps the comments of these. CRLF is also accepted as a line end. Throws InputError or
/// SystemError.
[[nodiscard]] std::vector<TextLine> read_lines(const std::filesystem::path& path);

/// Writes numbers as text, one per line. Throws SystemError.
void write_list(const std::vector<int>& numbers, const std::filesystem::path& path);

/// Writes text to a temporary file in the same directory, then renames it, as for all files. Throws
/// SystemError.
void write_text(std::string_view text, const std::filesystem::path& path);

}  // namespace octetra
