#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/reference/history.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/sealed_checkpoint.hpp"
#include "support/thrown.hpp"

/// AdaptiveMesh::save and load.
namespace octetra::distributed {
namespace {

using test::world;

Selection some(double share, std::uint64_t seed) { return {.random = RandomShare{share, seed}}; }

/// Steps that change few or many cells, refining and coarsening.
void adapt(AdaptiveMesh& mesh, std::uint64_t seed, int steps) {
    std::mt19937_64 random(seed);
    for (int k = 0; k < steps; ++k) {
        constexpr std::array<double, 4> shares{0.002, 0.02, 0.2, 0.9};
        const std::uint64_t draw = random();
        if (draw % 3 != 0) {
            (void)mesh.refine(some(shares[draw % 2], random()));
        } else {
            (void)mesh.coarsen(some(shares[2 + draw % 2], random()));
        }
    }
}

/// Its lists of points, cells and cuts extend over several blocks.
Mesh input_of(std::uint64_t seed) { return test::featured(test::marked_lattice(16, seed), seed); }

AdaptiveMesh distributed_mesh(const Communicator& processes, Mesh mesh,
                              const std::string& partition) {
    std::vector<int> parts = partition_cells(mesh, processes.size(), parse_partition(partition));
    return AdaptiveMesh::distribute(processes, std::move(mesh), parts);
}

template <class T>
Field field_of(const AdaptiveMesh& mesh, std::string name, FieldOn on, std::size_t components) {
    std::vector<T> values;
    if (on == FieldOn::vertices) {
        for (const GlobalVertex v : mesh.vertex_numbers()) {
            for (std::size_t k = 0; k < components; ++k) {
                values.push_back(static_cast<T>(static_cast<std::uint64_t>(v) * 8 + k));
            }
        }
    } else {
        for (const CellVertices& cell : mesh.cells()) {
            for (std::size_t k = 0; k < components; ++k) {
                values.push_back(static_cast<T>(mesh.points()[cell[k % 4].value()].x * 1000));
            }
        }
    }
    return {std::move(name), on, components, std::move(values)};
}

std::vector<Field> fields_of(const AdaptiveMesh& mesh) {
    return {field_of<double>(mesh, "u", FieldOn::vertices, 1),
            field_of<float>(mesh, "velocity", FieldOn::vertices, 3),
            field_of<std::int32_t>(mesh, "material", FieldOn::cells, 1),
            field_of<std::int64_t>(mesh, "Größe", FieldOn::cells, 2)};
}

class Checkpoint : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Checkpoint, IsTheSameBytesOnAnyNumberOfRanks) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh = distributed_mesh(world(), input_of(GetParam()), "random:3");
    adapt(mesh, GetParam(), 5);
    mesh.save(folder / "together.octetra", fields_of(mesh));
    world().on_first([&] {
        AdaptiveMesh alone = distributed_mesh(Communicator(), input_of(GetParam()), "block");
        adapt(alone, GetParam(), 5);
        alone.save(folder / "alone.octetra", fields_of(alone));
        EXPECT_EQ(test::content_of(folder / "together.octetra"),
                  test::content_of(folder / "alone.octetra"));
    });
}

TEST_P(Checkpoint, RestoresTheMeshWithAnyPartition) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh = distributed_mesh(world(), input_of(GetParam()), "block");
    adapt(mesh, GetParam(), 5);
    mesh.save(folder / "state.octetra", fields_of(mesh));
    const Mesh expected = mesh.collect();
    for (const std::string method : {"rcb", "dual", "random:7"}) {
        std::vector<Field> fields;
        const AdaptiveMesh loaded =
            AdaptiveMesh::load(world(), folder / "state.octetra", parse_partition(method), &fields);
        EXPECT_TRUE(loaded.collect() == expected || !world().is_first());
        EXPECT_EQ(fields, fields_of(loaded));
    }
}

TEST_P(Checkpoint, ContinuesLikeTheSavedMesh) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh = distributed_mesh(world(), input_of(GetParam()), "random:5");
    adapt(mesh, GetParam(), 4);
    mesh.save(folder / "state.octetra");
    AdaptiveMesh loaded = AdaptiveMesh::load(world(), folder / "state.octetra");
    for (AdaptiveMesh* each : {&mesh, &loaded}) adapt(*each, GetParam() + 100, 4);
    EXPECT_TRUE(loaded.collect() == mesh.collect());
    mesh.save(folder / "a.octetra");
    loaded.save(folder / "b.octetra");
    world().on_first([&] {
        EXPECT_EQ(test::content_of(folder / "a.octetra"), test::content_of(folder / "b.octetra"));
    });
}

