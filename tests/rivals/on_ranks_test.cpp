#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/selection.hpp>

#include "rivals/gathered_parts.hpp"
#include "support/manifest.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// The mesh equals the serial one, bit by bit, for any number of ranks and any partition.
namespace octetra::rivals {
namespace {

std::vector<int> parts_of_cells(const Mesh& mesh, std::uint64_t seed) {
    const auto ranks = static_cast<std::size_t>(test::world().size());
    const std::size_t cells = mesh.cells.size();
    if (seed % 3 == 0) return random_parts(cells, ranks, seed);
    if (seed % 3 == 1) return random_parts(cells, (ranks + 1) / 2, seed);  // others have nothing
    std::vector<int> blocks(cells);
    for (std::size_t c = 0; c < cells; ++c) blocks[c] = static_cast<int>(c * ranks / cells);
    return blocks;
}

void expect_same(const PartOfMesh& part, const TerminalEdgeMesh& serial) {
    const GatheredParts whole = gathered_parts(part);
    EXPECT_TRUE(whole.copies_agree);
    EXPECT_TRUE(std::ranges::equal(whole.mesh.points, serial.mesh.points, have_same_bits));
    EXPECT_TRUE(whole.mesh.cells == serial.mesh.cells);
    if (!serial.mesh.regions.empty()) {
        EXPECT_TRUE(whole.mesh.regions == serial.mesh.regions);
    }
    EXPECT_TRUE(std::ranges::equal(whole.roots, serial.maps.cell_to_parent, {}, {},
                                   [](CellIndex root) { return std::uint64_t{root.value()}; }));
}

/// The message that it throws, or "".
std::string refusal_of(auto&& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

constexpr std::size_t most_cells = 30'000;  // larger meshes take long and add no coverage

/// Refines towards successive goals on ranks and serially; both must agree, or throw the same
/// message.
void expect_same_by_all(const Mesh& mesh, const std::vector<Goal>& goals, std::uint64_t seed) {
    TerminalEdgeBisection serial(mesh);
    PartOfMesh part = part_of(mesh, parts_of_cells(mesh, seed), test::world().rank());
    std::vector<Goal> own;
    for (const Goal& goal : goals) own.push_back(own_goal(goal, part));
    TerminalEdgesOnRanks on_ranks(test::world(), std::move(part), mesh.points.size());
    for (std::size_t g = 0; g < goals.size(); ++g) {
        const auto by_one = refusal_of([&] { (void)serial.refine(goals[g], most_cells); });
        if (by_one == "there would be too many cells") return;
        const auto by_all = refusal_of([&] { (void)on_ranks.refine(own[g]); });
        ASSERT_EQ(by_one, by_all);
        if (!by_one.empty()) return;
        expect_same(on_ranks.result(), serial.result());
    }
}

Corners first_cell(const Mesh& mesh) {
    const auto& [a, b, c, d] = mesh.cells.front();
    return {mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]};
}

/// Once, to smaller volumes, to shorter edges; for all cells, or for some.
std::vector<std::vector<Goal>> goals_of(const Mesh& mesh, std::uint64_t seed) {
    const Corners corners = first_cell(mesh);
    std::vector<std::uint8_t> some(mesh.cells.size(), 0);
    std::mt19937_64 random(seed);
    for (auto& target : some) target = random() % 7 == 0 ? 1 : 0;
    some.front() = 1;
    std::vector<std::uint8_t> first(mesh.cells.size(), 0);
    first.front() = 1;
    const double size = volume(corners);
    const double length = std::sqrt(squared_length({corners[0], corners[1]}));
    if (size == 0 || length < 1e-100 || length > 1e100) return {{{}}, {{.targets = some}}};
    return {{{}},
            {{.targets = some}},
            {{.targets = first, .volume = size / 40}},
            {{.targets = some, .longest_edge = length / 2}, {.volume = size / 3}},
            {{.longest_edge = length / 3, .volume = size / 2}},
            {{.volume = size / 60}}};
}

class OnRanks : public testing::TestWithParam<std::uint64_t> {};

TEST_P(OnRanks, TheMeshIsTheSerialOne) {
    const std::uint64_t seed = GetParam();
    for (Mesh mesh : {test::kuhn(3, 3, 3), test::perturbed_kuhn(3, 0.3, seed),
                      test::shell(40, seed), test::one_cell(test::regular_corners)}) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            mesh.regions.append(static_cast<Marker>(c.value() % 4));
        }
        for (const auto& goals : goals_of(mesh, seed)) expect_same_by_all(mesh, goals, seed);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OnRanks, testing::Range<std::uint64_t>(0, 6));

class CorpusOnRanks : public testing::TestWithParam<test::CorpusEntry> {};

TEST_P(CorpusOnRanks, IsRefinedAsByOne) {
    Mesh whole = read_mesh(test::corpus_folder() / GetParam().content["file"].get<std::string>());
    Mesh mesh;
    mesh.points = std::move(whole.points);
    mesh.cells = std::move(whole.cells);
    for (const std::uint64_t seed : {3U, 5U}) {
        for (const auto& goals : goals_of(mesh, seed)) expect_same_by_all(mesh, goals, seed);
    }
}

std::vector<test::CorpusEntry> entries_of_files() {
    auto entries = test::different_meshes();
    std::erase_if(entries, [](const auto& entry) { return !entry.content.contains("file"); });
    return entries;
}

INSTANTIATE_TEST_SUITE_P(Of, CorpusOnRanks, testing::ValuesIn(entries_of_files()),
                         test::corpus_name);

/// Three cells at a face, which no rank has together.
TEST(FaceOfThree, IsRefusedByAllRanks) {
    Mesh mesh = test::mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 1, 1}, {2, 1, -1}, {2, 1, 2}},
                              {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}});
    const int ranks = test::world().size();
    const std::vector<int> parts{0, 1 % ranks, 2 % ranks};
    if (ranks == 2) return;  // two are neighbours on one rank, and the third is not known there
    EXPECT_EQ(test::thrown_by<InputError>([&] {
                  TerminalEdgesOnRanks(test::world(), part_of(mesh, parts, test::world().rank()),
                                       mesh.points.size());
              }),
              "three cells have a face in common");
}

TEST(Goals, ThatMakeNoSenseOnOneRankAreRefusedByAll) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    const auto parts =
        random_parts(mesh.cells.size(), static_cast<std::size_t>(test::world().size()), 1);
    TerminalEdgesOnRanks bisection(test::world(), part_of(mesh, parts, test::world().rank()),
                                   mesh.points.size());
    const Goal wrong{.volume = -1};
    EXPECT_EQ(test::thrown_by<InputError>(
                  [&] { (void)bisection.refine(test::world().is_first() ? wrong : Goal{}); }),
              "a goal has no volume");
}

}  // namespace
}  // namespace octetra::rivals
