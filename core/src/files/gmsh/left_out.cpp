#include "files/gmsh/left_out.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace octetra::gmsh {

std::string wrong_without_cells(std::uint64_t cells, std::uint64_t facets,
                                const LeftOut& left_out) {
    const auto left = std::ranges::max_element(left_out.of_shape);
    if (cells > 0 || facets + *left + left_out.degenerate_lines == 0) return {};
    Shape shape = Shape::line;
    if (*left > 0) shape = static_cast<Shape>(left - left_out.of_shape.begin());
    if (facets > 0) shape = Shape::triangle;
    return fmt::format(
        "there are {} and no tetrahedra: mesh the volumes with gmsh -3; if there are physical "
        "groups, the volumes must be in one, too",
        plural(shape));
}

void tell(const LeftOut& left_out, const std::string& path,
          const std::function<void(const std::string&)>& note) {
    const auto tell_of = [&](std::uint64_t count, std::string_view what) {
        if (count > 0) note(fmt::format("{}: {} {}", path, count, what));
    };
    for (std::size_t k = 0; k < shape_count; ++k) {
        tell_of(left_out.of_shape[k],
                fmt::format("elements that are {} are not kept", plural(static_cast<Shape>(k))));
    }
    tell_of(left_out.interfaces, "elements between partitions are not kept");
    tell_of(left_out.degenerate_lines, "lines have the same node twice and are not kept");
    tell_of(left_out.names, "names of groups are empty or not valid UTF-8, and are not kept");
    tell_of(left_out.in_another_group,
            "elements are in more physical groups than one: the first is kept");
    tell_of(left_out.of_missing_entities,
            "elements are of entities that $Entities does not list, and have no group");
}

void tell_of_entities(std::uint64_t in_several, const std::string& path,
                      const std::function<void(const std::string&)>& note) {
    if (in_several == 0) return;
    note(fmt::format("{}: {} entities are in more physical groups than one: the first is kept",
                     path, in_several));
}

}  // namespace octetra::gmsh
