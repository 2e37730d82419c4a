#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/maps.hpp>

#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using testing::HasSubstr;

RefinementMaps some_maps() {
    RefinementMaps maps;
    maps.cell_to_parent = {CellIndex{0}, CellIndex{0}, CellIndex{1}};
    maps.first_midpoint = VertexIndex{5};
    maps.midpoint_to_edge = {{VertexIndex{0}, VertexIndex{3}}, {VertexIndex{1}, VertexIndex{5}}};
    return maps;
}

TEST(Maps, ReadBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    for (const std::uint32_t index_base : {0U, 1U}) {
        const RefinementMaps maps = some_maps();
        Mesh mesh{.index_base = index_base};
        mesh.cells.resize(maps.cell_to_parent.size());
        mesh.points.resize(maps.first_midpoint.value() + maps.midpoint_to_edge.size());
        WholeMesh source(mesh, &maps);
        write_maps(source, folder / "maps");
        EXPECT_EQ(read_maps(folder / "maps", index_base), maps);
    }
}

TEST(Maps, ThatAreMalformedAreRefusedByLine) {
    const test::TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", ":1: the file is empty"},
        {"parents 1\n", ":1: 'cells' expected"},
        {"cells 99999999\n", ":1: "},
        {"cells 2\n0 0\n", "the file ends after 1 of 2 entries"},
        {"cells 1\n1 0\nmidpoints 0\n", ":2: cell number 0 expected"},
        {"cells 1\n0 -1\nmidpoints 0\n", ":2: "},
        {"cells 1\n0 0 0\nmidpoints 0\n", ":2: "},
        {"cells 1\n0 0\nmidpoints 2\n4 0 1\n6 0 1\n", ":5: the midpoints' numbers"},
        {"cells 1\n0 0\nmidpoints 0\n7\n", ":4: text after the last midpoint"},
    };
    for (const auto& [text, what] : cases) {
        const auto file = folder.write("maps", text);
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_maps(file, 0); }),
                    HasSubstr(what));
    }
    const auto file = folder.write("maps", "cells 1\n0 0\nmidpoints 0\n");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_maps(file, 1); }),
                HasSubstr(":2: a number from 1 expected, 0 found"));
}

}  // namespace
}  // namespace octetra
