#include "files/gmsh/reading/binary_input.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace octetra::gmsh {

std::string BinaryInput::next_line() {
    while (reader_->remaining() > 0) {
        line_begin_ = reader_->position();
        std::string line = reader_->take_line("a section");
        while (line.ends_with(' ') || line.ends_with('\t')) line.pop_back();
        if (!line.empty()) return line;
    }
    return {};
}

std::uint64_t BinaryInput::count_line(std::string_view what) {
    const std::uint64_t begin = reader_->position();
    const std::string line = reader_->take_line(what);
    const char* const end = line.data() + line.size();
    std::uint64_t count = 0;
    const auto [stop, error] = std::from_chars(line.data(), end, count);
    if (error == std::errc{} && stop == end) return count;
    fail_at(fmt::format("{} should be a whole number from 0, not {}", what, shown(line)), begin);
}

/// Throws: the next number is not a valid coordinate.
void BinaryInput::refuse_coordinate(std::string_view what) {
    const std::uint64_t begin = reader_->position();
    const auto value = reader_->take<double>(what);
    if (!std::isfinite(value)) fail_at(fmt::format("{} is not finite: {}", what, value), begin);
    fail_at(fmt::format("{} is {}: coordinates must be less than 2^1023, about 8.98e307, or "
                        "midpoints overflow; scale the mesh down",
                        what, value),
            begin);
}

/// Searches for the end line of the section, which may directly follow its bytes without a line
/// end, since the content of the section is unknown.
void BinaryInput::skip_section(std::string_view name) {
    const std::string end = fmt::format("$End{}", name);
    constexpr std::uint64_t at_once = std::uint64_t{1} << 16U;
    while (reader_->remaining() >= end.size()) {
        const std::uint64_t begin = reader_->position();
        const std::uint64_t size = std::min(at_once, reader_->remaining());
        const auto* bytes = reinterpret_cast<const char*>(reader_->take_bytes(size, end));
        if (const std::size_t found = std::string_view(bytes, size).find(end);
            found != std::string_view::npos) {
            reader_->seek(begin + found);
            return end_section(name);
        }
        reader_->seek(begin + size - (end.size() - 1));  // the end may begin in these bytes
    }
    reader_->fail(fmt::format("the file ends within the section {}", shown(name)));
}

}  // namespace octetra::gmsh
