#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/conservative_transfer.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

namespace octetra::distributed {
namespace {

using Complex = std::complex<double>;

/// The integral of component k of a P1 function over the whole mesh, and that of the mean of its
/// absolute values at corners, computed by cells: mean of the corners times volume.
std::array<Complex, 2> integrals(const AdaptiveMesh& mesh, const std::vector<Complex>& values,
                                 std::size_t components, std::size_t k) {
    std::vector<Complex> own(2);
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const double share = volume(corners_of(mesh, c)) / 4;
        for (const VertexIndex v : mesh.cells()[c]) {
            own[0] += share * values[v.value() * components + k];
            own[1] += share * std::abs(values[v.value() * components + k]);
        }
    }
    std::array<Complex, 2> whole{};
    for (const auto& of_one : test::of_all(own)) {
        for (std::size_t i = 0; i < 2; ++i) whole[i] += of_one[i];
    }
    return whole;
}

/// A mesh after three steps; coarsening removes vertices of some of them.
AdaptiveMesh fine_mesh(PartitionMethod method) {
    const Mesh input = test::perturbed_kuhn(3, 0.2, 2);
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), input,
        partition_cells(input, test::world().size(), {.method = method, .seed = 3}));
    for (const std::uint64_t k : {0U, 1U}) {
        (void)mesh.refine(Selection{.random = RandomShare{0.1, k}});
    }
    (void)mesh.refine(steps[0]);
    return mesh;
}

/// Two components of a function without smoothness, the same on all processes.
std::vector<Complex> rough(const AdaptiveMesh& mesh) {
    std::vector<Complex> values;
    for (const Point& p : mesh.points()) {
        values.emplace_back(std::sin(40 * p.x + 7 * p.y), std::cos(31 * p.z));
        values.emplace_back(1 + std::sin(90 * p.y), 0);
    }
    return values;
}

constexpr std::array methods{PartitionMethod::block, PartitionMethod::random};
constexpr std::array<double, 3> shares{0.02, 0.6, 1.0};  // incremental coarsening, and of all cells

TEST(ConservativeTransfer, KeepsTheIntegralWhereTheInterpolantChangesIt) {
    for (const PartitionMethod method : methods) {
        for (const double share : shares) {
            AdaptiveMesh mesh = fine_mesh(method);
            const std::vector<Complex> before = rough(mesh);
            std::array<std::array<Complex, 2>, 2> expected{};
            for (std::size_t k = 0; k < 2; ++k) expected[k] = integrals(mesh, before, 2, k);
            const Selection may_coarsen =
                share < 0.1 ? steps[0] : Selection{.random = RandomShare{share, 4}};
            const Adaptation step = mesh.coarsen(may_coarsen);
            ASSERT_TRUE(step.is_coarser());
            const auto after = transfer_conservatively(mesh, step, before, 2);
            const auto interpolated = step.transfer_vertices(before, 2);
            ASSERT_EQ(after.size(), interpolated.size());
            for (std::size_t k = 0; k < 2; ++k) {
                const double scale = std::abs(expected[k][1]);
                EXPECT_LT(std::abs(integrals(mesh, after, 2, k)[0] - expected[k][0]),
                          1e-13 * scale);
                EXPECT_GT(std::abs(integrals(mesh, interpolated, 2, k)[0] - expected[k][0]),
                          1e-6 * scale);
            }
            std::vector<Complex> copies = after;
            update_copies(mesh.processes(), mesh.vertex_sharing(), mesh.points().size(), copies, 2);
            EXPECT_EQ(copies, after);
        }
    }
}

TEST(ConservativeTransfer, LeavesAFunctionOfTheCoarseMeshAsItIs) {
    for (const PartitionMethod method : methods) {
        AdaptiveMesh mesh = fine_mesh(method);
        while (mesh.coarsen(Selection{.all = true}).changed) {
        }
        const std::vector<Complex> coarse = rough(mesh);
        const Adaptation finer = mesh.refine(Selection{.random = RandomShare{0.4, 9}});
        const auto fine = transfer_conservatively(mesh, finer, coarse, 2);
        EXPECT_EQ(fine, finer.transfer_vertices(coarse, 2));
        const Adaptation back = mesh.coarsen(Selection{.all = true});
        EXPECT_EQ(transfer_conservatively(mesh, back, fine, 2), coarse);
    }
}

TEST(ConservativeTransfer, RefusesValuesAndStepsThatDoNotFitOnAllProcesses) {
    AdaptiveMesh mesh = fine_mesh(PartitionMethod::random);
    const Adaptation step = mesh.coarsen(Selection{.all = true});
    std::vector<double> values(step.vertex_count_before, 1);
    if (test::world().is_first()) values.push_back(1);
    EXPECT_EQ(
        test::thrown_by<InputError>([&] { (void)transfer_conservatively(mesh, step, values); }),
        "values do not fit the mesh as it was before the step");
    values.resize(step.vertex_count_before);
    (void)mesh.refine(Selection{.all = true});
    EXPECT_EQ(
        test::thrown_by<InputError>([&] { (void)transfer_conservatively(mesh, step, values); }),
        "the step did not lead to the current mesh");
}

TEST(RemovedVertices, AreMidpointsOfEdgesWhoseEndsStay) {
    for (const PartitionMethod method : methods) {
        AdaptiveMesh mesh = fine_mesh(method);
        const std::vector<Point> points(mesh.points().begin(), mesh.points().end());
        const Adaptation step = mesh.coarsen(Selection{.random = RandomShare{0.9, 4}});
        EXPECT_EQ(step.removed_vertices.size() + mesh.points().size(), points.size());
        for (const auto& [before, ends, volume] : step.removed_vertices) {
            EXPECT_EQ(points[before.value()],
                      midpoint(mesh.points()[ends[0].value()], mesh.points()[ends[1].value()]));
            EXPECT_GT(volume, 0);
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
