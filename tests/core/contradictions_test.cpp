#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/repeated_cells.hpp>

#include "core/mesh_shares.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Entries of a file that contradict an earlier one: cells with the same vertices, cells on the
/// same side of a tagged facet, duplicates with different markers.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

CellPair find_repeated(const Mesh& mesh) {
    RepeatedCells repeated(mesh.cells.size());
    for (const CellVertices& cell : mesh.cells) repeated.add(cell);
    return repeated.find(mesh.cells, mesh.points.size());
}

/// The same result from a map of all cells.
CellPair find_repeated_slowly(const Mesh& mesh) {
    std::map<CellVertices, CellIndex> first;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        CellVertices sorted = mesh.cells[c];
        std::ranges::sort(sorted);
        const auto [place, is_new] = first.emplace(sorted, c);
        if (!is_new) return {c, place->second};
    }
    return {};
}

void expect_same_pair(const Mesh& mesh) {
    const CellPair found = find_repeated(mesh);
    const CellPair expected = find_repeated_slowly(mesh);
    EXPECT_EQ(found.cell, expected.cell);
    EXPECT_EQ(found.earlier, expected.earlier);
}

/// The message of read_mesh for a mesh that it refuses.
std::string refusal(const Mesh& mesh, const std::string& name, const ReadOptions& options = {}) {
    const TemporaryFolder folder;
    (void)write_mesh(mesh, folder / name);
    test::expect_correct_shares(folder / name);
    const std::string message =
        test::thrown_by<InputError>([&] { (void)read_mesh(folder / name, options); });
    return message.substr(std::min(message.size(), folder.path().native().size() + 1));
}

bool is_read(const Mesh& mesh) {
    const TemporaryFolder folder;
    (void)write_mesh(mesh, folder / "a.ele");
    (void)write_mesh(mesh, folder / "a.mesh");
    return read_mesh(folder / "a.ele") == mesh && read_mesh(folder / "a.mesh").cells == mesh.cells;
}

/// Two cells on either side of a face, which is tagged.
Mesh two_cells_and_their_face() {
    Mesh mesh = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                              {{0, 1, 2, 3}, {0, 1, 2, 4}});
    mesh.facets.append({VertexIndex{2}, VertexIndex{0}, VertexIndex{1}});
    mesh.facet_markers.append(5);
    return mesh;
}

TEST(RepeatedCell, IsFoundAmongManyForAnyOrderOfItsCorners) {
    std::mt19937 random(1);
    for (int round = 0; round < 30; ++round) {
        Mesh mesh = test::kuhn(8, 8, 8);
        std::ranges::shuffle(mesh.cells, random);
        expect_same_pair(mesh);
        for (int copies = 0; copies <= round % 3; ++copies) {
            CellVertices copy = mesh.cells[CellIndex{random() % mesh.cells.size()}];
            std::ranges::shuffle(copy, random);
            mesh.cells.insert(mesh.cells.begin() + static_cast<std::ptrdiff_t>(random() % 3072),
                              copy);
        }
        expect_same_pair(mesh);
    }
}

/// The key kept for a cell is compared some cells later, or at the end.
TEST(RepeatedCell, IsFoundInTheShortestMeshesAndAtTheirEnds) {
    for (std::size_t cells = 0; cells < 20; ++cells) {
        for (std::size_t copied = 0; copied < cells; ++copied) {
            Mesh mesh;
            mesh.points.resize(cells + 3);
            for (std::size_t i = 0; i < cells; ++i) {
                mesh.cells.append(
                    {VertexIndex{i}, VertexIndex{i + 1}, VertexIndex{i + 2}, VertexIndex{i + 3}});
            }
            expect_same_pair(mesh);
            mesh.cells.append(mesh.cells[CellIndex{copied}]);
            expect_same_pair(mesh);
        }
    }
}

TEST(RepeatedCell, IsFoundAtAHubOfAHundredThousand) {
    constexpr std::size_t spokes = 100'000;
    Mesh mesh;
    mesh.points.resize(spokes + 2);
    for (std::size_t i = 2; i < spokes; ++i) {
        mesh.cells.append({VertexIndex{0}, VertexIndex{1}, VertexIndex{i}, VertexIndex{i + 1}});
    }
    EXPECT_TRUE(find_repeated(mesh).cell.is_none());
    auto all_twice = mesh.cells;
    mesh.cells.insert(mesh.cells.end(), all_twice.begin(), all_twice.end());
    EXPECT_EQ(find_repeated(mesh).cell, CellIndex{all_twice.size()});
    EXPECT_EQ(find_repeated(mesh).earlier, CellIndex{0});
}

