#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/check_group_names.hpp>
#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/mesh.hpp>

/// Reads the section $PhysicalNames, which is text also in binary files.
namespace octetra::gmsh {

/// Parses a line such as `2 5 "outer wall"`. The name extends from the first to the last quotation
/// mark. Returns nothing for a line of another form.
[[nodiscard]] std::optional<GroupName> parse_group_name(std::string_view line);

/// The physical groups named untagged_group_name, whose elements have no marker.
class UntaggedGroups {
public:
    void add(std::int32_t dimension, Marker tag) { groups_.emplace_back(dimension, tag); }
    /// Returns the marker of an element of this group. A negative tag denotes a reversed entity.
    [[nodiscard]] Marker marker_of(std::int32_t dimension, Marker tag) const {
        const auto is_untagged = [&](const std::pair<std::int32_t, Marker>& group) {
            const std::int64_t wide = group.second;
            return group.first == dimension && (tag == wide || tag == -wide);
        };
        return std::ranges::any_of(groups_, is_untagged) ? 0 : tag;
    }

private:
    std::vector<std::pair<std::int32_t, Marker>> groups_;
};

/// Reads the group names; each group may have only one. Empty and invalid names are skipped;
/// returns their number.
template <class Input>
std::uint64_t read_group_names(Input& in, std::vector<GroupName>& names, UntaggedGroups& untagged) {
    const std::uint64_t count = in.count_line("the number of names");
    in.check_count(count, 3, 4, "names");
    std::uint64_t ignored = 0;
    std::vector<std::pair<std::int32_t, Marker>> groups;
    for (std::uint64_t i = 0; i < count; ++i) {
        auto group = parse_group_name(in.line("the name of a group"));
        if (!group) {
            in.fail("the name of a group is a line of its dimension, its tag and \"the name\"");
        }
        groups.emplace_back(group->dimension, group->tag);
        if (group->name == untagged_group_name) {
            untagged.add(group->dimension, group->tag);
        } else if (group->name.empty() || !is_name(group->name)) {
            ++ignored;
        } else {
            names.push_back(std::move(*group));
        }
    }
    std::ranges::sort(groups);
    const auto twice = std::ranges::adjacent_find(groups);
    if (twice == groups.end()) return ignored;
    in.fail(fmt::format("group {} of dimension {} has two names", twice->second, twice->first));
}

}  // namespace octetra::gmsh
