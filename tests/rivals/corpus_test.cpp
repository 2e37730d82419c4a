#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/verify/verify.hpp>

#include "rivals/terminal_edges.hpp"
#include "support/manifest.hpp"
#include "support/meshes.hpp"

/// The exact verifier of refinements by midpoints accepts the refinements of the corpus.
namespace octetra::rivals {
namespace {

std::vector<test::CorpusEntry> entries_with_files() {
    auto entries = test::different_meshes();
    std::erase_if(entries, [](const auto& entry) { return !entry.content.contains("file"); });
    return entries;
}

/// Only points, cells and regions: other data are not transferred.
Mesh bare(const Mesh& mesh) {
    Mesh result;
    result.points = mesh.points;
    result.cells = mesh.cells;
    result.regions = mesh.regions;
    result.index_base = mesh.index_base;
    return result;
}

void expect_valid(const Mesh& coarse, const TerminalEdgeMesh& fine) {
    const auto verdict = verify::verify_refinement(coarse, fine.mesh, {.maps = &fine.maps});
    for (const auto& violation : verdict.violations) {
        ADD_FAILURE() << verify::name(violation.code) << ": " << violation.found;
    }
    EXPECT_TRUE(verdict.valid());
}

class Corpus : public testing::TestWithParam<test::CorpusEntry> {};

TEST_P(Corpus, IsRefinedValidly) {
    const Mesh mesh =
        bare(read_mesh(test::corpus_folder() / GetParam().content["file"].get<std::string>()));
    Goal some;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) some.targets.push_back(c % 3 == 0);
    Goal smaller = some;
    smaller.volume =
        volume({mesh.points[mesh.cells.front()[0]], mesh.points[mesh.cells.front()[1]],
                mesh.points[mesh.cells.front()[2]], mesh.points[mesh.cells.front()[3]]}) /
        4;
    if (*smaller.volume == 0) smaller = some;  // underflows in binary64
    for (const Goal& goal : {Goal{}, some, smaller}) {
        try {
            TerminalEdgeBisection bisection(mesh);
            (void)bisection.refine(goal, 100'000);
            expect_valid(mesh, bisection.result());
        } catch (const InputError& error) {
            const auto& tags = GetParam().content["tags"];
            const auto has = [&](const char* tag) {
                return std::ranges::find(tags, tag) != tags.end();
            };
            EXPECT_TRUE(has("inexact")) << error.what();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(entries_with_files()), test::corpus_name);

TEST(ShakenLattice, IsRefinedValidlyAroundACorner) {
    const Mesh mesh = test::perturbed_kuhn(4, 0.2, 1);
    Goal goal;
    goal.targets.assign(mesh.cells.size(), 0);
    std::fill_n(goal.targets.begin(), 6, std::uint8_t{1});
    for (const double volume : {0.02, 0.001}) {
        goal.volume = volume;
        TerminalEdgeBisection bisection(mesh);
        (void)bisection.refine(goal);
        expect_valid(mesh, bisection.result());
    }
}

}  // namespace
}  // namespace octetra::rivals
