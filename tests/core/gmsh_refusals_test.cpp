#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "core/gmsh_files.hpp"
#include "core/refused_files.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Gmsh files that are refused, and the messages.
namespace octetra {
namespace {

using test::gmsh_cell_2;
using test::gmsh_cell_4;
using test::gmsh_entities_4;
using test::gmsh_head_2;
using test::gmsh_head_4;
using test::gmsh_nodes_2;
using test::gmsh_nodes_4;
using test::RefusedFiles;
using test::TemporaryFolder;
using testing::HasSubstr;

using Rows = std::vector<test::Refusal<std::string>>;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

const Rows bad_heads{
    {"Empty", "", 1, "the file is empty"},
    {"Garbage", "\x01\x02\n", 1, "is $MeshFormat, not '\\x01\\x02'"},
    {"AfterComments", "$Comments\nnone\n$EndComments\n$Nodes\n", 4,
     "the first section of a Gmsh file, after comments, is $MeshFormat, not '$Nodes'"},
    {"OnlyComments", "$Comments\nnone\n$EndComments\n", 3,
     "the file ends where the section $MeshFormat should be"},
    {"OfMfem", "MFEM mesh v1.0\n\ndimension\n3\n", 1, "this is a mesh of MFEM; of .msh files"},
    {"Version1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", 1, "version 1 is not supported: save"},
    {"Version40", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", 2, "-format msh41"},
    {"Version3", "$MeshFormat\n3 0 8\n", 2, "versions 2.2 and 4.1 are supported, not '3'"},
    {"Type", "$MeshFormat\n4.1 2 8\n", 2, "0 (text) or 1 (binary), not 2"},
    {"SizeOfNumbers", "$MeshFormat\n4.1 1 4\n", 2, "numbers of 8 bytes, not 4"},
    {"EndsAtOnce", "$MeshFormat\n", 1, "the file ends where its version should be"},
    {"NoEndOfFormat", "$MeshFormat\n4.1 0 8\n$Nodes\n", 3, "'$EndMeshFormat' expected"},
    {"ByteOrder", test::BinaryBytes().text("$MeshFormat\n4.1 1 8\n").ints({2}), test::at_byte(20),
     "the number 1 should be here, not 2"},
    {"NoNodes", gmsh_head_4, 3, "there is no section $Nodes"},
    {"NoElements", gmsh_head_4 + gmsh_nodes_4, 15, "there is no section $Elements"},
    {"NoElementsBinary",
     test::gmsh_binary_head("4.1") + "$Nodes\n" +
         test::BinaryBytes().sizes({0, 0, 0, 0}).text("\n$EndNodes\n").bytes(),
     test::at_byte(90), "there is no section $Elements"},
};

INSTANTIATE_TEST_SUITE_P(GmshHead, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_heads),
                         test::name_of_case);

const Rows bad_sections{
    {"Order", gmsh_head_2 + gmsh_cell_2, 4, "$Nodes must come before $Elements"},
    {"Second", gmsh_head_2 + gmsh_nodes_2 + gmsh_nodes_2, 11, "a second section $Nodes"},
    {"EntitiesLate", gmsh_head_4 + gmsh_nodes_4 + gmsh_cell_4 + gmsh_entities_4, 21,
     "$Entities is not allowed here"},
    {"EntitiesOf2", gmsh_head_2 + gmsh_entities_4, 4, "$Entities is not allowed here"},
    {"Parametric", gmsh_head_2 + "$ParametricNodes\n", 4, "without Mesh.SaveParametric"},
    {"StrayEnd", gmsh_head_2 + "$EndNodes\n", 4, "'$EndNodes' ends no section"},
    {"NoSection", gmsh_head_2 + "Nodes\n", 4, "a section, $..., expected, 'Nodes' found"},
    {"NoEndOfSkipped", gmsh_head_2 + "$Periodic\n0\n", 5, "ends within the section 'Periodic'"},
    {"NoEndOfSkippedBinary", test::gmsh_binary_4() + "$Periodic\n$EndPerio", ": at byte ",
     "ends within the section 'Periodic'"},
    {"WrongEnd", replaced(gmsh_head_2 + gmsh_nodes_2, "$EndNodes", "$EndElements"), 10,
     "'$EndNodes' expected, '$EndElements' found"},
    {"NoEnd", gmsh_head_2 + "$Nodes\n0\n", 5, "the file ends where $EndNodes should be"},
};

INSTANTIATE_TEST_SUITE_P(GmshSections, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_sections),
                         test::name_of_case);

const Rows bad_nodes{
    {"HugeCount2", gmsh_head_2 + "$Nodes\n4000000000\n", 5, "holds at most"},
    {"HugeCount4", gmsh_head_4 + "$Nodes\n1 18446744073709551615 1 4\n", 5, "holds at most"},
    {"Ends", gmsh_head_2 + "$Nodes\n2\n1 0 0 0\n2 0 0", 7, "the file ends where z"},
    {"NaN", gmsh_head_2 + "$Nodes\n1\n1 0 nan 0\n", 6, "y is not finite"},
    {"Beyond", gmsh_head_2 + "$Nodes\n1\n1 0 -9e307 0\n", 6, "2^1023"},
    {"Twice2", gmsh_head_2 + "$Nodes\n3\n1 0 0 0\n2 1 0 0\n1 0 1 0\n$EndNodes\n", 8,
     "a second node 1"},
    {"TwiceFarApart", gmsh_head_2 + "$Nodes\n3\n1 0 0 0\n1000000 1 0 0\n1000000 0 1 0\n", 8,
     "a second node 1000000"},
    {"Twice4", replaced(gmsh_head_4 + gmsh_nodes_4, "\n3\n", "\n2\n"), 9, "a second node 2"},
    {"NegativeTag", gmsh_head_2 + "$Nodes\n1\n-1 0 0 0\n", 6, "a whole number from 0"},
    {"Dimension", gmsh_head_4 + "$Nodes\n1 1 1 1\n4 1 0 1\n", 6, "0 to 3, not 4"},
    {"TooMany", gmsh_head_4 + "$Nodes\n1 1 1 1\n3 1 0 2\n", 6,
     "a block of 2 nodes, where 1 of those announced remain"},
    {"TooFew", gmsh_head_4 + "$Nodes\n1 2 1 2\n3 1 0 1\n1\n0 0 0\n$EndNodes\n$Elements\n", 8,
     "1 of the 2 nodes announced are missing"},
};

INSTANTIATE_TEST_SUITE_P(GmshNodes, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_nodes),
                         test::name_of_case);

