#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/predicted_cells.hpp>
#include <octetra/distributed/read_parts.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/thrown.hpp"

/// Partitions of a mesh that is read for refinement: balanced by the predicted cells if the caller
/// accepts the mesh.
namespace octetra {
namespace {

using distributed::CellsToWeigh;
using distributed::read_parts;

const std::filesystem::path& write_once(const std::filesystem::path& file, const Mesh& mesh) {
    if (test::world().is_first()) (void)write_mesh(mesh, file);
    (void)test::world().max(0);
    return file;
}

/// The numbers of the cells that this partition assigns to this process.
std::vector<std::uint64_t> own_cells(const std::vector<int>& parts) {
    std::vector<std::uint64_t> cells;
    for (std::size_t c = 0; c < parts.size(); ++c) {
        if (parts[c] == test::world().rank()) cells.push_back(c);
    }
    return cells;
}

std::vector<Selection> selections(const Mesh& mesh) {
    const Point middle = mesh.points[VertexIndex{mesh.points.size() / 2}];
    Selection tagged;
    tagged.regions.push_back(mesh.regions.front());
    tagged.cells.push_back(GlobalCell{mesh.cells.size() - 1});
    return {{.all = true},
            {.spheres = {{.centre = middle, .radius = 1.1}}},
            {.spheres = {{.centre = middle, .radius = 0.01}}},
            {.boxes = {{{0, 0, 0}, {1.5, 9, 9}}}, .random = RandomShare{0.1, 1}},
            {.max_volume = 0.01},
            tagged};
}

TEST(ReadForWork, PartsAreBalancedByPredictedCells) {
    const test::SharedFolder folder;
    for (const std::size_t n : {2U, 5U}) {
        const Mesh mesh = test::full_mesh(n, 1);
        const auto file = write_once(folder / (std::to_string(n) + ".ele"), mesh);
        for (const Selection& selection : selections(mesh)) {
            const auto expected = distributed::predicted_cells(mesh, selection, Scheme::four, 3);
            for (const std::string name : {"rcb", "lepp", "block"}) {
                const auto partition = distributed::parse_partition(name);
                const auto part = read_parts(
                    test::world(), file, partition,
                    {.read = {}, .on_facts = {}, .weigh = [&](const CellsToWeigh& cells) {
                         return predicted_cells(cells, selection, Scheme::four, 3);
                     }});
                const int ranks = test::world().size();
                EXPECT_EQ(part.cell_ancestors.roots,
                          ranks == 1 ? own_cells(std::vector<int>(mesh.cells.size(), 0))
                                     : own_cells(distributed::partition_cells(mesh, ranks,
                                                                              partition, expected)))
                    << name;
            }
        }
    }
    (void)test::world().max(0);
}

TEST(ReadForWork, SharesMakeUpTheMeshToBeWeighed) {
    const test::SharedFolder folder;
    const Mesh mesh = test::full_mesh(3, 0);
    const auto file = write_once(folder / "m.mesh", mesh);
    int weighed = 0;
    (void)read_parts(test::world(), file, distributed::parse_partition("rcb"),
                     {.read = {}, .on_facts = {}, .weigh = [&](const CellsToWeigh& cells) {
                          ++weighed;
                          EXPECT_EQ(cells.processes.sum(cells.count()), mesh.cells.size());
                          for (std::size_t i = 0; i < cells.count(); ++i) {
                              const CellIndex c{cells.first_number + i};
                              for (std::size_t k = 0; k < 4; ++k) {
                                  EXPECT_EQ(cells.corners(i)[k], mesh.points[mesh.cells[c][k]]);
                              }
                              EXPECT_EQ(cells.regions[i], mesh.regions[c]);
                          }
                          return std::vector<float>{};
                      }});
    EXPECT_EQ(weighed, test::world().size() > 1 ? 1 : 0);
    (void)test::world().max(0);
}

TEST(ReadForWork, WeightsThatAreNoneAreRefusedOnAllProcesses) {
    if (test::world().size() == 1) return;  // a single part needs no weights
    const test::SharedFolder folder;
    const Mesh mesh = test::full_mesh(3, 0);
    const auto file = write_once(folder / "m.ele", mesh);
    const bool is_last = test::world().rank() + 1 == test::world().size();
    const auto refusal = [&](auto&& spoil) {
        const auto weigh = [&](const CellsToWeigh& cells) {
            std::vector<float> weights(cells.count(), 2);
            if (is_last) spoil(weights);
            return weights;
        };
        return test::thrown_by<InputError>([&] {
            (void)read_parts(test::world(), file, distributed::parse_partition("rcb"),
                             {.read = {}, .on_facts = {}, .weigh = weigh});
        });
    };
    const std::string words = "a partition takes one weight for each cell, positive and finite";
    EXPECT_EQ(refusal([](auto& weights) { weights.pop_back(); }), words);
    EXPECT_EQ(refusal([](auto& weights) { weights.clear(); }), words);
    for (const float wrong : {0.0F, -1.0F, std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(refusal([&](auto& weights) { weights.back() = wrong; }), words) << wrong;
    }
}

TEST(ReadForWork, AMeshThatTheCallerDoesNotTakeIsRefusedWhereItIsSound) {
    const test::SharedFolder folder;
    Mesh mesh = test::full_mesh(3, 1);
    const auto sound = write_once(folder / "sound.ele", mesh);
    std::swap(mesh.cells.back()[0], mesh.cells.back()[1]);
    const auto inverted = write_once(folder / "inverted.ele", mesh);
    for (const std::string name : {"rcb", "block", "lepp"}) {
        const auto refusal = [&](const std::filesystem::path& file) {
            const auto refuse = [&](const MeshFacts& facts) {
                EXPECT_EQ(facts.cells, mesh.cells.size());
                EXPECT_EQ(facts.index_base, 1U);
                EXPECT_TRUE(facts.has_regions);
                throw InputError("not this one");
            };
            return test::thrown_by<InputError>([&] {
                (void)read_parts(test::world(), file, distributed::parse_partition(name),
                                 {.read = {}, .on_facts = refuse, .weigh = {}});
            });
        };
        EXPECT_EQ(refusal(sound), "not this one") << name;
        EXPECT_THAT(refusal(inverted), testing::HasSubstr("inverted.ele:")) << name;
    }
    (void)test::world().max(0);
}

}  // namespace
}  // namespace octetra
