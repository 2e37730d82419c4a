#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <petscdmda.h>

#include <octetra/core/error.hpp>
#include <octetra/petsc/from_plex.hpp>
#include <octetra/petsc/versions.hpp>
#include <octetra/verify/compare.hpp>
#include <octetra/verify/verify.hpp>

#include "petsc/plex_support.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Meshes from a DMPlex made by Octetra or by PETSc.
namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;

/// Removes what a plex cannot store, and duplicates.
Mesh as_plex_has_it(Mesh mesh) {
    mesh.point_markers.clear();
    mesh.attributes_per_point = 0;
    mesh.point_attributes.clear();
    mesh.group_names.clear();
    mesh.index_base = 0;
    const auto each_once = [](auto& list, auto& markers) {
        auto old_list = list;
        auto old_markers = markers;
        std::vector<std::remove_cvref_t<decltype(list.front())>> known;
        list.clear();
        markers.clear();
        for (std::size_t i = 0; i < old_list.size(); ++i) {
            auto key = old_list.data()[i];
            std::ranges::sort(key);
            if (std::ranges::find(known, key) != known.end()) continue;
            known.push_back(key);
            list.push_back(old_list.data()[i]);
            markers.push_back(old_markers.data()[i]);
        }
    };
    each_once(mesh.facets, mesh.facet_markers);
    each_once(mesh.edges, mesh.edge_markers);
    return mesh;
}

class FromPlex : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Partitions, FromPlex, testing::Values("rcb", "random:3"));

TEST_P(FromPlex, AMeshIsRestoredWithAllItsTags) {
    const AdaptiveMesh mesh = adapted_mesh(GetParam());
    const OwnedPlex plex(to_plex(mesh));
    const MeshFromPlex back = from_plex(plex);
    ASSERT_EQ(back.mesh.cells().size(), mesh.cells().size());
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        EXPECT_EQ(back.cell_points[c], PlexPoints::of(CellIndex{c}));
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(back.mesh.points()[back.mesh.cells()[c][k].value()],
                      mesh.points()[mesh.cells()[c][k].value()]);
        }
    }
    const Mesh before = as_plex_has_it(mesh.collect());
    const Mesh after = as_plex_has_it(back.mesh.collect());
    if (!test::world().is_first()) return;
    const auto comparison = verify::compare(before, after);
    EXPECT_NE(comparison.likeness, verify::Likeness::different)
        << comparison.difference_count << " differences, the first a "
        << (comparison.differences.empty() ? "" : comparison.differences[0].kind);
}

TEST_P(FromPlex, VerticesAreThePointsThatAreNamed) {
    const AdaptiveMesh mesh = adapted_mesh(GetParam());
    const OwnedPlex plex(to_plex(mesh));
    const MeshFromPlex back = from_plex(plex);
    const PlexPoints points = points_of(plex);
    ASSERT_EQ(back.vertex_points.size(), back.mesh.points().size());
    for (std::size_t v = 0; v < back.vertex_points.size(); ++v) {
        const auto place = static_cast<std::size_t>(back.vertex_points[v] - points.first_vertex);
        EXPECT_EQ(back.mesh.points()[v], mesh.points()[place]);
    }
}

/// The first process's lattice as a plex made and distributed by PETSc.
OwnedPlex lattice_of_petsc(std::size_t n, PetscBool interpolate) {
    const Mesh mesh = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    std::vector<PetscInt> cells;
    std::vector<PetscReal> points;
    if (test::world().is_first()) {
        for (const CellVertices& cell : mesh.cells) {
            for (const VertexIndex v : cell) cells.push_back(static_cast<PetscInt>(v.value()));
        }
        for (const Point& p : mesh.points) points.insert(points.end(), {p.x, p.y, p.z});
    }
    DM made = nullptr;
    EXPECT_EQ(
        DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 3, static_cast<PetscInt>(cells.size() / 4),
                                      static_cast<PetscInt>(points.size() / 3), 4, interpolate,
                                      cells.data(), 3, points.data(), &made),
        0);
    if (interpolate == PETSC_FALSE) return OwnedPlex(made);
    OwnedPlex whole(made);
    DMLabel faces = nullptr;
    EXPECT_EQ(DMCreateLabel(whole, "Face Sets"), 0);
    EXPECT_EQ(DMGetLabel(whole, "Face Sets", &faces), 0);
    EXPECT_EQ(DMPlexMarkBoundaryFaces(whole, 5, faces), 0);
    DM distributed = nullptr;
    EXPECT_EQ(DMPlexDistribute(whole, 0, nullptr, &distributed), 0);
    return distributed == nullptr ? std::move(whole) : OwnedPlex(distributed);
}

