#include <algorithm>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/reference/refine.hpp>

#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/temporary_folder.hpp"

/// Numbering, maps, and refinement in several runs.
namespace octetra::reference {
namespace {

TEST(Levels, InTwoRunsAreTheSameAsInOne) {
    Mesh mesh = test::perturbed_kuhn(3, 0.3, 2);
    test::list_boundary(mesh);
    const std::vector<Selection> selections{
        {.all = true},
        {.spheres = {{{1, 1, 1}, 0.8}}},
        {.random = RandomShare{0.2, 5}},
        {.max_volume = 0.1},
    };
    for (const Selection& selection : selections) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            const Refinement at_once = refine(mesh, selection, scheme, 3);
            const Refinement first = refine(mesh, selection, scheme, 1);
            const Refinement rest = refine(first.mesh, selection, scheme, 2);
            ASSERT_TRUE(rest.mesh == at_once.mesh);
            for (CellIndex c{0}; c < rest.mesh.cells.end_index(); ++c) {
                ASSERT_EQ(first.maps.cell_to_parent[rest.maps.cell_to_parent[c]],
                          at_once.maps.cell_to_parent[c]);
            }
            auto midpoints = first.maps.midpoint_to_edge;
            midpoints.insert(midpoints.end(), rest.maps.midpoint_to_edge.begin(),
                             rest.maps.midpoint_to_edge.end());
            ASSERT_EQ(midpoints, at_once.maps.midpoint_to_edge);
        }
    }
}

TEST(Levels, ThroughFilesOfEveryFormatAreTheSameAsInMemory) {
    Mesh mesh = test::perturbed_kuhn(2, 0.3, 2);
    for (Point& p : mesh.points) p = {p.x / 3, p.y / 7, p.z / 11};
    test::list_boundary(mesh);
    mesh.index_base = 1;
    const Selection some{.random = RandomShare{0.3, 5}};
    const Mesh at_once = refine(mesh, some, Scheme::eight, 2).mesh;
    for (const std::string name : {"a.1.ele", "a.mesh"}) {
        const test::TemporaryFolder folder;
        (void)write_mesh(refine(mesh, some, Scheme::eight, 1).mesh, folder / name);
        EXPECT_EQ(refine(read_mesh(folder / name), some, Scheme::eight, 1).mesh, at_once) << name;
    }
}

TEST(CanonicalOrder, KeepsInputVerticesAndSortsTheMidpointsOfALevelByTheirEnds) {
    const Mesh mesh = test::perturbed_kuhn(3, 0.3, 6);
    const Refinement fine = refine(mesh, {.random = RandomShare{0.3, 5}}, Scheme::eight, 1);
    EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), fine.mesh.points.begin()));
    EXPECT_TRUE(std::ranges::is_sorted(fine.maps.midpoint_to_edge));
    VertexIndex v = fine.maps.first_midpoint;
    for (const auto& [a, b] : fine.maps.midpoint_to_edge) {
        ASSERT_LT(a, b);
        ASSERT_LT(b, v);
        ASSERT_EQ(fine.mesh.points[v], midpoint(mesh.points[a], mesh.points[b]));
        ++v;
    }
    EXPECT_EQ(v, fine.mesh.points.end_index());
}

TEST(CanonicalOrder, PutsChildrenAtThePositionOfTheirParent) {
    const Mesh mesh = test::perturbed_kuhn(3, 0.3, 6);
    const Refinement fine = refine(mesh, {.random = RandomShare{0.3, 5}}, Scheme::eight, 3);
    EXPECT_TRUE(std::ranges::is_sorted(fine.maps.cell_to_parent));
}

TEST(Selection, OfListedCellsIncludesTheirDescendants) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.2, 6);
    const Refinement fine = refine(mesh, {.cells = {GlobalCell{3}}}, Scheme::eight, 2);
    EXPECT_GE(std::ranges::count(fine.maps.cell_to_parent, CellIndex{3}), 64);
    EXPECT_EQ(test::count_faces(fine.mesh).faults, 0U);
}

TEST(Selection, ByVolumeEndsWhenNoCellIsTooLarge) {
    const Mesh mesh = test::perturbed_kuhn(2, 0.2, 6);
    const Selection large{.max_volume = 0.01};
    const Mesh fine = refine(mesh, large, Scheme::eight, 10).mesh;
    for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
        ASSERT_LE(volume(test::corners_of(fine, c)), 0.01);
    }
    EXPECT_EQ(refine(fine, large, Scheme::eight, 1).mesh, fine);
}

}  // namespace
}  // namespace octetra::reference
