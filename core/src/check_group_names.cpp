#include <octetra/core/check_group_names.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>

namespace octetra {

std::string wrong_in(const std::vector<GroupName>& names) {
    std::vector<std::pair<std::int32_t, std::int32_t>> groups;
    for (const GroupName& group : names) {
        if (group.dimension < 0 || group.dimension > 3) {
            return fmt::format("a group with a name has dimension {}, which must be from 0 to 3",
                               group.dimension);
        }
        if (group.name.empty() || !is_name(group.name)) {
            return fmt::format("the name of group {} of dimension {} is empty or not printable",
                               group.tag, group.dimension);
        }
        if (group.name == untagged_group_name) {
            return fmt::format("the name {} of group {} of dimension {} is reserved", group.name,
                               group.tag, group.dimension);
        }
        groups.emplace_back(group.dimension, group.tag);
    }
    std::ranges::sort(groups);
    const auto twice = std::ranges::adjacent_find(groups);
    if (twice == groups.end()) return {};
    return fmt::format("group {} of dimension {} has two names", twice->second, twice->first);
}

}  // namespace octetra
