#include <algorithm>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/world.hpp"
#include "support/manifest.hpp"

/// Compares the engine with the reference for every mesh of the corpus, scheme and partition, with
/// alternating synchronisation.
namespace octetra::distributed {
namespace {

using test::CorpusEntry;

class CorpusEquality : public testing::TestWithParam<CorpusEntry> {
protected:
    static std::filesystem::path file() {
        const auto& entry = GetParam().content;
        if (entry.contains("file")) {
            return test::corpus_folder() / entry["file"].get<std::string>();
        }
        return std::filesystem::path(OCTETRA_GENERATED_CORPUS) /
               (entry["name"].get<std::string>() + ".ele");
    }
    const Mesh mesh = read_mesh(file());
    /// Enough levels for small meshes, and few for large ones.
    const int levels = mesh.cells.size() < 100 ? 4 : mesh.cells.size() < 1000 ? 3 : 2;
};

/// A refinement, or the message of its error.
struct Outcome {
    Mesh mesh;
    RefinementMaps maps;
    std::string error;

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of(auto&& refine) {
    try {
        auto result = refine();
        return {std::move(result.mesh), std::move(result.maps), {}};
    } catch (const InputError& error) {
        return {.error = error.what()};
    }
}

/// Partitions and synchronisations alternate, with a different start for each mesh.
TEST_P(CorpusEquality, ByEverySchemeAndPartition) {
    const Communicator& world = test::world();
    const std::vector<Selection> selections{{.random = RandomShare{0.15, 4}},
                                            {.cells = {GlobalCell{0}}}};
    const std::vector<std::string> methods{"lepp", "dual", "block", "random:1", "random:2"};
    std::size_t turn = mesh.cells.size();
    for (const Selection& selection : selections) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            const std::string& method = methods[turn % methods.size()];
            const auto synchronisation =
                turn++ % 2 == 0 ? Synchronisation::neighbour : Synchronisation::gateway;
            const Outcome found = outcome_of([&] {
                DistributedMesh part = distribute(
                    world, mesh, partition_cells(mesh, world.size(), parse_partition(method)));
                refine(part, selection, {scheme, levels, synchronisation});
                return collect(std::move(part));
            });
            if (!world.is_first()) continue;
            const Outcome expected =
                outcome_of([&] { return reference::refine(mesh, selection, scheme, levels); });
            ASSERT_EQ(found.error, expected.error) << method;
            ASSERT_TRUE(found == expected) << method;
        }
    }
}

/// One selection of each kind of the command line, about the middle of the mesh where it has a
/// location.
std::vector<Selection> selectors(const Mesh& mesh) {
    Point low = mesh.points.front();
    Point high = low;
    for (const Point& p : mesh.points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Point middle = midpoint(low, high);
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells.front()[k]];
    return {{.all = true},
            {.cells = {GlobalCell{0}, GlobalCell{mesh.cells.size() - 1}}},
            {.spheres = {{middle, (high.x - low.x) / 4}}},
            {.boxes = {{low, middle}}},
            {.regions = {mesh.regions.empty() ? 0 : mesh.regions.front()}},
            {.random = RandomShare{0.1, 3}},
            {.max_volume = volume(corners) * 0.9}};
}

/// Partitions and synchronisations alternate, so that each selection meets all of them.
TEST_P(CorpusEquality, BySelectorsOfEveryKindOverOneToFourLevels) {
    const Communicator& world = test::world();
    if (mesh.cells.empty()) return;
    constexpr std::uint64_t enough_cells = OCTETRA_SANITIZED ? 400 : 4000;
    const std::vector<std::string> methods{"lepp", "random:5", "dual", "block", "random:6"};
    std::size_t turn = 0;
    for (const Selection& selection : selectors(mesh)) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            std::uint64_t cells = mesh.cells.size();
            for (int level = 1; level <= 4 && (level == 1 || cells < enough_cells); ++level) {
                const std::string& method = methods[turn % methods.size()];
                const auto synchronisation =
                    turn % 2 == 0 ? Synchronisation::neighbour : Synchronisation::gateway;
                ++turn;
                const Outcome found = outcome_of([&] {
                    DistributedMesh part = distribute(
                        world, mesh, partition_cells(mesh, world.size(), parse_partition(method)));
                    refine(part, selection, {scheme, level, synchronisation});
                    cells = world.sum(part.cells.size());
                    return collect(std::move(part));
                });
                if (!world.is_first()) continue;
                const Outcome expected =
                    outcome_of([&] { return reference::refine(mesh, selection, scheme, level); });
                ASSERT_EQ(found.error, expected.error) << method << ", level " << level;
                ASSERT_TRUE(found == expected) << method << ", level " << level;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, CorpusEquality, testing::ValuesIn(test::different_meshes()),
                         test::corpus_name);

}  // namespace
}  // namespace octetra::distributed
