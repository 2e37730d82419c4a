#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_share.hpp>

#include "verify/thread_group.hpp"

namespace octetra::test {

/// Concatenates the shares of all processes.
inline Mesh concatenated(const std::vector<std::optional<MeshShare>>& stretches) {
    Mesh whole;
    const auto append = [](auto& list, const auto& stretch) {
        list.insert(list.end(), stretch.begin(), stretch.end());
    };
    for (const auto& stretch : stretches) {
        EXPECT_EQ(stretch->first_vertex, whole.points.size());
        EXPECT_EQ(stretch->first_cell, whole.cells.size());
        EXPECT_EQ(stretch->first_facet, whole.facets.size());
        EXPECT_EQ(stretch->first_edge, whole.edges.size());
        const Mesh& lists = stretch->lists;
        whole.index_base = lists.index_base;
        whole.attributes_per_point = lists.attributes_per_point;
        whole.group_names = stretch->facts.group_names.list();
        append(whole.points, lists.points);
        append(whole.point_markers, lists.point_markers);
        append(whole.point_attributes, lists.point_attributes);
        append(whole.cells, lists.cells);
        append(whole.regions, lists.regions);
        append(whole.facets, lists.facets);
        append(whole.facet_markers, lists.facet_markers);
        append(whole.edges, lists.edges);
        append(whole.edge_markers, lists.edge_markers);
        for (const Feature f : all_features) append(whole.features[f], lists.features[f]);
    }
    for (const Feature f : all_features) sort_unique(whole.features[f]);
    return whole;
}

/// Checks that several processes that read this file in shares obtain its mesh, or nothing.
inline void expect_correct_shares(const std::filesystem::path& path) {
    for (const int size : {1, 2, 3, 5}) {
        std::vector<std::optional<MeshShare>> stretches(static_cast<std::size_t>(size));
        run_together(size, [&](const ProcessGroup& group) {
            stretches[static_cast<std::size_t>(group.rank())] = read_mesh_share(path, group);
        });
        for (const auto& stretch : stretches) {
            ASSERT_EQ(stretch.has_value(), stretches.front().has_value());
        }
        if (!stretches.front()) continue;
        ASSERT_NO_THROW({
            EXPECT_TRUE(concatenated(stretches) == read_mesh(path, {.only_syntax = true})) << size;
        });
    }
}

}  // namespace octetra::test