const Rows bad_elements{
    {"HugeCount2", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n99999\n", 12, "holds at most"},
    {"HugeBlock", gmsh_head_4 + gmsh_nodes_4 + "$Elements\n1 9 1 1\n3 1 4 10\n", 18,
     "a block of 10 elements, where 9 of those announced remain"},
    {"Missing",
     gmsh_head_4 + gmsh_nodes_4 + "$Elements\n1 2 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n", 19,
     "1 of the 2 elements announced are missing"},
    {"Ends", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 2 7 1 1 2 3", 13,
     "the file ends where a node's number should be"},
    {"NoSuchNode2", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 2 7 1 1 2 3 5\n", 13,
     "there is no node 5"},
    {"NoSuchNode4", gmsh_head_4 + gmsh_nodes_4 + "$Elements\n1 1 1 1\n3 1 4 1\n1 0 2 3 4\n", 19,
     "there is no node 0"},
    {"SecondOrder", gmsh_head_4 + gmsh_nodes_4 + "$Elements\n1 1 1 1\n3 1 11 1\n", 18,
     "only tetrahedra of 4 nodes are supported, and these have 10: mesh again with"},
    {"SecondOrder2", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 11 2 7 1 1 2 3 4\n", 13,
     "only tetrahedra of 4 nodes are supported, and these have 10: mesh again with"},
    {"Hexahedra", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 5 2 7 1 1 2 3 4\n", 13,
     "only tetrahedral meshes are supported, and this one has hexahedra"},
    {"Unknown", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 999 2 7 1 1 2 3 4\n", 13,
     "elements of type 999 are not known"},
    {"VertexTwice", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 2 7 1 1 2 3 3\n", 13,
     "the cell has the same vertex twice"},
    {"TriangleVertexTwice", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 2 2 7 1 1 2 1\n", 13,
     "the triangle has the same vertex twice"},
    {"Inverted", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 4 2 7 1 2 1 3 4\n", 13,
     "the cell is inverted"},
    {"CellTwice",
     gmsh_head_4 + gmsh_nodes_4 +
         "$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n3 1 4 1\n2 2 3 1 4\n$EndElements\n",
     21, "cell 2 has the vertices of cell 1 (line 19): remove one of them"},
    {"TrianglesAlone",
     gmsh_head_2 + gmsh_nodes_2 + "$Elements\n2\n1 2 2 7 1 1 2 3\n2 2 2 7 1 1 2 4\n$EndElements\n",
     13, "there are triangles and no tetrahedra: mesh the volumes with gmsh -3"},
    {"TrianglesOfSecondOrderAlone",
     gmsh_head_4 + gmsh_nodes_4 + "$Elements\n1 1 1 1\n2 1 9 1\n1 1 2 3 1 2 3\n$EndElements\n", 20,
     "there are triangles and no tetrahedra: mesh the volumes with gmsh -3"},
    {"LinesAlone", gmsh_head_2 + gmsh_nodes_2 + "$Elements\n1\n1 1 2 7 1 2 2\n$EndElements\n", 14,
     "there are lines and no tetrahedra"},
    {"CommentsWithoutEnd", "$Comments\nof its maker\n" + gmsh_head_2, 5,
     "the file ends within the section 'Comments'"},
    {"TriangleOfNoCell",
     gmsh_head_2 + replaced(gmsh_nodes_2, "$Nodes\n4\n", "$Nodes\n5\n5 9 9 9\n") +
         "$Elements\n2\n1 4 2 7 1 1 2 3 4\n2 2 2 7 1 1 2 5\n$EndElements\n",
     15, "triangle 1 belongs to no cell"},
    {"LineWithTwoMarkers",
     gmsh_head_2 + gmsh_nodes_2 +
         "$Elements\n4\n10 1 2 5 1 1 2\n11 4 2 7 1 1 2 3 4\n12 2 2 3 1 1 2 3\n13 1 2 6 2 2 "
         "1\n$EndElements\n",
     16, "line 2 with marker 6 is listed already, with marker 5, as line 1 (line 13)"},
};

INSTANTIATE_TEST_SUITE_P(GmshElements, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_elements),
                         test::name_of_case);

