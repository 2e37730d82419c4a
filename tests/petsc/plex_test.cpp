#include <array>
#include <limits>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>

#include "petsc/plex_support.hpp"
#include "support/thrown.hpp"

/// A mesh as a DMPlex: its points, their cones and their sharers.
namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;
using distributed::FaceIndex;

/// Initialises PETSc for the whole run; MPI is initialised before, or by PETSc.
class WithPetsc : public testing::Environment {
public:
    void SetUp() override { must(PetscInitializeNoArguments()); }
    void TearDown() override { must(PetscFinalize()); }
};
const testing::Environment* const with_petsc = testing::AddGlobalTestEnvironment(new WithPetsc);

class Plex : public testing::TestWithParam<const char*> {
protected:
    AdaptiveMesh mesh_ = adapted_mesh(GetParam());
    OwnedPlex plex_{to_plex(mesh_)};
    PlexPoints points_ = points_of(plex_);
};
INSTANTIATE_TEST_SUITE_P(Partitions, Plex, testing::Values("rcb", "random:3", "block"));

TEST_P(Plex, PassesTheChecksOfPetsc) { expect_valid(plex_); }

TEST_P(Plex, HasTheCellsOfTheMeshWithTwoVerticesExchanged) {
    PetscInt begin = 0;
    PetscInt end = 0;
    must(DMPlexGetHeightStratum(plex_, 0, &begin, &end));
    ASSERT_EQ(begin, 0);
    ASSERT_EQ(static_cast<std::size_t>(end), mesh_.cells().size());
    for (std::size_t c = 0; c < mesh_.cells().size(); ++c) {
        const auto& [v0, v1, v2, v3] = mesh_.cells()[c];
        EXPECT_THAT(
            vertices_of(plex_, PlexPoints::of(CellIndex{c})),
            testing::ElementsAre(points_.of(v1), points_.of(v0), points_.of(v2), points_.of(v3)));
    }
}

TEST_P(Plex, HasTheFacesAndEdgesOfTheMesh) {
    const auto faces = mesh_.number_faces();
    const auto edges = mesh_.number_edges();
    EXPECT_EQ(points_.first_edge, points_.of(FaceIndex{faces.vertices.size()}));
    EXPECT_EQ(points_.end, points_.of(EdgeIndex{edges.vertices.size()}));
    for (FaceIndex f{0}; f < faces.vertices.end_index(); ++f) {
        const auto& [a, b, c] = faces.vertices[f];
        EXPECT_THAT(vertices_of(plex_, points_.of(f)),
                    testing::ElementsAre(points_.of(a), points_.of(b), points_.of(c)));
    }
    for (EdgeIndex e{0}; e < edges.vertices.end_index(); ++e) {
        const auto& [a, b] = edges.vertices[e];
        EXPECT_THAT(vertices_of(plex_, points_.of(e)),
                    testing::ElementsAre(points_.of(a), points_.of(b)));
    }
    for (CellIndex c{0}; c < faces.of_cell.end_index(); ++c) {
        const PetscInt* cone = nullptr;
        must(DMPlexGetCone(plex_, PlexPoints::of(c), &cone));
        std::vector<PetscInt> expected;
        for (const FaceIndex f : faces.of_cell[c]) expected.push_back(points_.of(f));
        EXPECT_THAT(std::vector(cone, cone + 4), testing::UnorderedElementsAreArray(expected));
    }
}

TEST_P(Plex, HasTheCoordinatesOfTheMesh) {
    Vec values = nullptr;
    PetscSection section = nullptr;
    must(DMGetCoordinatesLocal(plex_, &values));
    must(DMGetCoordinateSection(plex_, &section));
    const PetscScalar* numbers = nullptr;
    must(VecGetArrayRead(values, &numbers));
    for (std::size_t v = 0; v < mesh_.points().size(); ++v) {
        PetscInt at = 0;
        must(PetscSectionGetOffset(section, points_.of(VertexIndex{v}), &at));
        const Point p{numbers[at], numbers[at + 1], numbers[at + 2]};
        EXPECT_EQ(p, mesh_.points()[v]);
    }
    must(VecRestoreArrayRead(values, &numbers));
}

/// Global numbers, by point.
std::vector<std::int64_t> numbers_of(const AdaptiveMesh& mesh, const PlexPoints& points) {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(points.end), -1);
    const auto at = [&](PetscInt p) -> std::int64_t& {
        return numbers[static_cast<std::size_t>(p)];
    };
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        at(points.of(VertexIndex{v})) = static_cast<std::int64_t>(mesh.vertex_numbers()[v]);
    }
    const auto faces = mesh.number_faces();
    for (FaceIndex f{0}; f < faces.numbers.end_index(); ++f) {
        at(points.of(f)) = static_cast<std::int64_t>(faces.numbers[f]);
    }
    const auto edges = mesh.number_edges();
    for (EdgeIndex e{0}; e < edges.numbers.end_index(); ++e) {
        at(points.of(e)) = static_cast<std::int64_t>(edges.numbers[e]);
    }
    return numbers;
}

