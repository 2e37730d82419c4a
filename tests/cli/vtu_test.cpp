#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"
#include "support/meshes.hpp"

/// Reads .vtu files with VTK's own reader, which ParaView uses.
namespace octetra {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

test::Outcome read_by_vtk(const std::string& arguments, const TemporaryFolder& folder) {
    // Only Debian's interpreter finds Debian's VTK.
    return test::run_program(
        test::words("/usr/bin/python3 " OCTETRA_SOURCE_DIR "/tests/vtu/check_vtu.py " + arguments),
        folder.path());
}

TEST(Vtu, OfARefinedGearIsReadByVtkWithItsParents) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate gear -o gear.1.ele", folder).status, 0);
    const std::string refine = "refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o ";
    ASSERT_EQ(test::octetra(refine + "fine.vtu", folder).status, 0);
    ASSERT_EQ(test::octetra(refine + "fine.ele", folder).status, 0);
    const Mesh fine = read_mesh(folder / "fine.ele");

    const test::Outcome run = read_by_vtk("fine.vtu", folder);
    ASSERT_EQ(run.status, 0) << run.err;
    const json found = json::parse(run.out);
    EXPECT_EQ(found["points"], fine.points.size());
    EXPECT_EQ(found["cells"], fine.cells.size());
    EXPECT_EQ(found["cell_types"], json({{"10", fine.cells.size()}}));
    EXPECT_GT(found["min_signed_volume"], 0);
    EXPECT_EQ(found["coordinates_type"], "double");
    EXPECT_EQ(found["cell_data"][0]["name"], "parent");
    EXPECT_EQ(found["cell_data"][0]["range"],
              json({{0, read_mesh(folder / "gear.1.ele").cells.size() - 1}}));
}

TEST(Vtu, HoldsEveryBitOfTheCoordinatesAndEveryCell) {
    const TemporaryFolder folder;
    // More than one compressed block of every array: 20^3 * 6 cells, 9,261 vertices.
    Mesh mesh = test::kuhn(20, 20, 20, 1.0 / 3);
    for (Point& p : mesh.points) p = {p.x / 7, std::sqrt(p.y), -p.z * 1e-300};
    (void)write_mesh(mesh, folder / "a.mesh");
    ASSERT_EQ(test::octetra("convert a.mesh a.vtu", folder).status, 2) << "mirrored: inverted";
    ASSERT_EQ(test::octetra("convert a.mesh a.vtu --fix-orientation", folder).status, 0);
    mesh = read_mesh(folder / "a.mesh", {.fix_orientation = true});

    std::string points;
    for (const Point& p : mesh.points) points += fmt::format("{:a} {:a} {:a}\n", p.x, p.y, p.z);
    std::string cells;
    for (const auto& c : mesh.cells) {
        cells +=
            fmt::format("{} {} {} {}\n", c[0].value(), c[1].value(), c[2].value(), c[3].value());
    }
    const auto parsed = [](const std::string& text) {
        std::istringstream in(text);
        std::vector<double> numbers;
        for (std::string word; in >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
        return numbers;
    };
    EXPECT_EQ(parsed(read_by_vtk("--points a.vtu", folder).out), parsed(points));
    EXPECT_EQ(read_by_vtk("--cells a.vtu", folder).out, cells);
}

TEST(Vtu, InPiecesIsTheWholeMeshForVtk) {
    const TemporaryFolder folder;
    Mesh mesh = test::perturbed_kuhn(4, 0.2, 1);
    mesh.index_base = 1;
    test::list_boundary(mesh);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.point_markers.append(static_cast<Marker>(v % 5));
    }
    (void)write_mesh(mesh, folder / "a.ele");
    const std::string refine = "refine a.ele --box 0,0,0,2,2,4 --levels 2 -o ";
    ASSERT_EQ(test::octetra(refine + "one.pvtu", folder).status, 0);
    ASSERT_EQ(test::octetra(refine + "serial.pvtu --engine reference", folder).status, 0);
    const auto by_number = [&](const std::string& file) {
        const test::Outcome run = read_by_vtk("--by-number " + file, folder);
        EXPECT_EQ(run.status, 0) << run.err;
        return run.out;
    };
    const std::string expected = by_number("one.pvtu");
    EXPECT_GT(expected.size(), 100'000U);
    EXPECT_EQ(by_number("serial.pvtu"), expected);
    const json one = json::parse(read_by_vtk("one.pvtu", folder).out);

    const test::Outcome run = test::run_program(
        test::words(OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh 3 " OCTETRA_PROGRAM " " + refine +
                    "three.pvtu"),
        folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(by_number("three.pvtu"), expected);
    const json three = json::parse(read_by_vtk("three.pvtu", folder).out);
    EXPECT_EQ(three["cells"], one["cells"]);
    EXPECT_GT(three["points"], one["points"]) << "shared ones occur twice";
    EXPECT_EQ(three["cell_data"][0], one["cell_data"][0]) << "parent";
    EXPECT_EQ(three["cell_data"][1]["name"], "rank");
    EXPECT_EQ(three["cell_data"][1]["range"], json({{0, 2}}));
    EXPECT_EQ(three["point_data"], one["point_data"]) << "marker and vertex";
    EXPECT_EQ(three["global_ids"], "vertex");
}

TEST(Vtu, OfFewerPiecesRemovesThoseOfTheOneThatItReplaces) {
    const TemporaryFolder folder;
    (void)write_mesh(test::kuhn(2, 2, 2), folder / "a.ele");
    for (const std::string name : {"a_1.vtu", "a_2.vtu", "a_4.vtu", "b_1.vtu"}) {
        (void)folder.write(name, "older");
    }
    ASSERT_EQ(test::octetra("refine a.ele --all -o a.pvtu", folder).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "a_1.vtu")) << "no older .pvtu had it";
    ASSERT_EQ(test::octetra("refine a.ele --all -o a.pvtu", folder).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "a_0.vtu"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a_1.vtu"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a_2.vtu"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a_4.vtu")) << "none between";
    EXPECT_TRUE(std::filesystem::exists(folder / "b_1.vtu"));
}

TEST(Vtu, NumbersParentsAsTheInputDoes) {
    const TemporaryFolder folder;
    Mesh mesh = test::kuhn(1, 1, 1);
    mesh.index_base = 1;
    (void)write_mesh(mesh, folder / "a.ele");
    ASSERT_EQ(test::octetra("refine a.ele --all -o a.vtu", folder).status, 0);
    const json found = json::parse(read_by_vtk("a.vtu", folder).out);
    EXPECT_EQ(found["cell_data"][0]["name"], "parent");
    EXPECT_EQ(found["cell_data"][0]["range"], json({{1, 6}}));
}

TEST(Vtu, HoldsRegionsMarkersAndAttributes) {
    const TemporaryFolder folder;
    Mesh mesh = test::one_cell(test::cube_corner);
    mesh.regions = {-4};
    mesh.point_markers = {1, 2, 3, -9};
    mesh.attributes_per_point = 2;
    mesh.point_attributes = {0, 1, 2, 3, 4, 5, 6, 0.125};
    (void)write_mesh(mesh, folder / "a.vtu");
    const json found = json::parse(read_by_vtk("a.vtu", folder).out);
    EXPECT_EQ(found["cell_data"][0]["name"], "region");
    EXPECT_EQ(found["cell_data"][0]["range"], json({{-4, -4}}));
    EXPECT_EQ(found["point_data"][0]["name"], "marker");
    EXPECT_EQ(found["point_data"][0]["range"], json({{-9, 3}}));
    EXPECT_EQ(found["point_data"][1]["name"], "attributes");
    EXPECT_EQ(found["point_data"][1]["range"], json({{0, 6}, {0.125, 5}}));
}

TEST(Vtu, OfAnEmptyMeshIsRead) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.vtu", "a.vtkhdf"}) {
        (void)write_mesh(Mesh{}, folder / name);
        const test::Outcome run = read_by_vtk(name, folder);
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(json::parse(run.out)["cells"], 0);
    }
}

