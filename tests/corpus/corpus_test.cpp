#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "support/conformity.hpp"
#include "support/manifest.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/run_program.hpp"
#include "support/thrown.hpp"

/// Every entry of corpus/manifest.json: valid files are read and refined, invalid ones are refused
/// as the manifest specifies.
namespace octetra {
namespace {

using nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

using test::CorpusEntry;

const std::filesystem::path corpus = test::corpus_folder();

/// The mesh file of an entry: in the corpus, or generated into `folder`.
std::filesystem::path file_of(const json& entry, const TemporaryFolder& folder) {
    if (entry.contains("file")) return corpus / entry["file"].get<std::string>();
    std::vector<std::string> command{OCTETRA_PROGRAM, "generate"};
    for (const json& word : entry["generate"]) command.push_back(word);
    command.insert(command.end(), {"-o", "generated.ele"});
    const test::Outcome run = test::run_program(command, folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return folder / "generated.ele";
}

class CorpusMesh : public testing::TestWithParam<CorpusEntry> {
protected:
    const TemporaryFolder folder;
    const json& entry = GetParam().content;
    const Mesh mesh = read_mesh(file_of(entry, folder));
};

TEST_P(CorpusMesh, HasTheCountsOfTheManifest) {
    const json& expect = entry["expect"];
    EXPECT_EQ(mesh.points.size(), expect["vertices"]);
    EXPECT_EQ(mesh.cells.size(), expect["cells"]);
    EXPECT_EQ(mesh.facets.size(), expect["facets"]);
    EXPECT_EQ(mesh.edges.size(), expect["listed_edges"]);
    EXPECT_EQ(test::cells_at_edges(mesh).size(), expect["edges"]);
}

TEST_P(CorpusMesh, KeepsEverythingThroughFiles) {
    (void)write_mesh(mesh, folder / "copy.ele");
    Mesh in_tetgen = mesh;
    in_tetgen.group_names.clear();
    in_tetgen.features = {};
    EXPECT_EQ(read_mesh(folder / "copy.ele"), in_tetgen);
    Mesh copy = mesh;
    copy.attributes_per_point = 0;
    copy.point_attributes.clear();
    (void)write_mesh(copy, folder / "copy.mesh");
    (void)write_mesh(read_mesh(folder / "copy.mesh"), folder / "again.mesh");
    EXPECT_EQ(test::content_of(folder / "copy.mesh"), test::content_of(folder / "again.mesh"));
}

/// Checks a refinement of a mesh whose facets are its boundary faces: every face of a cell is in
/// two cells or is a child of a boundary face. A hanging vertex leaves faces that are neither.
void expect_conforming(const Mesh& fine) {
    const auto census = test::count_faces(fine);
    ASSERT_EQ(census.faults, 0U);
    ASSERT_EQ(census.boundary_faces, fine.facets.size());
    for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
        const Corners p = test::corners_of(fine, c);
        ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), 1);
    }
}

class RefinedCorpusMesh : public CorpusMesh {};

TEST_P(RefinedCorpusMesh, IsRefinedByEverySchemeOrRefusedForRounding) {
    Mesh tagged = mesh;
    tagged.facets.clear();
    tagged.facet_markers.clear();
    test::list_boundary(tagged);
    const std::vector<Selection> selections{{.all = true}, {.random = RandomShare{0.1, 1}}};
    const int levels = mesh.cells.size() < 500 ? 2 : 1;
    for (const Selection& selection : selections) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            try {
                const Mesh fine = reference::refine(tagged, selection, scheme, levels).mesh;
                expect_conforming(fine);
                if (selection.all && scheme == Scheme::eight) {
                    const std::size_t pieces = levels == 2 ? 64 : 8;
                    EXPECT_EQ(fine.cells.size(), pieces * mesh.cells.size());
                }
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), HasSubstr("cannot be rounded to double precision"));
            }
        }
    }
}

/// Also generated meshes; tests/verify covers all schemes and levels for the meshes in the corpus
/// folder.
TEST_P(RefinedCorpusMesh, HasAValidRefinementAccordingToTheVerifier) {
    const Selection selection{.random = RandomShare{0.1, 1}};
    Mesh fine;
    try {
        fine = reference::refine(mesh, selection, Scheme::eight, 2).mesh;
    } catch (const InputError&) {
        return;  // rounding, as tested above
    }
    const auto verdict = verify::verify_refinement(
        mesh, fine, {.request = verify::Request{selection, Scheme::eight, 2}});
    for (const auto& violation : verdict.violations) {
        ADD_FAILURE() << name(violation.code) << ": " << violation.found;
    }
    EXPECT_TRUE(verdict.valid());
}

INSTANTIATE_TEST_SUITE_P(, CorpusMesh, testing::ValuesIn(test::corpus_entries("meshes")),
                         test::corpus_name);
INSTANTIATE_TEST_SUITE_P(, RefinedCorpusMesh,
                         testing::ValuesIn(test::without_odd_files(test::different_meshes())),
                         test::corpus_name);

class BadFile : public testing::TestWithParam<CorpusEntry> {
protected:
    const json& entry = GetParam().content;
    /// "FILE:LINE: " or "FILE: ", according to the manifest.
    std::string place() const {
        const std::string file = corpus / entry["blamed"].get<std::string>();
        if (entry["line"].is_null()) return file + ": ";
        return file + ":" + std::to_string(entry["line"].get<int>()) + ": ";
    }
};

TEST_P(BadFile, IsRefusedForItsFaultAndForNoOther) {
    const std::string message = test::thrown_by<InputError>(
        [&] { (void)read_mesh(corpus / entry["file"].get<std::string>()); });
    EXPECT_THAT(message, StartsWith(place()));
    EXPECT_THAT(message, HasSubstr(entry["message"].get<std::string>()));
}

TEST_P(BadFile, EndsTheProgramInStatus2WithOneLineAndNoOutput) {
    const TemporaryFolder folder;
    const test::Outcome run =
        test::run_program({OCTETRA_PROGRAM, "refine", corpus / entry["file"].get<std::string>(),
                           "--all", "-o", "fine.mesh"},
                          folder.path());
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, StartsWith("octetra: " + place()));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(, BadFile, testing::ValuesIn(test::corpus_entries("bad")),
                         test::corpus_name);

}  // namespace
}  // namespace octetra