/// Replaces bytes at a position.
std::string patched(std::string file, std::size_t place, const std::string& bytes) {
    return file.replace(place, bytes.size(), bytes);
}
std::string bytes_of_number(auto number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}
std::size_t behind(const std::string& file, const std::string& line) {
    return file.find(line) + line.size();
}

const std::string binary_4 = test::gmsh_binary_4();
const std::string binary_2 = test::gmsh_binary_2();
const std::size_t entities_4 = behind(binary_4, "$Entities\n");
const std::size_t nodes_4 = behind(binary_4, "$Nodes\n");
const std::size_t elements_4 = behind(binary_4, "$Elements\n");
const std::size_t nodes_2 = behind(binary_2, "$Nodes\n4\n");
const std::size_t elements_2 = behind(binary_2, "$Elements\n1\n");

test::Refusal<std::string> binary_case(const std::string& name, const std::string& file,
                                       std::size_t place, auto number, std::size_t blamed,
                                       const std::string& what) {
    return {name, patched(file, place, bytes_of_number(number)), test::at_byte(blamed), what};
}

constexpr std::uint64_t huge = std::uint64_t{1} << 62U;

const Rows bad_binaries{
    binary_case("HugeEntities", binary_4, entities_4 + 24, huge, entities_4 + 32, "announced"),
    binary_case("HugeTags", binary_4, entities_4 + 84, huge, entities_4 + 92, "announced"),
    binary_case("HugeNodes", binary_4, nodes_4 + 8, huge, nodes_4 + 16, "announced"),
    binary_case("HugeBlock", binary_4, nodes_4 + 44, huge, nodes_4 + 52,
                "where 4 of those announced remain"),
    binary_case("NoBlocks", binary_4, nodes_4, std::uint64_t{0}, nodes_4 + 32,
                "4 of the 4 nodes announced are missing"),
    binary_case("TagTwice", binary_4, nodes_4 + 60, std::uint64_t{1}, nodes_4 + 60,
                "a second node 1"),
    binary_case("NaN", binary_4, nodes_4 + 84 + 8, std::nan(""), nodes_4 + 84 + 8,
                "y is not finite: nan"),
    binary_case("Beyond", binary_4, nodes_4 + 84, 0x1p1023, nodes_4 + 84, "2^1023"),
    binary_case("HugeElements", binary_4, elements_4 + 8, huge, elements_4 + 16, "announced"),
    binary_case("Type", binary_4, elements_4 + 40, std::int32_t{-4}, elements_4 + 40,
                "should be a whole number from 0, not -4"),
    binary_case("SecondOrder", binary_4, elements_4 + 40, std::int32_t{11}, elements_4 + 32,
                "only tetrahedra of 4 nodes are supported, and these have 10"),
    binary_case("NoSuchNode", binary_4, elements_4 + 60, std::uint64_t{5}, elements_4 + 52,
                "there is no node 5"),
    binary_case("VertexTwice", binary_4, elements_4 + 60, std::uint64_t{2}, elements_4 + 52,
                "the cell has the same vertex twice"),
    binary_case("Node2", binary_2, nodes_2 + 28, std::int32_t{-2}, nodes_2 + 28,
                "should be a whole number from 0, not -2"),
    binary_case("Infinite2", binary_2, nodes_2 + 4, std::numeric_limits<double>::infinity(),
                nodes_2 + 4, "x is not finite: inf"),
    binary_case("Block2", binary_2, elements_2 + 4, std::int32_t{2}, elements_2,
                "2 elements, where 1 remain"),
    binary_case("EmptyBlock2", binary_2, elements_2 + 4, std::int32_t{0}, elements_2,
                "0 elements, where 1 remain"),
    binary_case("HugeTags2", binary_2, elements_2 + 8, std::int32_t{2000000000},
                binary_2.size() - 2, "the file ends where a tag should be"),
    binary_case("NoSuchNode2", binary_2, elements_2 + 24, std::int32_t{9}, elements_2 + 12,
                "there is no node 9"),
    {"Count2", replaced(binary_2, "$Nodes\n4\n", "$Nodes\nx\n"), test::at_byte(nodes_2 - 2),
     "the number of nodes should be a whole number from 0, not 'x'"},
};