TEST_P(Checkpoint, HasTheReferencesInputAndSteps) {
    const test::SharedFolder folder;
    const Mesh input = test::featured(test::marked_lattice(4, GetParam()), GetParam());
    AdaptiveMesh mesh = distributed_mesh(world(), input, "random:3");
    reference::History history{input, {}};
    for (std::uint64_t k = 0; k < 3; ++k) {
        const Selection selection = some(0.1, GetParam() + k);
        const auto marks = marked_cells(reference::replay(history).back(), selection);
        history = reference::refined(history, marks, Scheme::eight);
        (void)mesh.refine(selection);
    }
    mesh.save(folder / "state.octetra");
    world().on_first([&] {
        const octetra::Checkpoint read = read_checkpoint(folder / "state.octetra");
        EXPECT_EQ(read.input, input);
        ASSERT_EQ(read.steps.size(), history.steps.size());
        const auto meshes = reference::replay(history);
        for (std::size_t t = 0; t < read.steps.size(); ++t) {
            EXPECT_EQ(read.steps[t].size(), meshes[t].mesh.cells.size());
            EXPECT_EQ(read.facts.steps[t].cells_before, meshes[t].mesh.cells.size());
        }
        EXPECT_EQ(read.facts.cells_now, meshes.back().mesh.cells.size());
        EXPECT_EQ(read.facts.vertices_now, meshes.back().mesh.points.size());
    });
}

INSTANTIATE_TEST_SUITE_P(Seeds, Checkpoint, testing::Range<std::uint64_t>(0, 2));

TEST(CheckpointOfAMeshThatIsTheInput, HasNoSteps) {
    const test::SharedFolder folder;
    const Mesh input = input_of(1);
    distributed_mesh(world(), input, "block").save(folder / "input.octetra");
    EXPECT_EQ(read_checkpoint_facts(folder / "input.octetra").state, std::nullopt);
    const AdaptiveMesh loaded = AdaptiveMesh::load(world(), folder / "input.octetra");
    EXPECT_TRUE(loaded.collect() == input || !world().is_first());
}

TEST(CheckpointOfCellsThatAreCutSideBySide, IsLoaded) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh = distributed_mesh(world(), test::marked_lattice(8, 1), "block");
    for (const double x : {1.0, 1.2, 4.0}) {
        (void)mesh.refine({.spheres = {{{x, 2, 3}, 0.8}}});
        mesh.save(folder / "state.octetra");
        const AdaptiveMesh loaded = AdaptiveMesh::load(world(), folder / "state.octetra");
        EXPECT_TRUE(loaded.collect() == mesh.collect());
    }
}

TEST(CheckpointOfAMeshWithVerticesOfNoCell, KeepsThem) {
    const test::SharedFolder folder;
    Mesh input = test::kuhn(2, 2, 2);
    for (const double x : {7.0, 8.0}) input.points.append({x, 0, 0});
    AdaptiveMesh mesh = distributed_mesh(world(), input, "block");
    (void)mesh.refine({.all = true});
    mesh.save(folder / "state.octetra");
    const AdaptiveMesh loaded = AdaptiveMesh::load(world(), folder / "state.octetra");
    EXPECT_TRUE(loaded.collect() == mesh.collect());
}

/// A file written when version 1 was current; `version-1.ele` is its mesh, and its fields follow
/// from the mesh.
TEST(CheckpointOfVersion1, IsReadUnchanged) {
    const test::SharedFolder folder;
    const std::filesystem::path corpus =
        std::filesystem::path(OCTETRA_SOURCE_DIR) / "corpus/checkpoints";
    std::vector<Field> fields;
    const AdaptiveMesh mesh = AdaptiveMesh::load(world(), corpus / "version-1.octetra",
                                                 {.method = PartitionMethod::rcb}, &fields);
    const Mesh found = mesh.collect();
    EXPECT_TRUE(!world().is_first() || found == read_mesh(corpus / "version-1.ele"));
    EXPECT_EQ(fields, fields_of(mesh));
    mesh.save(folder / "again.octetra", fields);
    world().on_first([&] {
        EXPECT_EQ(test::content_of(folder / "again.octetra"),
                  test::content_of(corpus / "version-1.octetra"));
    });
}

/// Collective. Checks that all processes refuse the file or none does.
bool is_refused(const std::filesystem::path& path) {
    bool refused = false;
    try {
        (void)AdaptiveMesh::load(world(), path).collect();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(path.filename().native()), std::string::npos);
        refused = true;
    }
    EXPECT_EQ(world().max(refused ? 1 : 0), refused ? 1U : 0U);
    return refused;
}

