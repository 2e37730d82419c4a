#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/series.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/thrown.hpp"

/// Series: successive meshes written to one file by a program.
namespace octetra::distributed {
namespace {

AdaptiveMesh mesh_in_parts() {
    const Mesh input = test::marked_lattice(3, 1);
    return AdaptiveMesh::distribute(
        test::world(), input,
        partition_cells(input, test::world().size(), parse_partition("random:1")));
}

std::vector<Field> heights(const AdaptiveMesh& mesh) {
    std::vector<double> values;
    for (const Point& p : mesh.points()) values.push_back(p.z);
    return {{"height", FieldOn::vertices, 1, values}};
}

/// Counted on all processes before the first one removes the folder.
std::size_t files_in(const test::SharedFolder& folder) {
    (void)test::world().sum(std::uint64_t{0});
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
        if (entry.is_regular_file()) ++count;
    }
    (void)test::world().sum(std::uint64_t{0});
    return count;
}

TEST(Series, OmitsArraysThatNotAllStepsHaveWithANote) {
    const test::SharedFolder folder;
    AdaptiveMesh mesh = mesh_in_parts();
    MeshSeries series(folder / "a.vtkhdf", test::world());
    std::vector<Field> fields = heights(mesh);
    fields.push_back({"once", FieldOn::cells, 1, std::vector<float>(mesh.cells().size(), 1)});
    mesh.append_to(series, -0.5, fields);
    (void)mesh.refine(Selection{.random = RandomShare{0.1, 1}});
    mesh.append_to(series, 1e9, heights(mesh));
    const std::string lost = series.commit();
    EXPECT_NE(lost.find("'once' is left out of "), std::string::npos) << lost;
    EXPECT_EQ(lost.find("height"), std::string::npos) << lost;
    EXPECT_EQ(files_in(folder), 1U);
}

TEST(Series, ThatIsNotFinishedLeavesNothing) {
    const test::SharedFolder folder;
    {
        const AdaptiveMesh mesh = mesh_in_parts();
        MeshSeries series(folder / "a.vtkhdf", test::world());
        mesh.append_to(series, 0);
    }
    EXPECT_EQ(files_in(folder), 0U);
}

TEST(Series, RefusesInvalidTimesAndTimesThatDoNotAscend) {
    const test::SharedFolder folder;
    const AdaptiveMesh mesh = mesh_in_parts();
    EXPECT_NE(test::thrown_by<InputError>([&] {
                  MeshSeries(folder / "a.vtu", test::world());
              }).find("a.vtu: a series of meshes is a .vtkhdf file"),
              std::string::npos);
    MeshSeries series(folder / "a.vtkhdf", test::world());
    EXPECT_NE(test::thrown_by<InputError>([&] { (void)series.commit(); }).find("no step to write"),
              std::string::npos);
    mesh.append_to(series, 1);
    for (const double time : {1.0, 0.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_NE(test::thrown_by<InputError>([&] {
                      mesh.append_to(series, time);
                  }).find("the time of a step must be finite and greater than those before"),
                  std::string::npos);
    }
    mesh.append_to(series, 2);
    EXPECT_NE(series.commit(), "");  // of facets
    (void)test::world().sum(std::uint64_t{0});
}

}  // namespace
}  // namespace octetra::distributed
