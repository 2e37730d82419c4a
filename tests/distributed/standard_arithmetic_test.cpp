#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/predicted_cells.hpp>
#include <octetra/distributed/read_parts.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/compare.hpp>
#include <octetra/verify/verify.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/hostile_arithmetic.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

/// The same functions in the default floating-point environment and in a program with another one.
namespace octetra::distributed {
namespace {

using test::in_hostile_arithmetic;
using test::world;

/// Numbers of all magnitudes: a vertex with subnormal coordinates, and a mesh with subnormal
/// lengths.
std::vector<Mesh> meshes_of_any_scale() {
    Mesh ordinary = test::marked(test::perturbed_kuhn(3, 0.2, 1), 1);
    test::mark_duplicates(ordinary.facets, ordinary.facet_markers);
    test::mark_duplicates(ordinary.edges, ordinary.edge_markers);
    Mesh tiny = ordinary;
    for (Point& p : tiny.points) p = {p.x * 0x1p-1040, p.y * 0x1p-1040, p.z * 0x1p-1040};
    ordinary.points[VertexIndex{0}] = {1e-310, -3e-310, 0};
    return {ordinary, tiny};
}

/// The contents of all files of a folder, by name.
std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        contents[entry.path().filename().string()] = test::content_of(entry.path());
    }
    return contents;
}

TEST(StandardArithmetic, WritesAndReadsTheSameFilesInAnyEnvironment) {
    for (const Mesh& mesh : meshes_of_any_scale()) {
        for (const std::string name :
             {"m.ele", "m.mesh", "m.meshb", "m.msh", "m.vtu", "m.vtkhdf", "m.xdmf"}) {
            const test::TemporaryFolder expected;
            const test::TemporaryFolder found;
            const std::string lost = write_mesh(mesh, expected / name);
            EXPECT_EQ(in_hostile_arithmetic([&] { return write_mesh(mesh, found / name); }), lost);
            EXPECT_EQ(contents_of(found.path()), contents_of(expected.path())) << name;
            if (name.find("vt") != std::string::npos || name == "m.xdmf") continue;
            EXPECT_TRUE(in_hostile_arithmetic([&] { return read_mesh(found / name); }) ==
                        read_mesh(expected / name))
                << name;
        }
    }
}

TEST(StandardArithmetic, RefinesAndCoarsensByTheReferenceIdenticallyInAnyEnvironment) {
    for (const Mesh& mesh : meshes_of_any_scale()) {
        const auto work = [&] {
            const auto fine =
                reference::refine(mesh, {.random = RandomShare{0.2, 3}}, Scheme::eight, 2);
            reference::History history{.input = mesh};
            for (const Selection& selection :
                 {Selection{.random = RandomShare{0.2, 3}}, Selection{.all = true}}) {
                const auto now = reference::replay(history).back();
                history = reference::refined(history, reference::marked_cells(now, selection),
                                             Scheme::four);
            }
            const auto now = reference::replay(history).back();
            const auto marks = reference::marked_cells(now, {.random = RandomShare{0.9, 4}});
            return std::pair(fine.mesh, reference::coarsened(history, marks));
        };
        EXPECT_TRUE(in_hostile_arithmetic(work) == work());
    }
}

TEST(StandardArithmetic, VerifiesIdenticallyInAnyEnvironment) {
    for (const Mesh& mesh : meshes_of_any_scale()) {
        const Selection selection{.random = RandomShare{0.2, 3}};
        const Mesh fine = reference::refine(mesh, selection, Scheme::eight, 1).mesh;
        const auto work = [&] {
            const auto alone = verify::verify_mesh(fine, {.min_dihedral = 1});
            const auto refinement = verify::verify_refinement(
                mesh, fine, {.request = verify::Request{selection, Scheme::eight, 1}});
            const auto comparison = verify::compare(fine, fine);
            return std::tuple(alone.counts, refinement.counts, refinement.facts.rounding_bound,
                              alone.angles->min_dihedral, comparison.likeness);
        };
        EXPECT_TRUE(in_hostile_arithmetic(work) == work());
    }
}

TEST(StandardArithmetic, AdaptsMeshesIdenticallyInAnyEnvironment) {
    const test::SharedFolder folder;
    for (const Mesh& whole : meshes_of_any_scale()) {
        world().on_first([&] { (void)write_mesh(whole, folder / "m.ele"); });
        const auto steps = [&](AdaptiveMesh& mesh) {
            (void)mesh.refine({.random = RandomShare{0.2, 3}});
            (void)mesh.refine_evenly({.random = RandomShare{0.1, 4}}, {.most_over_mean = 1});
            (void)mesh.coarsen(Selection{.random = RandomShare{0.9, 5}});
            (void)mesh.rebalance({.most_over_mean = 1});
        };
        const auto adapted = [&](const std::string& name) {
            AdaptiveMesh mesh = AdaptiveMesh::read(world(), folder / "m.ele");
            steps(mesh);
            mesh.save(folder / name);
            return AdaptiveMesh::load(world(), folder / name);
        };
        const AdaptiveMesh expected = adapted("expected.octetra");
        const AdaptiveMesh found = in_hostile_arithmetic([&] { return adapted("found.octetra"); });
        EXPECT_TRUE(test::ObservedMesh(found) == test::ObservedMesh(expected));
        if (!world().is_first()) continue;  // only the first process has the folder
        EXPECT_EQ(test::content_of(folder / "found.octetra"),
                  test::content_of(folder / "expected.octetra"));
    }
}

TEST(StandardArithmetic, PartitionsAndMarksIdenticallyInAnyEnvironment) {
    for (const Mesh& mesh : meshes_of_any_scale()) {
        const auto partitions = [&] {
            const auto weights = predicted_cells(
                mesh, {.random = RandomShare{0.2, 3}, .max_volume = 1e-3}, Scheme::eight, 2);
            std::vector<std::vector<int>> parts;
            for (const auto method :
                 {PartitionMethod::rcb, PartitionMethod::lepp, PartitionMethod::dual}) {
                parts.push_back(partition_cells(mesh, 3, {.method = method}, weights));
            }
            return std::tuple(weights, parts,
                              measure_partition(mesh, parts[1], 3).longest_edge_links);
        };
        EXPECT_TRUE(in_hostile_arithmetic(partitions) == partitions());
        std::vector<double> indicators;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            indicators.push_back(static_cast<double>(c % 7) * 1e-310 / 3);
        }
        const auto marks = [&] {
            return std::tuple(mark_bulk(world(), indicators, 0.3),
                              mark_maximum(world(), indicators, 0.3),
                              mark_fraction(world(), indicators, 0.3));
        };
        EXPECT_TRUE(in_hostile_arithmetic(marks) == marks());
    }
}

TEST(StandardArithmetic, RefinesDistributedMeshesIdenticallyInAnyEnvironment) {
    const Partition in_blocks{.method = PartitionMethod::block};
    for (const Mesh& mesh : meshes_of_any_scale()) {
        const auto parts = partition_cells(mesh, world().size(), in_blocks);
        const auto work = [&] {
            DistributedMesh fine = distribute(world(), mesh, parts);
            refine(fine, {.random = RandomShare{0.2, 3}}, {.levels = 2});
            return collect(std::move(fine)).mesh;
        };
        EXPECT_TRUE(in_hostile_arithmetic(work) == work());
    }
}

}  // namespace
}  // namespace octetra::distributed
