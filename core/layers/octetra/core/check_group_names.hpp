#pragma once

#include <string>
#include <vector>

#include <octetra/core/group_names.hpp>

namespace octetra {

/// What is wrong with the names of groups, in words, or nothing: a dimension beyond 3, a name that
/// is empty or cannot be shown, two names of one group.
[[nodiscard]] std::string wrong_in(const std::vector<GroupName>& names);

}  // namespace octetra
