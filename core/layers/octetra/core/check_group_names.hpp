#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/group_names.hpp>

namespace octetra {

/// The group of elements without a tag in .msh files where others have one: Gmsh saves and refines
/// only elements of groups, if there are any.
inline constexpr std::string_view untagged_group_name = "octetra:untagged";

/// What is wrong with the names of groups, in words, or nothing: a dimension beyond 3, a name that
/// is empty, reserved or cannot be shown, two names of one group.
[[nodiscard]] std::string wrong_in(const std::vector<GroupName>& names);

}  // namespace octetra
