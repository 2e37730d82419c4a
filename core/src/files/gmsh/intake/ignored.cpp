#include "files/gmsh/intake/ignored.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace octetra::gmsh {

void IgnoredContent::add_up(const ProcessGroup& group) {
    for (std::uint64_t& count : of_shape) count = group.sum(count);
    for (std::uint64_t* count :
         {&interfaces, &degenerate_lines, &in_another_group, &of_missing_entities}) {
        *count = group.sum(*count);
    }
}

std::string error_without_cells(std::uint64_t cells, std::uint64_t facets,
                                const IgnoredContent& ignored) {
    const auto left = std::ranges::max_element(ignored.of_shape);
    if (cells > 0 || facets + *left + ignored.degenerate_lines == 0) return {};
    Shape shape = Shape::line;
    if (*left > 0) shape = static_cast<Shape>(left - ignored.of_shape.begin());
    if (facets > 0) shape = Shape::triangle;
    return fmt::format(
        "there are {} and no tetrahedra: mesh the volumes with gmsh -3; if there are physical "
        "groups, the volumes must be in one, too",
        plural(shape));
}

void note_ignored(const IgnoredContent& ignored, const std::string& path,
                  const std::function<void(const std::string&)>& note) {
    const auto note_count = [&](std::uint64_t count, std::string_view what) {
        if (count > 0) note(fmt::format("{}: {} {}", path, count, what));
    };
    for (std::size_t k = 0; k < shape_count; ++k) {
        note_count(ignored.of_shape[k],
                   fmt::format("elements that are {} are not kept", plural(static_cast<Shape>(k))));
    }
    note_count(ignored.interfaces, "elements between partitions are not kept");
    note_count(ignored.degenerate_lines, "lines have the same node twice and are not kept");
    note_count(ignored.names, "names of groups are empty or not valid UTF-8, and are not kept");
    note_count(ignored.in_another_group,
               "elements are in more physical groups than one: the first is kept");
    note_count(ignored.of_missing_entities,
               "elements are of entities that $Entities does not list, and have no group");
}

void note_entities_in_several_groups(std::uint64_t in_several, const std::string& path,
                                     const std::function<void(const std::string&)>& note) {
    if (in_several == 0) return;
    note(fmt::format("{}: {} entities are in more physical groups than one: the first is kept",
                     path, in_several));
}

}  // namespace octetra::gmsh
