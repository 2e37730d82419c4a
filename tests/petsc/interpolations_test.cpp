#include <octetra/petsc/interpolations.hpp>

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/partition.hpp>

#include "petsc/plex_support.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Matrices between the levels of a mesh, for PETSc's multigrid.
namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;
using distributed::Levels;

class OwnedMatrices {
public:
    explicit OwnedMatrices(std::vector<Mat> matrices) : matrices_(std::move(matrices)) {}
    ~OwnedMatrices() {
        for (Mat& matrix : matrices_) (void)MatDestroy(&matrix);
    }
    OwnedMatrices(const OwnedMatrices&) = delete;
    OwnedMatrices& operator=(const OwnedMatrices&) = delete;
    OwnedMatrices(OwnedMatrices&&) = delete;
    OwnedMatrices& operator=(OwnedMatrices&&) = delete;
    [[nodiscard]] std::size_t size() const { return matrices_.size(); }
    [[nodiscard]] Mat operator[](std::size_t k) const { return matrices_.at(k); }

private:
    std::vector<Mat> matrices_;
};

auto index_map_of(const Levels& levels, std::size_t k) {
    return make_index_map(levels.processes(), levels.vertex_sharing(k), levels.points(k).size());
}

/// Collective. The values of a linear function at the vertices of a level.
Vec linear_on(const Levels& levels, std::size_t k) {
    const auto map = index_map_of(levels, k);
    Vec vector = nullptr;
    must(VecCreateMPI(PETSC_COMM_WORLD, static_cast<PetscInt>(map.owned_count), PETSC_DETERMINE,
                      &vector));
    PetscScalar* values = nullptr;
    must(VecGetArray(vector, &values));
    for (std::size_t i = 0; i < map.owned_count; ++i) {
        const Point& p = levels.points(k)[map.entities[i].value()];
        values[i] = 1 + p.x - 2 * p.y + 0.5 * p.z;
    }
    must(VecRestoreArray(vector, &values));
    return vector;
}

std::array<double, 3> cross(const Point& a, const Point& b, const Point& c) {
    const std::array u{b.x - a.x, b.y - a.y, b.z - a.z};
    const std::array v{c.x - a.x, c.y - a.y, c.z - a.z};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The stiffness matrix of a cell. The gradient of the hat function of a vertex is the area normal
/// of the opposite face, divided by six times the volume.
std::array<PetscScalar, 16> stiffness(const std::array<Point, 4>& p) {
    std::array<std::array<double, 3>, 4> normals{};
    double six_volumes = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto [a, b, c] = cell_faces[i];
        normals[i] = cross(p[a], p[b], p[c]);
        six_volumes = dot(normals[i], {p[i].x - p[a].x, p[i].y - p[a].y, p[i].z - p[a].z});
        if (six_volumes < 0) {
            for (double& x : normals[i]) x = -x;
        }
    }
    std::array<PetscScalar, 16> values{};
    for (std::size_t i = 0; i < 16; ++i) {
        values[i] = dot(normals[i / 4], normals[i % 4]) / (6 * std::abs(six_volumes));
    }
    return values;
}

/// Collective. Laplace's operator with linear elements on a level.
Mat laplacian_on(const Levels& levels, std::size_t k) {
    const auto map = index_map_of(levels, k);
    const auto own = static_cast<PetscInt>(map.owned_count);
    Mat matrix = nullptr;
    must(MatCreateAIJ(PETSC_COMM_WORLD, own, own, PETSC_DETERMINE, PETSC_DETERMINE, 64, nullptr, 64,
                      nullptr, &matrix));
    must(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
    for (const CellVertices& cell : levels.lists(k).cells) {
        std::array<PetscInt, 4> rows{};
        std::array<Point, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            rows[i] = static_cast<PetscInt>(map.numbers[cell[i].value()]);
            corners[i] = levels.points(k)[cell[i].value()];
        }
        must(MatSetValues(matrix, 4, rows.data(), 4, rows.data(), stiffness(corners).data(),
                          ADD_VALUES));
    }
    must(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    must(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    return matrix;
}

/// A mesh after random steps of refinement, coarsening and migration.
class InterpolationsOf : public testing::TestWithParam<std::tuple<std::uint64_t, Closure>> {
protected:
    InterpolationsOf() {
        std::mt19937_64 random(std::get<0>(GetParam()));
        const distributed::StepOptions options{.closure = std::get<1>(GetParam())};
        for (int step = 0; step < 4; ++step) {
            const double share = step == 0 ? 0.5 : 0.2;
            (void)mesh.refine(Selection{.random = RandomShare{share, random()}}, options);
            if (step == 2) (void)mesh.coarsen(Selection{.random = RandomShare{0.8, random()}});
            if (step % 2 == 1) (void)mesh.rebalance({.most_over_mean = 1});
        }
    }

    const Mesh input = test::perturbed_kuhn(1, 0.2, std::get<0>(GetParam()));
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), input,
        partition_cells(input, test::world().size(), distributed::parse_partition("random:3")));
};

TEST_P(InterpolationsOf, LevelsReproduceLinearFunctions) {
    const Levels levels = mesh.levels();
    const OwnedMatrices matrices(interpolations(levels));
    ASSERT_EQ(matrices.size(), levels.count() - 1);
    ASSERT_GE(matrices.size(), 2U);
    for (std::size_t k = 0; k < matrices.size(); ++k) {
        Vec coarse = linear_on(levels, k);
        Vec fine = linear_on(levels, k + 1);
        must(VecScale(fine, -1));
        must(MatMultAdd(matrices[k], coarse, fine, fine));
        PetscReal difference = 1;
        must(VecNorm(fine, NORM_INFINITY, &difference));
        EXPECT_LE(difference, 1e-14) << "level " << k;
        must(VecDestroy(&coarse));
        must(VecDestroy(&fine));
    }
}

TEST_P(InterpolationsOf, LevelsReproduceTheOperatorOfTheCoarserLevel) {
    const Levels levels = mesh.levels();
    const OwnedMatrices matrices(interpolations(levels));
    for (std::size_t k = 0; k < matrices.size(); ++k) {
        Mat fine = laplacian_on(levels, k + 1);
        Mat coarse = laplacian_on(levels, k);
        Mat product = nullptr;
        must(MatPtAP(fine, matrices[k], MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
        PetscReal norm = 0;
        PetscReal difference = 1;
        must(MatNorm(coarse, NORM_FROBENIUS, &norm));
        must(MatAXPY(product, -1, coarse, DIFFERENT_NONZERO_PATTERN));
        must(MatNorm(product, NORM_FROBENIUS, &difference));
        EXPECT_LE(difference, 1e-13 * norm) << "level " << k;
        for (Mat* matrix : {&fine, &coarse, &product}) must(MatDestroy(matrix));
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, InterpolationsOf,
                         testing::Combine(testing::Range<std::uint64_t>(1, 4),
                                          testing::Values(Closure::longest_edge,
                                                          Closure::regular)));

TEST(Interpolations, RefuseAnotherCommunicatorOnAllProcesses) {
    const AdaptiveMesh mesh = adapted_mesh("random:3");
    if (test::world().size() == 1) {
        EXPECT_EQ(OwnedMatrices(interpolations(mesh.levels(), PETSC_COMM_SELF)).size(),
                  mesh.levels().count() - 1);
        return;
    }
    EXPECT_THAT(
        test::thrown_by<InputError>([&] { (void)interpolations(mesh.levels(), PETSC_COMM_SELF); }),
        testing::HasSubstr("of the communicator"));
}

}  // namespace
}  // namespace octetra::petsc
