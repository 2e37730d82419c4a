#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "cli/octetra_program.hpp"
#include "support/full_disk.hpp"
#include "support/thrown.hpp"

/// Fields in Medit's solution files, through the program.
namespace octetra {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::Field;
using test::content_of;
using test::TemporaryFolder;
using testing::HasSubstr;

/// A linear function on vertices, which is exact at midpoints.
std::vector<double> values_by_coordinates(const AdaptiveMesh& mesh) {
    std::vector<double> values;
    for (const Point& p : mesh.points()) {
        for (const double factor : {8.0, -16.0, 0.5}) values.push_back(factor * p.x + 4 * p.z);
    }
    return values;
}

class MeditFields : public testing::Test {
protected:
    /// Writes m.mesh and m.sol, m.meshb and m.solb: a vector on vertices, a scalar on cells.
    MeditFields() {
        run("generate kuhn 4 -o m.mesh");
        const AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "m.mesh");
        std::vector<double> numbers;
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
            numbers.push_back(static_cast<double>(c) / 7);
        }
        const std::vector<Field> fields{
            {"sol_1", FieldOn::vertices, 3, values_by_coordinates(mesh)},
            {"sol_1", FieldOn::cells, 1, numbers}};
        EXPECT_EQ(mesh.write(folder / "m.mesh", fields), "");
        EXPECT_EQ(mesh.write(folder / "m.meshb", fields), "");
    }

    test::Outcome run(const std::string& arguments, int ranks = 0) const {
        const std::string command = arguments + " --quiet";
        auto outcome =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
        return outcome;
    }
    /// The message of a run that exits with status 2.
    [[nodiscard]] std::string refusal(const std::string& arguments, int ranks = 0) const {
        const auto outcome = ranks == 0 ? test::octetra(arguments, folder)
                                        : test::octetra_on(ranks, arguments, folder);
        EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.out;
        return outcome.err;
    }

    const TemporaryFolder folder;
};

constexpr auto ball = " --sphere 0.1,0.2,0.3,0.5 --levels 2 ";

TEST_F(MeditFields, AreMissedWhereAFileHasNone) {
    std::ofstream(folder / "none.sol") << "MeshVersionFormatted 2\nDimension 3\nEnd\n";
    EXPECT_THAT(test::octetra("convert m.mesh o.vtu --fields none.sol", folder).err,
                HasSubstr("none.sol: there are no fields of vertices or cells"));
}

/// The format stores the upper triangle by columns; VTK stores the diagonal first.
TEST_F(MeditFields, OfSymmetricTensorsAreInTheOrderOfVtkAndWrittenBackUnchanged) {
    const AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "m.mesh");
    std::ofstream sol(folder / "t.sol");
    sol << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n"
        << mesh.points().size() << "\n1 3\n";
    std::vector<double> expected;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        sol << "11 12 22 13 23 33\n";
        expected.insert(expected.end(), {11, 22, 33, 12, 23, 13});
    }
    sol << "End\n";
    sol.close();
    EXPECT_EQ(std::get<0>(mesh.read_fields(folder / "t.sol").at(0).values), expected);
    run("convert m.mesh u.mesh --fields t.sol");
    EXPECT_THAT(content_of(folder / "u.sol"), HasSubstr("11 12 22 13 23 33\n"));
}

TEST_F(MeditFields, AreMeansAtMidpointsAndTheParentsOnCells) {
    run("refine m.mesh --fields m.sol" + std::string(ball) + "-o fine.mesh --maps p.txt");
    const AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "fine.mesh");
    const std::vector<Field> fields = mesh.read_fields(folder / "fine.sol");
    ASSERT_EQ(fields.size(), 2U);
    EXPECT_EQ(std::get<0>(fields[0].values), values_by_coordinates(mesh));
    std::ifstream maps(folder / "p.txt");
    std::string word;
    std::size_t count = 0;
    maps >> word >> count;
    EXPECT_GT(count, 1000U);
    std::vector<double> expected(count);
    for (double& value : expected) {
        std::size_t cell = 0;
        maps >> cell >> value;
        value = (value - 1) / 7;  // Medit counts from 1
    }
    EXPECT_EQ(std::get<0>(fields[1].values), expected);
}