/// Compares everything that VTK reads from two files of one mesh, in any order.
void expect_same_for_vtk(const std::string& a, const std::string& b,
                         const TemporaryFolder& folder) {
    for (const std::string what : {"--points ", "--cells ", "--values "}) {
        const test::Outcome expected = read_by_vtk(what + a, folder);
        const test::Outcome found = read_by_vtk(what + b, folder);
        EXPECT_EQ(expected.status, 0) << expected.err;
        EXPECT_EQ(found.status, 0) << found.err;
        EXPECT_TRUE(found.out == expected.out) << what;
        EXPECT_GT(found.out.size(), 1000U) << what;
    }
    const json expected = json::parse(read_by_vtk(a, folder).out);
    const json found = json::parse(read_by_vtk(b, folder).out);
    for (const std::string key : {"points", "cells", "cell_types", "coordinates_type"}) {
        EXPECT_EQ(found[key], expected[key]);
    }
}

TEST(Vtkhdf, HasTheSameContentsForVtkAsTheVtu) {
    const TemporaryFolder folder;
    Mesh mesh = test::perturbed_kuhn(6, 0.2, 1);
    mesh.index_base = 1;
    mesh.attributes_per_point = 2;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.point_markers.append(static_cast<Marker>(v % 5) - 2);
        mesh.point_attributes.push_back(std::sqrt(static_cast<double>(v)));
        mesh.point_attributes.push_back(-1e-300 / static_cast<double>(v + 1));
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        mesh.regions.append(static_cast<Marker>(c % 3));
    }
    (void)write_mesh(mesh, folder / "a.ele");
    const std::string refine = "refine a.ele --box 0,0,0,3,3,6 --levels 2 -o ";
    for (const std::string name : {"b.vtu", "b.vtkhdf"}) {
        ASSERT_EQ(test::octetra(refine + name, folder).status, 0);
    }
    expect_same_for_vtk("b.vtu", "b.vtkhdf", folder);
    const json found = json::parse(read_by_vtk("b.vtkhdf", folder).out);
    EXPECT_EQ(found["cell_data"].size(), 2U) << "parent and region";
    EXPECT_EQ(found["point_data"].size(), 2U) << "attributes and marker";

    const std::string expected = test::content_of(folder / "b.vtkhdf");
    for (const std::string ranks : {"2", "3", "4"}) {
        const test::Outcome run =
            test::run_program(test::words(OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh " + ranks +
                                          " " OCTETRA_PROGRAM " " + refine + "c.vtkhdf"),
                              folder.path());
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_TRUE(test::content_of(folder / "c.vtkhdf") == expected) << ranks;
    }
}

TEST(Vtkhdf, HoldsMeshesWithoutTagsAndOfManySlices) {
    const TemporaryFolder folder;
    (void)write_mesh(test::kuhn(23, 23, 23, 1.0 / 3), folder / "a.ele");
    ASSERT_EQ(test::octetra("convert a.ele a.vtu", folder).status, 0);
    ASSERT_EQ(test::octetra("convert a.ele a.vtkhdf", folder).status, 0);
    for (const std::string what : {"--points ", "--cells "}) {
        EXPECT_TRUE(read_by_vtk(what + "a.vtkhdf", folder).out ==
                    read_by_vtk(what + "a.vtu", folder).out);
    }
}

}  // namespace
}  // namespace octetra