TEST(InventedCheckpoint, IsReadOrRefusedByAllRanks) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh =
        distributed_mesh(world(), test::featured(test::marked_lattice(2, 1), 1), "block");
    for (const std::uint64_t seed : {1U, 2U, 3U}) (void)mesh.refine(some(0.1, seed));
    mesh.save(folder / "good.octetra");
    EXPECT_FALSE(is_refused(folder / "good.octetra"));
    int refused = 0;
    std::mt19937_64 random(7);
    for (int k = 0; k < 100; ++k) {
        world().on_first([&] {
            std::string bad = test::content_of(folder / "good.octetra");
            std::uint64_t table = 0;
            std::memcpy(&table, bad.data() + bad.size() - 32, sizeof table);
            // Half of the time a byte of the cuts, which precede the table.
            const std::size_t first = k % 2 == 0 ? table - 200 : 16;
            bad[first + random() % (table - first)] = static_cast<char>(random());
            test::seal(bad);
            test::write_file(folder / "bad.octetra", bad);
        });
        refused += is_refused(folder / "bad.octetra") ? 1 : 0;
    }
    EXPECT_GT(refused, 20);
}

/// Each rank has only its share of the cuts, but all three figures of a step depend on all cuts.
TEST(CheckpointWithWrongFiguresOfAStep, IsRefusedIdenticallyByAllRanks) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh =
        distributed_mesh(world(), test::marked_lattice(12, 1), "block");  // some blocks
    for (const std::uint64_t seed : {1U, 2U}) (void)mesh.refine(some(0.1, seed));
    mesh.save(folder / "good.octetra");
    EXPECT_FALSE(is_refused(folder / "good.octetra"));
    for (std::size_t number = 0; number < 6; ++number) {
        std::uint64_t table = 0;
        world().on_first([&] {
            std::string bad = test::content_of(folder / "good.octetra");
            std::memcpy(&table, bad.data() + bad.size() - 32, sizeof table);
            ++bad[table + 80 + 8 * number];
            test::seal(bad);
            test::write_file(folder / "bad.octetra", bad);
        });
        const auto path = folder / "bad.octetra";
        const std::string expected = fmt::format("{}: at byte {}: the table has ", path.native(),
                                                 world().of_first(table) + 80 + 24 * (number / 3));
        const std::string what =
            test::thrown_by<InputError>([&] { (void)AdaptiveMesh::load(world(), path); });
        EXPECT_EQ(what.find(expected), 0) << what;
    }
}

/// The message is that of a single rank, for any number of ranks.
TEST(CheckpointWithATaggedSideOfNoCell, IsRefusedIdenticallyByAllRanks) {
    const test::SharedFolder folder;
    Mesh whole = test::marked_lattice(12, 1);
    AdaptiveMesh mesh = distributed_mesh(world(), whole, "block");
    mesh.save(folder / "good.octetra");
    const std::uint64_t vertices = whole.points.size();
    for (const bool is_edge : {true, false}) {
        const std::uint64_t number = is_edge ? whole.edges.size() / 2 : whole.facets.size() / 2;
        const std::uint64_t last = vertices - 1;  // far from the first vertex
        world().on_first([&] {
            std::string bad = test::content_of(folder / "good.octetra");
            const CheckpointReader reader(folder / "good.octetra");
            std::uint64_t position = sizeof(CheckpointHeader);
            const Section section = is_edge ? Section::edges : Section::facets;
            for (std::size_t s = 0; s < static_cast<std::size_t>(section); ++s) {
                const SectionShape shape = shape_of(reader.facts(), static_cast<Section>(s));
                position += shape.count * shape.entity_size;
            }
            const std::array<std::uint32_t, 2> ends{0, static_cast<std::uint32_t>(last)};
            std::memcpy(bad.data() + position + number * (is_edge ? 8 : 12), ends.data(), 8);
            test::seal(bad);
            test::write_file(folder / "bad.octetra", bad);
        });
        const auto path = folder / "bad.octetra";
        const std::string what =
            test::thrown_by<InputError>([&] { (void)AdaptiveMesh::load(world(), path); });
        EXPECT_EQ(what,
                  fmt::format("{}: block {} of the {}: number {} belongs to no cell", path.native(),
                              number / block_length, is_edge ? "edges" : "facets", number));
    }
}

TEST(CheckpointFields, ThatDoNotFitAreRefusedOnAllRanksAndNothingIsWritten) {
    const test::SharedFolder folder;
    const AdaptiveMesh mesh = distributed_mesh(world(), test::kuhn(4, 4, 4), "block");
    std::vector<Field> fields = fields_of(mesh);
    const bool is_last = world().rank() == world().size() - 1;
    if (is_last) std::get<std::vector<double>>(fields[0].values).push_back(0);
    EXPECT_THROW(mesh.save(folder / "state.octetra", fields), InputError);
    fields = fields_of(mesh);
    if (is_last && world().size() > 1) fields[0].name = "v";
    if (world().size() == 1) fields[1].name = fields[0].name;
    EXPECT_THROW(mesh.save(folder / "state.octetra", fields), InputError);
    fields = fields_of(mesh);
    fields[0].name = "\x1b[2J";
    EXPECT_THROW(mesh.save(folder / "state.octetra", fields), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "state.octetra"));
}

}  // namespace
}  // namespace octetra::distributed