TEST_P(Plex, SharesEachPointWithItsOwnerAndNoOther) {
    const std::vector<std::int64_t> expected = numbers_of(mesh_, points_);
    const std::vector<char> is_leaf = are_leaves(plex_);
    if (test::world().size() > 1) {
        std::vector<std::int64_t> numbers = expected;
        for (std::size_t p = 0; p < numbers.size(); ++p) {
            if (is_leaf[p] != 0) numbers[p] = -7;
        }
        PetscSF sharers = nullptr;
        must(DMGetPointSF(plex_, &sharers));
        must(PetscSFBcastBegin(sharers, MPI_INT64_T, expected.data(), numbers.data(), MPI_REPLACE));
        must(PetscSFBcastEnd(sharers, MPI_INT64_T, expected.data(), numbers.data(), MPI_REPLACE));
        EXPECT_EQ(numbers, expected);
    }
    const auto own = [&](PetscInt begin, PetscInt end) {
        return test::world().sum(static_cast<std::uint64_t>(
            std::count(is_leaf.begin() + begin, is_leaf.begin() + end, 0)));
    };
    EXPECT_EQ(own(points_.first_vertex, points_.first_face), mesh_.vertex_count());
    EXPECT_EQ(own(points_.first_face, points_.first_edge), mesh_.number_faces().count);
    EXPECT_EQ(own(points_.first_edge, points_.end), mesh_.number_edges().count);
    for (std::size_t v = 0; v < mesh_.points().size(); ++v) {
        const VertexIndex vertex{v};
        EXPECT_EQ(is_leaf[static_cast<std::size_t>(points_.of(vertex))] == 0,
                  mesh_.vertex_sharing().is_owned(vertex));
    }
}

TEST_P(Plex, StaysUnchangedWhenTheMeshIsModified) {
    (void)mesh_.refine(Selection{.all = true});
    mesh_ = adapted_mesh("rcb", 1);
    expect_valid(plex_);
}

TEST_P(Plex, IsRefinedAndDistributedByPetsc) {
    OwnedPlex refined;
    must(DMPlexSetRefinementUniform(plex_, PETSC_TRUE));
    must(DMRefine(plex_, PETSC_COMM_WORLD, refined.address()));
    expect_valid(refined);
    OwnedPlex overlapping;
    if (test::world().size() == 1) return;
    must(DMPlexDistributeOverlap(plex_, 1, nullptr, overlapping.address()));
    PetscInt begin = 0;
    PetscInt end = 0;
    must(DMPlexGetHeightStratum(overlapping, 0, &begin, &end));
    EXPECT_GT(static_cast<std::size_t>(end - begin), mesh_.cells().size());
}

TEST(PlexOfOneRank, LeavesTheOtherRanksWithoutCells) {
    const Mesh input = test::marked_lattice(2, 1);
    const std::vector<int> ranks(input.cells.size(), test::world().size() - 1);
    const AdaptiveMesh mesh = AdaptiveMesh::distribute(test::world(), input, ranks);
    const OwnedPlex plex(to_plex(mesh));
    expect_valid(plex);
    EXPECT_EQ(points_of(plex).of(CellIndex{mesh.cells().size()}), points_of(plex).first_vertex);
}

TEST_P(Plex, LabelsTheBoundaryAndNoFaceBetweenProcesses) {
    PetscInt count = 0;
    must(DMGetStratumSize(plex_, "boundary", 1, &count));
    EXPECT_EQ(static_cast<std::size_t>(count), mesh_.boundary().size());
    for (PetscInt f = points_.first_face; f < points_.first_edge; ++f) {
        PetscInt value = 0;
        PetscInt cells = 0;
        must(DMGetLabelValue(plex_, "boundary", f, &value));
        must(DMPlexGetSupportSize(plex_, f, &cells));
        EXPECT_TRUE(value != 1 || cells == 1);
    }
}

TEST(PlexRefusal, OfAnotherGroupIsThrownIdenticallyOnAll) {
    if (test::world().size() == 1) return;
    const AdaptiveMesh mesh = adapted_mesh("rcb", 1);
    const std::string said =
        test::thrown_by<InputError>([&] { (void)to_plex(mesh, PETSC_COMM_SELF); });
    EXPECT_THAT(said, testing::HasSubstr("rank 0 of"));
}

}  // namespace
}  // namespace octetra::petsc
