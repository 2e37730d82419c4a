#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "support/temporary_folder.hpp"

/// Files of meshes whose entity numbers exceed 32 bits.
namespace octetra {
namespace {

constexpr std::uint64_t far = 5'000'000'000;

/// The last cell of a mesh of billions of cells, with its entities.
class LastCell final : public MeshSource {
public:
    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] std::span<const Point> points(const Window&) override { return {}; }
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window&) override { return cells_; }
    [[nodiscard]] std::span<const VertexNumbers<3>> facets(const Window&) override {
        return facets_;
    }
    [[nodiscard]] std::span<const VertexNumbers<2>> edges(const Window&) override { return edges_; }
    [[nodiscard]] std::span<const std::uint64_t> parents(const Window&) override {
        return parents_;
    }

private:
    MeshFacts facts_{.cells = 1, .facets = 1, .edges = 1, .has_parents = true};
    std::vector<VertexNumbers<4>> cells_{{far, far + 1, far + 2, far + 3}};
    std::vector<VertexNumbers<3>> facets_{{far, far + 1, far + 2}};
    std::vector<VertexNumbers<2>> edges_{{far, far + 1}};
    std::vector<std::uint64_t> parents_{far + 7};
};

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

TEST(FilesBeyond32Bits, OfTetgenHaveAllDigits) {
    const test::TemporaryFolder folder;
    LastCell mesh;
    (void)write_mesh(mesh, folder / "far.ele");
    EXPECT_EQ(text_of(folder / "far.ele"),
              "1 4 0\n0 5000000000 5000000001 5000000002 5000000003\n");
    EXPECT_EQ(text_of(folder / "far.face"), "1 0\n0 5000000000 5000000001 5000000002\n");
    EXPECT_EQ(text_of(folder / "far.edge"), "1 0\n0 5000000000 5000000001\n");
}

TEST(FilesBeyond32Bits, OfMeditHaveAllDigits) {
    const test::TemporaryFolder folder;
    LastCell mesh;
    (void)write_mesh(mesh, folder / "far.mesh");
    const std::string text = text_of(folder / "far.mesh");
    EXPECT_NE(text.find("Tetrahedra\n1\n5000000001 5000000002 5000000003 5000000004 0\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("Triangles\n1\n5000000001 5000000002 5000000003 0\n"), std::string::npos);
    EXPECT_NE(text.find("Edges\n1\n5000000001 5000000002 0\n"), std::string::npos);
}

TEST(FilesBeyond32Bits, OfMapsHaveAllDigits) {
    const test::TemporaryFolder folder;
    LastCell mesh;
    write_maps(mesh, folder / "far.maps");
    EXPECT_EQ(text_of(folder / "far.maps"), "cells 1\n0 5000000007\nmidpoints 0\n");
}

}  // namespace
}  // namespace octetra