TEST(RepeatedCell, IsRefusedAlsoIfItsOrientationIsCorrectedFirst) {
    Mesh mesh = two_cells_and_their_face();
    auto [a, b, c, d] = mesh.cells[CellIndex{0}];
    mesh.cells.append({b, a, c, d});
    EXPECT_THAT(refusal(mesh, "a.ele"), HasSubstr("a.ele:4: the cell is inverted"));
    for (const std::string file : {"a.ele", "a.mesh"}) {
        EXPECT_THAT(refusal(mesh, file, {.fix_orientation = true}), HasSubstr("has the vertices"));
    }
}

TEST(RepeatedCell, IsNamedByItsNumberIfTheLineIsUnknown) {
    const TemporaryFolder folder;
    (void)folder.write(
        "a.mesh",
        "MeshVersionFormatted 2 Dimension 3 Vertices 4 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "
        "0\nTetrahedra 2 1 2 3 4 0 2 3 1 4 0\nEnd\n");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "a.mesh"); }),
                HasSubstr("a.mesh:2: cell 2 of this section: cell 2 has the vertices of cell 1: "));
}

TEST(TaggedFacet, MayBeListedAgainWithTheSameMarkerAndNoOther) {
    Mesh mesh = two_cells_and_their_face();
    mesh.facets.append({VertexIndex{1}, VertexIndex{2}, VertexIndex{0}});
    mesh.facet_markers.append(5);
    EXPECT_TRUE(is_read(mesh));
    mesh.facet_markers.back() = 6;
    EXPECT_THAT(refusal(mesh, "a.ele"), testing::StartsWith("a.face:3: face 1 with marker 6"));
    mesh.facet_markers.clear();
    EXPECT_TRUE(is_read(mesh));
}

TEST(TaggedEdge, MayBeListedAgainWithTheSameMarkerAndNoOther) {
    Mesh mesh = two_cells_and_their_face();
    for (const std::size_t other : {1U, 2U, 1U}) {
        mesh.edges.append({VertexIndex{0}, VertexIndex{other}});
        mesh.edge_markers.append(5);
    }
    EXPECT_TRUE(is_read(mesh));
    mesh.edge_markers.back() = 0;
    EXPECT_THAT(refusal(mesh, "a.ele"), testing::StartsWith("a.edge:4: edge 2 with marker 0"));
    mesh.edge_markers.clear();
    EXPECT_TRUE(is_read(mesh));
}

TEST(TaggedFacet, ThatComesFirstIsTheOneThatIsNamed) {
    const FacetVertices stray{VertexIndex{2}, VertexIndex{3}, VertexIndex{4}};
    Mesh mesh = two_cells_and_their_face();
    const FacetVertices twice = mesh.facets.front();
    const auto list = [&](const FacetVertices& facet, Marker marker) {
        mesh.facets.append(facet);
        mesh.facet_markers.append(marker);
    };
    list(twice, 6);
    list(stray, 5);
    EXPECT_THAT(refusal(mesh, "a.ele"), testing::StartsWith("a.face:3: face 1 with marker 6"));
    std::swap(mesh.facets[FacetIndex{1}], mesh.facets[FacetIndex{2}]);
    EXPECT_THAT(refusal(mesh, "a.ele"), HasSubstr("a.face:3: face 1 belongs to no cell"));
}

TEST(TaggedFacet, HasNoTwoCellsOnOneSideHoweverItIsNumbered) {
    std::vector<std::size_t> numbers{0, 1, 2};
    do {
        for (const bool tagged : {true, false}) {
            Mesh mesh = two_cells_and_their_face();
            mesh.points.append({0.25, 0.25, 0.5});
            const auto [a, b, c] = mesh.facets.front();
            const std::array<VertexIndex, 3> corners{a, b, c};
            Mesh third = test::mesh_of({mesh.points.begin(), mesh.points.end()},
                                       {{numbers[0], numbers[1], numbers[2], 5}});
            mesh.cells.insert(mesh.cells.begin(), third.cells.front());
            mesh.facets.front() = {corners[numbers[0]], corners[numbers[1]], corners[numbers[2]]};
            if (!tagged) {
                mesh.facets.clear();
                mesh.facet_markers.clear();
                EXPECT_TRUE(is_read(mesh)) << "octetra verify and refine --check look at all faces";
                continue;
            }
            EXPECT_THAT(refusal(mesh, "a.ele"),
                        testing::StartsWith("a.ele:3: cell 1 overlaps cell 0 (line 2)"));
            EXPECT_THAT(refusal(mesh, "a.mesh"), HasSubstr("cell 2 overlaps cell 1 (line"));
        }
    } while (std::ranges::next_permutation(numbers).found);
}

}  // namespace
}  // namespace octetra
