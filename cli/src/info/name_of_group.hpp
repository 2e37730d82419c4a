#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <octetra/core/group_names.hpp>

namespace octetra::cli {

/// Returns the name of the group of a tag, or null. Facets with a negative marker belong to the
/// group of the absolute value, reversed (Gmsh).
[[nodiscard]] inline const std::string* name_of_group(const std::vector<GroupName>& names,
                                                      int dimension, std::int32_t tag) {
    const auto group = std::ranges::find_if(names, [&](const GroupName& each) {
        return each.dimension == dimension && (each.tag == tag || each.tag == -tag);
    });
    return group == names.end() ? nullptr : &group->name;
}

}  // namespace octetra::cli