INSTANTIATE_TEST_SUITE_P(GmshBinary, RefusedFiles,
                         test::refusals("m.msh", test::read_refused_gmsh, bad_binaries),
                         test::name_of_case);

std::vector<std::string> lines_in(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Rows of binary files are checked in blocks.
TEST(GmshReader, NamesTheFirstRowWithAnyFault) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(4, 4, 4);
    (void)write_mesh(mesh, folder / "whole.msh");
    const std::string whole = test::content_of(folder / "whole.msh");
    constexpr std::size_t row_size = 5 * sizeof(std::uint64_t);
    const std::size_t rows = behind(whole, "$Elements\n") + 4 * sizeof(std::uint64_t) +
                             3 * sizeof(std::int32_t) + sizeof(std::uint64_t);
    const auto last_node_of = [&](std::size_t row) { return rows + row * row_size + 4 * 8; };
    for (const std::size_t flat : {0U, 5U, 127U, 128U, 200U, 383U}) {
        for (const std::size_t missing : {0U, 4U, 6U, 126U, 127U, 128U, 129U, 255U, 256U, 383U}) {
            if (flat == missing) continue;
            std::string file = whole;
            file.replace(last_node_of(flat), 8, file.substr(last_node_of(flat) - 8, 8));
            file = patched(file, last_node_of(missing), bytes_of_number(std::uint64_t{9999}));
            const auto path = folder.write("m.msh", file);
            const std::string place =
                fmt::format("m.msh: at byte {}: ", rows + std::min(flat, missing) * row_size);
            EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(path); }),
                        HasSubstr(place + (flat < missing ? "the cell has the same vertex twice"
                                                          : "there is no node 9999")));
        }
    }
}

