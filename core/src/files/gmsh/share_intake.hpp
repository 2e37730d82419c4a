#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>

#include "files/gmsh/group_names.hpp"
#include "files/gmsh/ignored.hpp"
#include "files/gmsh/node_tags.hpp"
#include "files/gmsh/row_error.hpp"
#include "files/input/growing_mesh.hpp"

namespace octetra::gmsh {

/// Receives the share of a file that one process reads. Has the functions of MeshIntake that the
/// readers of sections call, and performs those of its checks that need only a row. Vertices are
/// provisional indices of tags.
class ShareIntake {
public:
    explicit ShareIntake(Mesh& lists) : lists_(&lists) {}

    void expect_nodes(std::uint64_t count) {
        reserve_in_huge_pages(tags_, count);
        reserve_in_huge_pages(lists_->points, count);
    }
    void take_tag(std::uint64_t tag, std::uint64_t /*place*/, std::uint64_t /*step*/) {
        tags_.push_back(tag);
    }
    void take_point(const Point& point) { lists_->points.push_back(point); }

    /// To be called after the last node.
    [[nodiscard]] std::vector<std::uint64_t> release_tags() { return std::exchange(tags_, {}); }
    void set_node_tags(const NodeTags& tags) { node_tags_ = &tags; }

    template <class I, std::size_t N>
    void make_room(const EntityKind<I, N>& kind, std::uint64_t count) {
        auto& list = lists_->*kind.list;
        const std::size_t needed = list.size() + count;
        if (needed <= list.capacity()) return;
        const std::size_t room = std::max(needed, list.size() + list.size() / 2);
        reserve_in_huge_pages(list, room);
        reserve_in_huge_pages(lists_->*kind.markers, room);
    }
    static constexpr std::size_t most_at_once = 128;
    template <class I, std::size_t N>
    [[nodiscard]] RowError take(const EntityKind<I, N>& kind,
                                std::span<const std::array<std::uint64_t, N>> rows, Marker marker,
                                std::uint64_t /*place*/, std::uint64_t /*step*/) {
        const Marker kept_marker = untagged.marker_of(N - 1, marker);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) {
                vertices[k] = node_tags_->provisional_index(rows[i][k]);
                if (vertices[k].is_none()) return {i, "there is no such node"};
                for (std::size_t j = 0; j < k; ++j) {
                    if (vertices[j] == vertices[k]) return {i, "the same vertex twice"};
                }
            }
            (lists_->*kind.list).push_back(vertices);
            (lists_->*kind.markers).push_back(kept_marker);
        }
        return {};
    }
    void skip(Shape shape, std::uint64_t count) { ignored.add(shape, count); }
    void skip_degenerate_line() { ++ignored.degenerate_lines; }
    void skip_interface(std::uint64_t count) { ignored.interfaces += count; }
    void skip_in_another_group() { ++ignored.in_another_group; }
    void note_missing_entity(std::uint64_t count) { ignored.of_missing_entities += count; }

    /// elements left out by this process
    IgnoredContent ignored;
    UntaggedGroups untagged;

private:
    Mesh* lists_;
    std::vector<std::uint64_t> tags_;
    const NodeTags* node_tags_ = nullptr;
};

}  // namespace octetra::gmsh