double area_of_facets(const AdaptiveMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.facets()) {
        const Point& p = mesh.points()[a.value()];
        const Point& q = mesh.points()[b.value()];
        const Point& r = mesh.points()[c.value()];
        const std::array<double, 3> u{q.x - p.x, q.y - p.y, q.z - p.z};
        const std::array<double, 3> w{r.x - p.x, r.y - p.y, r.z - p.z};
        area += std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                           u[0] * w[1] - u[1] * w[0]) /
                2;
    }
    return sum_over_all(area);
}

/// Checks that the mesh is the whole lattice with its boundary.
void expect_lattice(const AdaptiveMesh& mesh, std::size_t n) {
    EXPECT_EQ(test::world().sum(mesh.cells().size()), 6 * n * n * n);
    EXPECT_EQ(mesh.vertex_count(), (n + 1) * (n + 1) * (n + 1));
    EXPECT_NEAR(area_of_facets(mesh), 6, 1e-12);
    for (const Marker marker : mesh.facet_markers()) EXPECT_EQ(marker, 5);
    const Mesh whole = mesh.collect();
    if (!test::world().is_first()) return;
    EXPECT_TRUE(verify::verify_mesh(whole).valid());
}

TEST(PlexOfPetsc, BecomesAMeshWithItsBoundary) {
    const OwnedPlex plex = lattice_of_petsc(4, PETSC_TRUE);
    MeshFromPlex made = from_plex(plex);
    expect_lattice(made.mesh, 4);
    EXPECT_TRUE(made.mesh.regions().empty());
    (void)made.mesh.refine(Selection{.spheres = {{{0, 0, 0}, 0.5}}});
    const OwnedPlex refined(to_plex(made.mesh));
    expect_valid(refined);
    EXPECT_NEAR(area_of_facets(made.mesh), 6, 1e-12);
}

TEST(PlexOfPetsc, WithAnOverlapGivesEachCellOnce) {
    if (test::world().size() == 1) return;
    const OwnedPlex plex = lattice_of_petsc(4, PETSC_TRUE);
    OwnedPlex overlapping;
    must(DMPlexDistributeOverlap(plex, 1, nullptr, overlapping.address()));
    expect_lattice(from_plex(overlapping).mesh, 4);
}

TEST(PlexOfPetsc, NeedsNoFacesAndEdges) {
    const OwnedPlex plex = lattice_of_petsc(2, PETSC_FALSE);
    const MeshFromPlex made = from_plex(plex);
    EXPECT_EQ(test::world().sum(made.mesh.cells().size()), 48U);
    EXPECT_TRUE(made.mesh.facets().empty());
    const OwnedPlex again(to_plex(made.mesh));
    expect_valid(again);
}

TEST(PlexOfPetsc, OfAnotherKindIsRefused) {
    const auto refused = [](DM dm) {
        const OwnedPlex owned(dm);
        return test::thrown_by<InputError>([&] { (void)from_plex(owned); });
    };
    DM dm = nullptr;
    must(create_box_mesh(PETSC_COMM_WORLD, 2, PETSC_FALSE, &dm));
    EXPECT_THAT(refused(dm), testing::HasSubstr("dimension 2"));
    must(create_box_mesh(PETSC_COMM_WORLD, 3, PETSC_FALSE, &dm));
    EXPECT_THAT(refused(dm), testing::HasSubstr("is not a tetrahedron"));
    must(DMDACreate1d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, 8, 1, 1, nullptr, &dm));
    must(DMSetUp(dm));
    EXPECT_THAT(refused(dm), testing::HasSubstr("not a DMPlex"));
}

}  // namespace
}  // namespace octetra::petsc