TEST_F(MeditFields, AreTheSameBytesOnAnyNumberOfRanksAndFromEitherFile) {
    for (const std::string text : {"", "b"}) {
        const std::string into = std::string(ball) + "-o t.mesh" + text;
        run("refine m.mesh --fields m.sol" + into);
        const std::string sol = content_of(folder / ("t.sol" + text));
        const std::string mesh = content_of(folder / ("t.mesh" + text));
        run("refine m.mesh" + std::string(ball) + "-o without.mesh" + text);
        EXPECT_TRUE(mesh == content_of(folder / ("without.mesh" + text)));
        for (const std::string from : {"m.mesh --fields m.sol", "m.meshb --fields m.solb",
                                       "m.mesh --fields m.sol --partition rcb",
                                       "m.meshb --fields m.solb --partition random:3"}) {
            for (const int ranks : test::rank_counts({3, 2, 7})) {
                run("refine " + from + into, ranks);
                EXPECT_TRUE(content_of(folder / ("t.sol" + text)) == sol) << ranks << from;
                EXPECT_TRUE(content_of(folder / ("t.mesh" + text)) == mesh) << ranks << from;
            }
        }
    }
}

TEST_F(MeditFields, ArePreservedBitByBitByEveryFormatThatStoresThem) {
    run("convert m.mesh c.meshb --fields m.sol");
    EXPECT_TRUE(content_of(folder / "c.solb") == content_of(folder / "m.solb"));
    run("convert c.meshb c.mesh --fields c.solb");
    EXPECT_TRUE(content_of(folder / "c.sol") == content_of(folder / "m.sol"));
    run("convert m.mesh c.octetra --fields m.sol");
    run("convert c.octetra d.mesh");
    EXPECT_TRUE(content_of(folder / "d.sol") == content_of(folder / "m.sol"));
    run("refine c.octetra --all -o fine.octetra");
    run("coarsen fine.octetra --all -o e.mesh");
    EXPECT_TRUE(content_of(folder / "e.sol") == content_of(folder / "m.sol"));
    (void)folder.write("s.txt", "refine --all\nwrite mid.mesh\ncoarsen --all\n");
    run("adapt m.mesh --fields m.sol --script s.txt -o f.mesh", 2);
    EXPECT_TRUE(content_of(folder / "f.sol") == content_of(folder / "m.sol"));
    EXPECT_TRUE(std::filesystem::exists(folder / "mid.sol"));
}

/// After refining few cells, they are no longer in the order of files.
TEST_F(MeditFields, AreReadByTheNumbersOfAMeshThatWasRefined) {
    AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "m.mesh");
    (void)mesh.refine(std::vector<CellIndex>{CellIndex{200}});
    (void)mesh.refine(std::vector<CellIndex>{CellIndex{7}});
    std::vector<double> corners;
    for (const CellVertices& cell : mesh.cells())
        corners.push_back(mesh.points()[cell[1].value()].x);
    const std::vector<Field> fields{{"sol_1", FieldOn::vertices, 3, values_by_coordinates(mesh)},
                                    {"sol_1", FieldOn::cells, 1, corners}};
    (void)mesh.write(folder / "t.mesh", fields);
    EXPECT_EQ(mesh.read_fields(folder / "t.sol"), fields);
}

/// Files written by another program, with linear fields, so that midpoints have the exact values.
TEST_F(MeditFields, OfEveryVersionAndByteOrderAreRefined) {
    const std::filesystem::path samples = OCTETRA_SOURCE_DIR "/corpus/fields";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(samples)) {
        if (entry.path().extension() != ".sol" && entry.path().extension() != ".solb") continue;
        SCOPED_TRACE(entry.path());
        ++files;
        run("refine " + (samples / "two-cells.mesh").native() + " --fields " +
            entry.path().native() + " --all --levels 2 -o t.mesh");
        const AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "t.mesh");
        const std::vector<Field> fields = mesh.read_fields(folder / "t.sol");
        ASSERT_EQ(fields.size(), 4U);
        std::vector<double> heights;
        std::vector<double> tensors;
        for (const auto& [x, y, z] : mesh.points()) {
            heights.push_back(x + 2 * y + 4 * z);
            for (const double value : {1 + x, 2.0, 3.0, 0.5 * y, -0.25 * z, 0.0}) {
                tensors.push_back(value);
            }
        }
        EXPECT_EQ(std::get<0>(fields[0].values), heights);
        EXPECT_EQ(std::get<0>(fields[2].values), tensors);
        const auto& numbers = std::get<0>(fields[3].values);
        EXPECT_EQ(std::ranges::count(numbers, 10.5) + std::ranges::count(numbers, -11.25),
                  std::ssize(numbers));
        EXPECT_EQ(numbers.front(), 10.5);
    }
    EXPECT_EQ(files, 9);
}

