#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/group_names.hpp>

namespace octetra {

/// The group of elements without a tag in .msh files in which other elements have one. Gmsh saves
/// and refines only elements of groups if there is any group.
inline constexpr std::string_view untagged_group_name = "octetra:untagged";

/// Returns a message on what is wrong with the names of groups, or an empty string: a dimension
/// greater than 3, a name that is empty, reserved or not printable, or two names of one group.
[[nodiscard]] std::string wrong_in(const std::vector<GroupName>& names);

}  // namespace octetra
