#include "files/gmsh/left_out.hpp"

#include <string_view>

#include <fmt/format.h>

namespace octetra::gmsh {

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
    tell_of(left_out.names, "names of groups are empty, or no UTF-8 text, and are not kept");
    tell_of(left_out.in_another_group,
            "elements are in more physical groups than one: the first is kept");
    tell_of(left_out.of_missing_entities,
            "elements are of entities that $Entities does not list, and in no group");
}

void tell_of_entities(std::uint64_t in_several, const std::string& path,
                      const std::function<void(const std::string&)>& note) {
    if (in_several == 0) return;
    note(fmt::format("{}: {} entities are in more physical groups than one: the first is kept",
                     path, in_several));
}

    tell_of(left_out.degenerate_lines, "lines have the same node twice and are not kept");
}  // namespace octetra::gmsh
