#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

namespace octetra::test {

/// Assembles the blocks of a mesh, and checks the guarantees of MeshSink.
class CollectingSink : public MeshSink {
public:
    Mesh mesh;
    std::size_t stretches = 0;
    bool is_finished = false;

    void expect_points(std::uint64_t count, std::size_t attributes_per_point,
                       bool has_markers) override {
        EXPECT_FALSE(points_.announced);
        points_ = {true, count, has_markers};
        mesh.attributes_per_point = attributes_per_point;
    }
    void take_points(std::span<const Point> points, std::span<const double> attributes,
                     std::span<const Marker> markers) override {
        check(points_, points.size(), markers.size());
        EXPECT_EQ(attributes.size(), points.size() * mesh.attributes_per_point);
        EXPECT_LE(attributes.size(), max_batch_size);
        add(mesh.points, points);
        add(mesh.point_attributes, attributes);
        add(mesh.point_markers, markers);
    }

    void expect_cells(std::uint64_t count, bool has_regions) override {
        announce(cells_, count, has_regions);
    }
    void take_cells(std::span<const CellVertices> cells, std::span<const Marker> regions) override {
        take(cells_, mesh.cells, mesh.regions, cells, regions);
    }

    void expect_facets(std::uint64_t count, bool has_markers) override {
        announce(facets_, count, has_markers);
    }
    void take_facets(std::span<const FacetVertices> facets,
                     std::span<const Marker> markers) override {
        take(facets_, mesh.facets, mesh.facet_markers, facets, markers);
    }

    void expect_edges(std::uint64_t count, bool has_markers) override {
        announce(edges_, count, has_markers);
    }
    void take_edges(std::span<const EdgeVertices> edges, std::span<const Marker> markers) override {
        take(edges_, mesh.edges, mesh.edge_markers, edges, markers);
    }

    void finish(const MeshFacts& facts) override {
        EXPECT_FALSE(is_finished);
        is_finished = true;
        for (const Kind& kind : {points_, cells_, facets_, edges_}) EXPECT_EQ(kind.left, 0U);
        keep_if(facts.has_point_markers, mesh.point_markers);
        keep_if(facts.has_regions, mesh.regions);
        keep_if(facts.has_facet_markers, mesh.facet_markers);
        keep_if(facts.has_edge_markers, mesh.edge_markers);
        mesh.index_base = facts.index_base;
        mesh.group_names = facts.group_names.list();
        EXPECT_EQ(facts.vertices, mesh.points.size());
        EXPECT_EQ(facts.first_midpoint, mesh.points.size());
        EXPECT_EQ(facts.cells, mesh.cells.size());
        EXPECT_EQ(facts.facets, mesh.facets.size());
        EXPECT_EQ(facts.edges, mesh.edges.size());
        EXPECT_EQ(facts.attributes_per_point, mesh.attributes_per_point);
    }

private:
    struct Kind {
        bool announced = false;
        std::uint64_t left = 0;
        bool has_markers = false;
    };

    static void keep_if(bool has_markers, auto& markers) {
        EXPECT_TRUE(has_markers || std::ranges::count(markers, 0) == std::ssize(markers));
        EXPECT_TRUE(!has_markers || !markers.empty());
        if (!has_markers) markers.clear();
    }
    static void add(auto& list, auto stretch) {
        list.insert(list.end(), stretch.begin(), stretch.end());
    }
    void announce(Kind& kind, std::uint64_t count, bool has_markers) const {
        EXPECT_TRUE(points_.announced);
        EXPECT_EQ(points_.left, 0U) << "points come first";
        EXPECT_FALSE(kind.announced);
        kind = {true, count, has_markers};
    }
    void check(Kind& kind, std::size_t count, std::size_t markers) {
        EXPECT_FALSE(is_finished);
        EXPECT_GE(count, 1U);
        EXPECT_LE(count, max_batch_size);
        EXPECT_LE(count, kind.left);
        EXPECT_EQ(markers, kind.has_markers ? count : 0);
        kind.left -= count;
        ++stretches;
    }
    void take(Kind& kind, auto& list, auto& list_markers, auto stretch, auto markers) {
        check(kind, stretch.size(), markers.size());
        for (const auto& vertices : stretch) {
            for (const VertexIndex v : vertices) EXPECT_LT(v, mesh.points.end_index());
        }
        add(list, stretch);
        add(list_markers, markers);
    }

    Kind points_;
    Kind cells_;
    Kind facets_;
    Kind edges_;
};

}  // namespace octetra::test
