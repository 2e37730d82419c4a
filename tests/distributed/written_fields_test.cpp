#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/thrown.hpp"

/// Fields that a program adds to the files of a mesh.
namespace octetra::distributed {
namespace {

AdaptiveMesh refined_mesh() {
    const Mesh input = test::marked_lattice(3, 1);
    const std::vector<int> parts =
        partition_cells(input, test::world().size(), parse_partition("random:1"));
    AdaptiveMesh mesh = AdaptiveMesh::distribute(test::world(), input, parts);
    (void)mesh.refine({.random = RandomShare{0.1, 1}});
    return mesh;
}

/// Vertex values by coordinates, wrong on copies if `spoils` is set; cell values by root.
std::vector<Field> fields_of(const AdaptiveMesh& mesh, bool spoils) {
    std::vector<double> heights;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        const bool is_owned = mesh.vertex_sharing().is_owned(VertexIndex{v});
        heights.push_back(spoils && !is_owned ? -1 : mesh.points()[v].z);
    }
    std::vector<std::int32_t> roots;
    for (const std::uint32_t r : mesh.root_of_cells()) {
        roots.push_back(static_cast<std::int32_t>(mesh.roots()[r]));
    }
    return {{"height", FieldOn::vertices, 1, heights}, {"root", FieldOn::cells, 1, roots}};
}

TEST(WrittenFields, OfAVertexAreItsOwners) {
    const AdaptiveMesh mesh = refined_mesh();
    const test::SharedFolder folder;
    for (const std::string extension : {".vtu", ".vtkhdf", ".pvtu"}) {
        (void)mesh.write(folder / ("sound" + extension), fields_of(mesh, false));
        (void)mesh.write(folder / ("spoilt" + extension), fields_of(mesh, true));
        (void)mesh.write(folder / ("without" + extension));
    }
    const std::string piece = "_" + std::to_string(test::world().rank()) + ".vtu";
    for (const std::string& end : {std::string(".vtu"), std::string(".vtkhdf"), piece}) {
        const std::string sound = test::content_of(folder / ("sound" + end));
        EXPECT_TRUE(sound == test::content_of(folder / ("spoilt" + end))) << end;
        EXPECT_GT(sound.size(), test::content_of(folder / ("without" + end)).size()) << end;
    }
    (void)test::world().sum(std::uint64_t{0});  // before the first process removes the folder
}

/// A field with a wrong size on one process is refused by all.
TEST(WrittenFields, ThatDoNotFitAreRefusedByAll) {
    const AdaptiveMesh mesh = refined_mesh();
    const test::SharedFolder folder;
    const bool is_last = test::world().rank() == test::world().size() - 1;
    for (const std::string extension : {".vtu", ".pvtu", ".ele"}) {
        std::vector<Field> fields = fields_of(mesh, false);
        if (is_last) std::get<0>(fields[0].values).push_back(1);
        const std::string refused = test::thrown_by<InputError>(
            [&] { (void)mesh.write(folder / ("a" + extension), fields); });
        EXPECT_NE(refused.find("field 'height' has "), std::string::npos) << refused;
        fields = fields_of(mesh, false);
        if (is_last && test::world().size() > 1) fields[1].name = "other";
        const auto write = [&] { (void)mesh.write(folder / ("a" + extension), fields); };
        if (test::world().size() > 1) {
            EXPECT_EQ(test::thrown_by<InputError>(write), "processes have different fields");
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
    (void)test::world().sum(std::uint64_t{0});
}

}  // namespace
}  // namespace octetra::distributed
