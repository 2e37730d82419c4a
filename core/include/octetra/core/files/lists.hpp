#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/index.hpp>

/// Files of numbers and of text.
namespace octetra {

/// Reads a list of cell numbers, separated by blanks or line ends, `#` starting a comment, that
/// count from `index_base` and are less than `cell_count` + `index_base`.
/// Returns them ascending, each once, counted from 0. Throws InputError or SystemError.
[[nodiscard]] std::vector<GlobalCell> read_cell_list(const std::filesystem::path& path,
                                                     std::uint32_t index_base,
                                                     std::size_t cell_count);

/// A line of a text file that holds something.
struct TextLine {
    std::uint64_t number = 0;  ///< counted from 1
    std::string text;          ///< without comment, line end, and blanks around it
};

/// Reads the lines of a text file that hold something; `#` starts a comment, CRLF ends a line, too.
/// Throws InputError or SystemError.
[[nodiscard]] std::vector<TextLine> read_lines(const std::filesystem::path& path);

/// Writes numbers as text, a line each. Throws SystemError.
void write_list(const std::vector<int>& numbers, const std::filesystem::path& path);

/// Writes text, beside its final name and then renamed as all files are. Throws SystemError.
void write_text(std::string_view text, const std::filesystem::path& path);

}  // namespace octetra