TEST_F(MeditFields, AreRefusedWithTheSameMessageOnAnyNumberOfRanks) {
    std::string text = content_of(folder / "m.sol");
    const std::size_t end = text.rfind("\nEnd");
    const std::size_t last = text.rfind('\n', end - 1) + 1;
    (void)folder.write("nan.sol",
                       text.replace(last, end - last, "nan"));  // 5 + 125 + 3 + 384 lines
    run("generate kuhn 2 -o other.mesh");
    for (const int ranks : {0, 1, 3}) {
        EXPECT_THAT(refusal("refine m.mesh --fields nan.sol --all -o t.mesh", ranks),
                    HasSubstr("octetra: nan.sol:517: a value is not finite: 'nan'\n"));
        EXPECT_EQ(
            test::occurrences(refusal("refine other.mesh --fields m.sol --all -o t.mesh", ranks),
                              "octetra: m.sol:4: 125 vertices announced, and the mesh has 27\n"),
            1U);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "t.mesh"));
    EXPECT_FALSE(std::filesystem::exists(folder / "t.sol"));
    EXPECT_EQ(refusal("refine m.mesh --fields nan.sol --all -o t.mesh"),
              refusal("convert m.mesh t.vtu --fields nan.sol"));
}

TEST_F(MeditFields, NeverReplaceAnInput) {
    std::filesystem::copy_file(folder / "m.mesh", folder / "x.mesh");
    EXPECT_THAT(refusal("refine x.mesh --fields m.sol --all -o m.mesh"),
                HasSubstr("-o would write over m.sol of --fields"));
    EXPECT_THAT(refusal("convert x.mesh m.mesh --fields m.sol"),
                HasSubstr("OUT would write over m.sol of --fields"));
    (void)folder.write("s.txt", "write m.mesh\nrefine --all\n");
    EXPECT_THAT(refusal("adapt x.mesh --fields m.sol --script s.txt -o t.mesh"),
                HasSubstr("would write over m.sol of --fields"));
    std::filesystem::create_directory(folder / "t.sol");
    EXPECT_THAT(refusal("refine m.mesh --fields m.sol --all -o t.mesh"),
                HasSubstr("t.sol: is a directory"));
    EXPECT_THAT(refusal("refine m.mesh --fields m.mesh --all -o u.mesh"),
                HasSubstr("--fields: m.mesh: files of values end in .sol or .solb"));
    EXPECT_THAT(refusal("refine m.mesh --fields m.sol --all --engine reference -o u.mesh"),
                HasSubstr("--engine reference does not support fields"));
}

TEST_F(MeditFields, AreWrittenWithTheMeshOrNoneOfBothIs) {
    const AdaptiveMesh mesh = AdaptiveMesh::read(Communicator(), folder / "m.mesh");
    const auto fields = mesh.read_fields(folder / "m.sol");
    for (const std::string binary : {"", "b"}) {
        for (const std::string full : {"mesh", "sol"}) {
            const std::string name = "full." + full + binary;
            const test::FullDisk disk(name + ".");
            EXPECT_THAT(test::thrown_by<SystemError>(
                            [&] { (void)mesh.write(folder / ("full.mesh" + binary), fields); }),
                        HasSubstr(name + ": writing failed: No space left on device"));
            for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
                EXPECT_NE(entry.path().stem().stem().native(), "full") << entry.path();
            }
        }
    }
}

}  // namespace
}  // namespace octetra
