#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "cli/octetra_program.hpp"

/// Fields that programs have saved in checkpoints, transferred by the commands of octetra.
namespace octetra {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::Field;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

struct State {
    AdaptiveMesh mesh;
    std::vector<Field> fields;
};

/// Values by coordinates: a linear function on vertices, an arbitrary one on cells.
template <class T>
std::vector<T> linear(const AdaptiveMesh& mesh) {
    std::vector<T> values;
    for (const Point& p : mesh.points()) {
        values.push_back(static_cast<T>(8 * p.x - 16 * p.y + 4 * p.z));
        values.push_back(static_cast<T>(32 * p.x * 1));
    }
    return values;
}
template <class T>
std::vector<T> drawn(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(static_cast<T>(random() % 100'000) / static_cast<T>(7));
    }
    return values;
}

class CarriedFields : public testing::Test {
protected:
    CarriedFields() { run("generate kuhn 4 -o m.octetra"); }

    test::Outcome run(const std::string& arguments, int ranks = 0) const {
        const std::string command = arguments + " --quiet";
        auto outcome =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
        return outcome;
    }
    [[nodiscard]] State load(const std::string& name) const {
        std::vector<Field> fields;
        AdaptiveMesh mesh = AdaptiveMesh::load(Communicator(), folder / name, {}, &fields);
        return {std::move(mesh), std::move(fields)};
    }
    /// Adds fields of every kind to a checkpoint.
    void add_fields(const std::string& name, const std::string& with_fields) const {
        const AdaptiveMesh mesh = load(name).mesh;
        const std::size_t cells = mesh.cells().size();
        const std::vector<Field> fields{
            {"u", FieldOn::vertices, 2, linear<double>(mesh)},
            {"v", FieldOn::vertices, 2, linear<float>(mesh)},
            {"id", FieldOn::vertices, 2, linear<std::int32_t>(mesh)},
            {"ID", FieldOn::vertices, 2, linear<std::int64_t>(mesh)},
            {"p", FieldOn::cells, 1, drawn<double>(cells, 1)},
            {"q", FieldOn::cells, 3, drawn<float>(3 * cells, 2)},
            {"n", FieldOn::cells, 1, drawn<std::int32_t>(cells, 3)},
            {"N", FieldOn::cells, 1, std::vector<std::int64_t>(cells, std::int64_t{1} << 40)}};
        mesh.save(folder / with_fields, fields);
    }
    /// The parents listed in a file of --maps.
    [[nodiscard]] std::vector<std::size_t> parents_in(const std::string& name) const {
        std::ifstream in(folder / name);
        std::string word;
        std::size_t count = 0;
        std::size_t cell = 0;
        in >> word >> count;
        std::vector<std::size_t> parents(count);
        for (std::size_t& parent : parents) in >> cell >> parent;
        return parents;
    }

    const TemporaryFolder folder;
};

template <class T>
const std::vector<T>& values_of(const State& state, const std::string& name) {
    const auto found = std::ranges::find(state.fields, name, &Field::name);
    EXPECT_NE(found, state.fields.end()) << name;
    return std::get<std::vector<T>>(found->values);
}

std::vector<std::string> names_of(const State& state) {
    std::vector<std::string> names;
    for (const Field& field : state.fields) names.push_back(field.name);
    return names;
}

template <class T>
void expect_inherited(const State& before, const State& after,
                      const std::vector<std::size_t>& parents, const std::string& name,
                      std::size_t components) {
    const auto& old = values_of<T>(before, name);
    std::vector<T> expected;
    for (const std::size_t parent : parents) {
        for (std::size_t k = 0; k < components; ++k)
            expected.push_back(old[parent * components + k]);
    }
    EXPECT_EQ(values_of<T>(after, name), expected) << name;
}

constexpr auto refined = "refine --sphere 0.1,0.2,0.3,0.4 --levels 2";

TEST_F(CarriedFields, AreMeansAtMidpointsAndTheParentsOnCells) {
    add_fields("m.octetra", "s.octetra");
    const State before = load("s.octetra");
    for (const int ranks : {0, 3}) {
        const auto outcome =
            run("refine s.octetra --sphere 0.1,0.2,0.3,0.4 --levels 2 --maps p.txt -o t.octetra",
                ranks);
        EXPECT_EQ(outcome.err,
                  "octetra: note: fields 'id', 'ID' are dropped: whole numbers of an edge's ends "
                  "have no mean for its midpoint\n");
        const State after = load("t.octetra");
        EXPECT_EQ(names_of(after), (std::vector<std::string>{"u", "v", "p", "q", "n", "N"}));
        EXPECT_EQ(values_of<double>(after, "u"), linear<double>(after.mesh));
        EXPECT_EQ(values_of<float>(after, "v"), linear<float>(after.mesh));
        std::vector<std::size_t> parents = parents_in("p.txt");
        EXPECT_GT(parents.size(), 2 * before.mesh.cells().size());
        expect_inherited<double>(before, after, parents, "p", 1);
        expect_inherited<float>(before, after, parents, "q", 3);
        expect_inherited<std::int32_t>(before, after, parents, "n", 1);
        expect_inherited<std::int64_t>(before, after, parents, "N", 1);
    }
}

/// The mean over the children of each parent, weighted by volume and summed in ascending order. The
/// volume of a child is that of its parent divided by a power of two.
std::vector<double> means(const std::vector<double>& values, const AdaptiveMesh& pieces,
                          const std::vector<std::size_t>& parents) {
    std::map<std::size_t, std::vector<std::pair<double, double>>> of_parents;  // value, volume
    for (std::size_t c = 0; c < parents.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k)
            corners[k] = pieces.points()[pieces.cells()[c][k].value()];
        of_parents[parents[c]].emplace_back(values[c], volume(corners));
    }
    std::vector<double> all;
    for (auto& [parent, of_parent] : of_parents) {
        std::ranges::sort(of_parent);
        double whole = 0;
        for (const auto& piece : of_parent) whole += piece.second;
        double mean = 0;
        for (const auto& [value, piece] : of_parent) {
            mean += value * std::exp2(std::round(std::log2(piece / whole)));
        }
        all.push_back(mean);
    }
    return all;
}

TEST_F(CarriedFields, StayOnVerticesAndAreMeansOfCellsThatBecomeOne) {
    run("refine m.octetra --sphere 0.1,0.2,0.3,0.4 -o fine.octetra --maps p.txt");
    add_fields("fine.octetra", "s.octetra");
    State before = load("s.octetra");
    // One child of one cell has another value, so a single process meets it.
    const std::vector<std::size_t> parents = parents_in("p.txt");
    std::vector<std::int64_t> but_one(parents.size(), 5);
    but_one[static_cast<std::size_t>(std::ranges::adjacent_find(parents) - parents.begin())] = 6;
    before.fields.push_back({"but one", FieldOn::cells, 1, but_one});
    before.mesh.save(folder / "s.octetra", before.fields);
    for (const int ranks : {0, 3}) {
        const auto outcome = run("coarsen s.octetra --all -o t.octetra", ranks);
        EXPECT_EQ(outcome.err,
                  "octetra: note: fields 'n', 'but one' are dropped: merged cells had different "
                  "whole numbers\n");
        const State after = load("t.octetra");
        EXPECT_EQ(names_of(after), (std::vector<std::string>{"u", "v", "id", "ID", "p", "q", "N"}));
        ASSERT_EQ(after.mesh.cells().size(), 384U);
        EXPECT_EQ(values_of<double>(after, "u"), linear<double>(after.mesh));
        EXPECT_EQ(values_of<std::int32_t>(after, "id"), linear<std::int32_t>(after.mesh));
        EXPECT_EQ(values_of<double>(after, "p"),
                  means(values_of<double>(before, "p"), before.mesh, parents));
        EXPECT_EQ(values_of<std::int64_t>(after, "N"),
                  std::vector<std::int64_t>(384, std::int64_t{1} << 40));
    }
}

/// Values that were copied to children are restored bit by bit, although thirds of them do not sum
/// exactly.
TEST_F(CarriedFields, AreRestoredWhereRefinementIsTakenBack) {
    add_fields("m.octetra", "s.octetra");
    (void)folder.write("s.txt", std::string(refined) + "\ncoarsen --all --levels 2\n");
    run("adapt s.octetra --script s.txt -o t.octetra");
    const State before = load("s.octetra");
    const State after = load("t.octetra");
    for (const std::string name : {"u", "p"}) {
        EXPECT_EQ(values_of<double>(after, name), values_of<double>(before, name)) << name;
    }
    EXPECT_EQ(values_of<float>(after, "q"), values_of<float>(before, "q"));
    EXPECT_EQ(values_of<std::int32_t>(after, "n"), values_of<std::int32_t>(before, "n"));
}

TEST_F(CarriedFields, AreTheSameBytesOnAnyNumberOfRanksWhateverTheSteps) {
    add_fields("m.octetra", "s.octetra");
    (void)folder.write("s.txt",
                       "refine --sphere 0.1,0.2,0.3,0.4 --levels 2\n"
                       "rebalance\n"
                       "refine --random 0.02 --scheme 2t\n"
                       "coarsen --sphere 0.3,0.2,0.3,0.2\n"
                       "save mid.octetra\n"
                       "refine --sphere 0.4,0.2,0.3,0.2 --scheme 4t\n"
                       "rebalance\n"
                       "coarsen --random 0.8\n"
                       "coarsen --all\n");
    run("adapt s.octetra --script s.txt -o alone.octetra");
    const std::string mid = test::content_of(folder / "mid.octetra");
    EXPECT_EQ(load("mid.octetra").fields.size(), 6U);
    for (const int ranks : test::rank_counts({3, 2, 7})) {
        for (const std::string how : {"", " --partition random:3"}) {
            run("adapt s.octetra --script s.txt -o t.octetra" + how, ranks);
            EXPECT_TRUE(test::content_of(folder / "t.octetra") ==
                        test::content_of(folder / "alone.octetra"))
                << ranks << how;
            EXPECT_TRUE(test::content_of(folder / "mid.octetra") == mid) << ranks << how;
        }
    }
}

TEST_F(CarriedFields, ThatTheFormatCannotHoldAreNamed) {
    add_fields("m.octetra", "s.octetra");
    EXPECT_EQ(
        run("refine s.octetra --sphere 9,9,9,1 -o t.mesh").err,
        "octetra: note: no cell was marked: the mesh is unchanged\n"
        "octetra: note: fields 'u', 'v', 'id', 'ID', 'N' are not in t.sol, which holds reals, "
        "and whole numbers of 32 bits, of 1, 3, 6 or 9 components; fields 'p', 'q', 'n' are "
        "stored in t.sol in order, without a name\n");
    EXPECT_EQ(
        run("convert s.octetra t.msh").err,
        "octetra: note: fields 'u', 'v', 'id', 'ID', 'p', 'q', 'n', 'N' are not in t.msh: "
        ".vtu, .pvtu, .vtkhdf, .xdmf and .octetra files hold fields, and a .sol or .solb beside a "
        "Medit mesh\n");
}

/// VTK reads the files, and a program independent of Octetra the checkpoint with which they are
/// compared.
void expect_fields_in(const TemporaryFolder& folder, const std::string& files) {
    const auto checked =
        test::run_program(test::words("/usr/bin/python3 " OCTETRA_SOURCE_DIR
                                      "/tests/vtu/check_fields.py " OCTETRA_SOURCE_DIR "/tools " +
                                      files),
                          folder.path());
    EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST_F(CarriedFields, AreReadByVtkInItsFormats) {
    add_fields("m.octetra", "s.octetra");
    (void)folder.write("s.txt",
                       "refine --sphere 0.1,0.2,0.3,0.4 --levels 2\n"
                       "refine --random 0.002\n"  // the order in memory is no longer that of files
                       "write mid.vtu\nwrite mid.vtkhdf\nwrite mid.pvtu\nsave mid.octetra\n"
                       "coarsen --all\n");
    run("adapt s.octetra --script s.txt -o end.vtu");
    expect_fields_in(folder, "mid.octetra mid.vtu mid.vtkhdf mid.pvtu");
    const std::string vtu = test::content_of(folder / "mid.vtu");
    const std::string vtkhdf = test::content_of(folder / "mid.vtkhdf");
    for (const int ranks : test::rank_counts({3, 2, 4})) {
        SCOPED_TRACE(ranks);
        run("adapt s.octetra --script s.txt -o end.vtu", ranks);
        expect_fields_in(folder, "mid.octetra mid.vtu mid.vtkhdf mid.pvtu");
        EXPECT_TRUE(test::content_of(folder / "mid.vtu") == vtu);
        EXPECT_TRUE(test::content_of(folder / "mid.vtkhdf") == vtkhdf);
    }
    EXPECT_THAT(run("convert mid.octetra c.vtkhdf").err, Not(HasSubstr("field")));
    run("convert mid.octetra c.pvtu");
    expect_fields_in(folder, "mid.octetra c.vtkhdf c.pvtu");
}

/// Names with special characters of XML or HDF5, and names of the mesh's own arrays.
TEST_F(CarriedFields, OfAnyNameAreReadByVtk) {
    const AdaptiveMesh mesh = load("m.octetra").mesh;
    const std::size_t cells = mesh.cells().size();
    std::vector<Field> fields;
    for (const std::string name : {"a/b", "<\"&'>", "größe", "vertex", "rank", "parent", ".x"}) {
        const auto seed = static_cast<unsigned>(fields.size());
        fields.push_back({name, FieldOn::cells, 2, drawn<double>(2 * cells, seed)});
    }
    fields.push_back({"none", FieldOn::vertices, 0, std::vector<double>{}});
    mesh.save(folder / "s.octetra", fields);
    for (const std::string extension : {".vtu", ".vtkhdf", ".pvtu"}) {
        EXPECT_THAT(mesh.write(folder / ("s" + extension), fields), Not(HasSubstr("field")));
    }
    fields.pop_back();
    mesh.save(folder / "s.octetra", fields);
    expect_fields_in(folder, "s.octetra s.vtu s.vtkhdf s.pvtu");
}

TEST_F(CarriedFields, StateOfAProgramIsKeptByConvertAndMissedWithANoteElsewhere) {
    const SavedState state{.time = 0.25, .step = 7, .text = "{}"};
    load("m.octetra").mesh.save(folder / "s.octetra", {}, state);
    EXPECT_EQ(run("convert s.octetra copy.octetra").err, "");
    EXPECT_TRUE(test::content_of(folder / "copy.octetra") ==
                test::content_of(folder / "s.octetra"));
    const std::string missed =
        "octetra: note: the result does not contain the time, step and text that a program saved "
        "in s.octetra\n";
    for (const std::string command :
         {"convert s.octetra t.vtu", "refine s.octetra --all -o t.octetra",
          "coarsen s.octetra --all --levels 0 -o t.octetra"}) {
        EXPECT_THAT(run(command).err, HasSubstr(missed)) << command;
    }
    EXPECT_FALSE(read_checkpoint_facts(folder / "t.octetra").state.has_value());
}

TEST_F(CarriedFields, ThatDoNotFitAreNotWritten) {
    const AdaptiveMesh mesh = load("m.octetra").mesh;
    const std::vector<Field> short_one{{"u", FieldOn::cells, 1, std::vector<double>(3)}};
    EXPECT_THROW((void)mesh.write(folder / "s.vtu", short_one), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "s.vtu"));
}

}  // namespace
}  // namespace octetra