/// Elements of version 2 with one group are read in blocks.
TEST(GmshReader, NamesTheFirstRowOfVersion2WithAnyFault) {
    const TemporaryFolder folder;
    Mesh mesh = test::kuhn(4, 4, 4);
    mesh.regions.assign(mesh.cells.size(), 3);
    (void)write_mesh(mesh, folder / "whole.msh", {.msh = {.is_2 = true}});
    const std::string whole = test::content_of(folder / "whole.msh");
    constexpr std::size_t row_size = 7 * sizeof(std::int32_t);
    const std::size_t rows = behind(whole, "$Elements\n384\n") + 3 * sizeof(std::int32_t);
    const auto last_node_of = [&](std::size_t row) { return rows + row * row_size + 6 * 4; };
    for (const std::size_t flat : {0U, 5U, 127U, 128U, 200U, 383U}) {
        for (const std::size_t other : {0U, 4U, 130U, 256U, 257U, 258U, 300U, 383U}) {
            for (const std::int32_t wrong : {9999, -1}) {
                if (flat == other) continue;
                std::string file = whole;
                file.replace(last_node_of(flat), 4, file.substr(last_node_of(flat) - 4, 4));
                file = patched(file, last_node_of(other), bytes_of_number(wrong));
                const auto path = folder.write("m.msh", file);
                const std::size_t place = flat < other  ? rows + flat * row_size
                                          : wrong == -1 ? last_node_of(other)
                                                        : rows + other * row_size;
                const char* const what = flat < other    ? "the cell has the same vertex twice"
                                         : wrong == 9999 ? "there is no node 9999"
                                                         : "a node's number should be";
                EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(path); }),
                            HasSubstr(fmt::format("m.msh: at byte {}: {}", place, what)))
                    << flat << " " << other;
            }
        }
    }
}

/// Lines, in contrast, are read one by one.
TEST(GmshReader, NamesTheFirstLineWithAnyFault) {
    const TemporaryFolder folder;
    Mesh mesh = test::kuhn(4, 4, 4);
    mesh.regions.assign(mesh.cells.size(), 3);
    for (const bool is_2 : {false, true}) {
        WriteOptions options;
        options.msh = {.is_2 = is_2, .is_text = true};
        (void)write_mesh(mesh, folder / "whole.msh", options);
        const std::string whole = test::content_of(folder / "whole.msh");
        const std::size_t elements = whole.find("$Elements\n");
        const auto line_of =
            std::count(whole.begin(), whole.begin() + static_cast<long>(elements), '\n');
        const int lines_before = is_2 ? 2 : 3;
        for (const std::size_t flat : {0U, 5U, 127U, 128U, 200U, 383U}) {
            for (const std::size_t other : {0U, 4U, 6U, 126U, 127U, 128U, 129U, 255U, 256U, 383U}) {
                if (flat == other) continue;
                for (const std::string wrong : {"9999", "x"}) {
                    std::vector<std::string> lines = lines_in(whole.substr(elements));
                    const auto row = [&](std::size_t i) -> std::string& {
                        return lines[i + static_cast<std::size_t>(lines_before)];
                    };
                    const auto replace_last = [](std::string& line, const std::string& by) {
                        line.replace(line.rfind(' ') + 1, std::string::npos, by);
                    };
                    const std::string& flat_row = row(flat);
                    const std::size_t last = flat_row.rfind(' ');
                    const std::size_t before = flat_row.rfind(' ', last - 1) + 1;
                    replace_last(row(flat), flat_row.substr(before, last - before));
                    replace_last(row(other), wrong);
                    const auto path = folder.write(
                        "m.msh",
                        fmt::format("{}{}\n", whole.substr(0, elements), fmt::join(lines, "\n")));
                    const std::string place =
                        fmt::format("m.msh:{}: ", line_of + lines_before + 1 +
                                                      static_cast<long>(std::min(flat, other)));
                    EXPECT_THAT(
                        test::thrown_by<InputError>([&] { (void)read_mesh(path); }),
                        HasSubstr(place + (flat < other   ? "the cell has the same vertex twice"
                                           : wrong == "x" ? "a node"
                                                          : "there is no node 9999")))
                        << is_2 << " " << flat << " " << other;
                }
            }
        }
    }
}

/// A truncated file is refused wherever it is cut off.
TEST(GmshReader, RefusesAFileThatIsCutOffAnywhere) {
    const TemporaryFolder folder;
    const std::string text_4 = gmsh_head_4 + gmsh_entities_4 + gmsh_nodes_4 + gmsh_cell_4;
    for (const std::string& whole :
         {gmsh_head_2 + gmsh_nodes_2 + gmsh_cell_2, text_4, binary_2, binary_4}) {
        for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
            const auto file = folder.write("m.msh", whole.substr(0, size));
            const std::string message = test::thrown_by<InputError>([&] { (void)read_mesh(file); });
            EXPECT_THAT(message, HasSubstr("/m.msh:")) << size;
        }
    }
}

}  // namespace
}  // namespace octetra
