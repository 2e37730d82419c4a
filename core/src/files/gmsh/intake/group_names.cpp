#include "files/gmsh/intake/group_names.hpp"

#include <charconv>
#include <system_error>

namespace octetra::gmsh {
namespace {

/// Removes a number from the front of a line and returns it.
std::optional<std::int32_t> take_integer(std::string_view& line) {
    while (line.starts_with(' ') || line.starts_with('\t')) line.remove_prefix(1);
    std::int32_t number = 0;
    const char* const end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(line.data(), end, number);
    if (error != std::errc{}) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    return number;
}

}  // namespace

std::optional<GroupName> parse_group_name(std::string_view line) {
    const auto dimension = take_integer(line);
    const auto tag = take_integer(line);
    const std::size_t first = line.find('"');
    const std::size_t last = line.rfind('"');
    if (!dimension || *dimension < 0 || *dimension > 3 || !tag || first == last) {
        return std::nullopt;
    }
    return GroupName{*dimension, *tag, std::string(line.substr(first + 1, last - first - 1))};
}

}  // namespace octetra::gmsh
