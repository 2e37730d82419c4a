#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/verify/verify.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Arguments that must be the same on all processes, with a different value on the last one.
namespace octetra::distributed {
namespace {

using test::world;

bool is_odd() { return world().rank() == world().size() - 1; }

/// Collective. The message of the InputError thrown by the work, which must be the same on all
/// processes.
std::string message_of(const std::function<void()>& work) {
    const auto words = test::thrown_by<InputError>(work);
    const auto all = test::of_all(std::vector<char>(words.begin(), words.end()));
    for (const auto& one : all) EXPECT_EQ(std::string(one.begin(), one.end()), words);
    return words;
}

/// Distributed in blocks, or all on the first process, where nothing is exchanged.
std::vector<AdaptiveMesh> meshes() {
    std::vector<AdaptiveMesh> all;
    const Mesh mesh = test::marked(test::perturbed_kuhn(3, 0.2, 1), 1);
    const Partition in_blocks{.method = PartitionMethod::block};
    for (const auto& ranks : {partition_cells(mesh, world().size(), in_blocks),
                              std::vector<int>(mesh.cells.size(), 0)}) {
        all.push_back(AdaptiveMesh::distribute(world(), mesh, ranks));
        (void)all.back().refine(Selection{.random = RandomShare{0.3, 5}});
    }
    return all;
}

class RefusedArguments : public testing::Test {
protected:
    void SetUp() override {
        if (world().size() == 1) GTEST_SKIP() << "there is no other process";
    }
    static std::string starting(const std::string& rest) {
        return "rank " + std::to_string(world().size() - 1) + ": the " + rest;
    }
};

TEST_F(RefusedArguments, AreValuesWithAnotherNumberOfComponents) {
    for (const AdaptiveMesh& mesh : meshes()) {
        const std::size_t components = is_odd() ? 512 : 1;
        std::vector<double> values(mesh.points().size() * components);
        std::iota(values.begin(), values.end(), 0.0);
        const std::vector<double> before = values;
        const std::string expected = starting("kind of the values is 512 of double for each ");
        const auto& sharing = mesh.vertex_sharing();
        const std::size_t count = mesh.points().size();
        EXPECT_TRUE(message_of([&] {
                        update_copies(world(), sharing, count, values, components);
                    }).starts_with(expected));
        EXPECT_TRUE(message_of([&] {
                        combine_everywhere(world(), sharing, count, values, std::plus<>(),
                                           components);
                    }).starts_with(expected));
        EXPECT_EQ(values, before);
        const GhostLayer layer = mesh.ghosts(GhostsBy::vertex);
        const std::vector<double> of_cells(mesh.cells().size() * components);
        EXPECT_TRUE(message_of([&] {
                        (void)layer.values(world(), of_cells, components);
                    }).starts_with(expected));
    }
}

TEST_F(RefusedArguments, AreValuesOfAnotherType) {
    for (const AdaptiveMesh& mesh : meshes()) {
        const auto with_some = [&](std::size_t count, auto&& work) {
            std::vector<double> reals(count, 1);
            std::vector<std::int64_t> integers(count, 1);
            return is_odd() ? work(integers) : work(reals);
        };
        const std::string expected = starting("kind of the values is 1 of long for each ");
        EXPECT_TRUE(message_of([&] {
                        with_some(mesh.points().size(), [&](auto& values) {
                            update_copies(world(), mesh.vertex_sharing(), values.size(), values);
                        });
                    }).starts_with(expected));
        const GhostLayer layer = mesh.ghosts(GhostsBy::face);
        EXPECT_TRUE(message_of([&] {
                        with_some(mesh.cells().size(),
                                  [&](auto& values) { (void)layer.values(world(), values); });
                    }).starts_with(expected));
        const Migration unmoved(world(), 5, 5);
        EXPECT_TRUE(message_of([&] {
                        with_some(5, [&](auto& values) { (void)unmoved.cells(values); });
                    }).starts_with(expected));
        const std::vector<double> five(5);
        EXPECT_TRUE(message_of([&] {
                        (void)(is_odd() ? unmoved.cells(five) : unmoved.vertices(five));
                    }).starts_with(starting("kind of the values is 1 of double for each ")));
    }
}

TEST_F(RefusedArguments, AreCombinationsByAnotherOperation) {
    for (const AdaptiveMesh& mesh : meshes()) {
        std::vector<int> values(mesh.points().size(), 1);
        const auto combine = [&](auto operation) {
            combine_everywhere(world(), mesh.vertex_sharing(), values.size(), values, operation);
        };
        const std::string words = message_of([&] {
            if (is_odd()) {
                combine(std::minus<int>());
            } else {
                combine(std::plus<int>());
            }
        });
        EXPECT_NE(words.find("combined by std::minus<int>, and "), std::string::npos) << words;
        EXPECT_EQ(values, std::vector<int>(values.size(), 1));
    }
}

TEST_F(RefusedArguments, AreSharersOfTheMeshAsItWas) {
    AdaptiveMesh mesh = std::move(meshes().front());
    const Sharing<VertexIndex> before = mesh.vertex_sharing();
    const GhostLayer ghosts_before = mesh.ghosts(GhostsBy::vertex);
    const std::size_t cells_before = mesh.cells().size();
    (void)mesh.refine(Selection{.all = true});
    const Sharing<VertexIndex>& sharing = is_odd() ? before : mesh.vertex_sharing();
    std::vector<int> values(mesh.points().size(), world().rank());
    const std::string words =
        message_of([&] { update_copies(world(), sharing, values.size(), values); });
    EXPECT_NE(words.find(" bytes of values, and "), std::string::npos) << words;
    EXPECT_EQ(values, std::vector<int>(values.size(), world().rank()));
    const GhostLayer ghosts = is_odd() ? ghosts_before : mesh.ghosts(GhostsBy::vertex);
    if (is_odd()) (void)mesh.ghosts(GhostsBy::vertex);
    values.resize(is_odd() ? cells_before : mesh.cells().size());
    EXPECT_NE(
        message_of([&] { (void)ghosts.values(world(), values); }).find(" bytes of values, and"),
        std::string::npos);
}

TEST_F(RefusedArguments, AreGhostsByAnotherRule) {
    for (const AdaptiveMesh& mesh : meshes()) {
        EXPECT_EQ(
            message_of([&] { (void)mesh.ghosts(is_odd() ? GhostsBy::vertex : GhostsBy::face); }),
            starting("argument by is vertex, and face on rank 0: all ranks must pass the same"));
    }
}

TEST_F(RefusedArguments, AreOtherPartitions) {
    const test::SharedFolder folder;
    meshes().front().save(folder / "a.octetra");
    (void)meshes().front().write(folder / "a.mesh");
    const auto other_than = [](const char* partition, const char* odd) {
        return parse_partition(is_odd() ? odd : partition);
    };
    const std::string expected =
        starting("partition is lepp, and rcb on rank 0: all ranks must pass the same");
    EXPECT_EQ(message_of([&] {
                  (void)AdaptiveMesh::read(world(), folder / "a.mesh", other_than("rcb", "lepp"));
              }),
              expected);
    EXPECT_EQ(message_of([&] {
                  (void)AdaptiveMesh::load(world(), folder / "a.octetra",
                                           other_than("rcb", "lepp"));
              }),
              expected);
    EXPECT_EQ(
        message_of([&] {
            (void)AdaptiveMesh::read(world(), folder / "a.mesh",
                                     other_than("random:1", "random:2"));
        }),
        starting("partition is random:2, and random:1 on rank 0: all ranks must pass the same"));
}

TEST_F(RefusedArguments, AreOtherOptionsOfTheVerifier) {
    for (const AdaptiveMesh& mesh : meshes()) {
        const auto verified_with = [&](const verify::VerifyOptions& odd) {
            const verify::VerifyOptions options = is_odd() ? odd : verify::VerifyOptions{};
            CanonicalMesh canonical = mesh.canonical();
            return message_of([&] {
                (void)verify::verify_mesh(verify::slice_of(canonical.whole()), world(), options);
            });
        };
        EXPECT_EQ(
            verified_with({.fast = true}),
            starting("option fast is true, and false on rank 0: all ranks must pass the same"));
        EXPECT_EQ(
            verified_with({.min_dihedral = 10}),
            starting(
                "option min_dihedral is 10, and none on rank 0: all ranks must pass the same"));
    }
}

}  // namespace
}  // namespace octetra::distributed
