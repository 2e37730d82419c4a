#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Tests of meshes that processes construct from their own parts.
namespace octetra::distributed {
namespace {

/// The part of one process when cells are dealt out: its vertices in some order, interleaved with
/// unused vertices of other parts.
MeshPart part_of(const Mesh& mesh, const std::function<int(CellIndex)>& rank_of,
                 bool with_numbers) {
    const int rank = test::world().rank();
    MeshPart part;
    part.index_base = mesh.index_base;
    part.group_names = mesh.group_names;
    part.attributes_per_point = mesh.attributes_per_point;
    const auto numbers = []<std::size_t N>(const std::array<VertexIndex, N>& vertices) {
        std::array<std::uint64_t, N> result{};
        std::ranges::transform(vertices, result.begin(), &VertexIndex::value);
        return result;
    };
    std::vector<char> knows(mesh.points.size(), 0);
    std::vector<CellVertices> own;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (rank_of(c) != rank) continue;
        own.push_back(mesh.cells[c]);
        part.cells.push_back(numbers(mesh.cells[c]));
        if (with_numbers) part.cell_numbers.push_back(c.value());
        if (!mesh.regions.empty()) part.regions.push_back(mesh.regions[c]);
        for (const VertexIndex v : mesh.cells[c]) knows[v.value()] = 1;
    }
    for (std::size_t v = 0; v < knows.size(); v += 3) knows[v] = 1;
    for (std::size_t v = knows.size(); v-- > 0;) {
        if (knows[v] == 0) continue;
        part.vertex_numbers.push_back(v);
        part.points.push_back(mesh.points[VertexIndex{v}]);
        if (!mesh.point_markers.empty()) {
            part.point_markers.push_back(mesh.point_markers[VertexIndex{v}]);
        }
        for (std::size_t k = 0; k < mesh.attributes_per_point; ++k) {
            part.point_attributes.push_back(
                mesh.point_attributes[v * mesh.attributes_per_point + k]);
        }
    }
    const auto is_of_own = [&](const auto& vertices) {
        return std::ranges::any_of(own, [&](const CellVertices& cell) {
            return std::ranges::all_of(
                vertices, [&](VertexIndex v) { return std::ranges::find(cell, v) != cell.end(); });
        });
    };
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        if (!is_of_own(mesh.facets[f])) continue;
        part.facets.push_back(numbers(mesh.facets[f]));
        part.facet_markers.push_back(mesh.facet_markers[f]);
    }
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) {
        if (!is_of_own(mesh.edges[e])) continue;
        part.edges.push_back(numbers(mesh.edges[e]));
        part.edge_markers.push_back(mesh.edge_markers[e]);
    }
    return part;
}

/// Every process has cells.
int rank_of_cell(CellIndex c) {
    return static_cast<int>(c.value() * 5 % 13) % test::world().size();
}

/// Facets and edges are numbered in the order of the ranks that have them, and hence not as in
/// `mesh`.
template <class List, class Markers>
auto sorted(const List& list, const Markers& markers) {
    std::vector<std::pair<typename List::value_type, Marker>> all;
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto vertices = list.at(i);
        std::ranges::sort(vertices);
        all.emplace_back(vertices, markers.at(i));
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

Mesh without_repeated(Mesh mesh) {
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) mesh.facet_markers[f] = 3;
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) mesh.edge_markers[e] = 4;
    return mesh;
}

TEST(MeshPart, WithCellNumbersMakesTheMeshThatAFileWouldHave) {
    const Mesh mesh = without_repeated(test::marked(test::perturbed_kuhn(3, 0.2, 1), 1));
    AdaptiveMesh parts = AdaptiveMesh::from_parts(test::world(), part_of(mesh, rank_of_cell, true));
    Mesh expected = mesh;
    for (const Selection& selection :
         {Selection{.random = RandomShare{0.2, 1}}, Selection{.all = true}}) {
        (void)parts.refine(selection);
        const Mesh whole = parts.collect();
        if (!test::world().is_first()) continue;
        expected = reference::refine(expected, selection, Scheme::eight, 1).mesh;
        EXPECT_TRUE(whole.points == expected.points);
        EXPECT_TRUE(whole.point_markers == expected.point_markers);
        EXPECT_TRUE(whole.point_attributes == expected.point_attributes);
        EXPECT_TRUE(whole.cells == expected.cells);
        EXPECT_TRUE(whole.regions == expected.regions);
        EXPECT_EQ(whole.index_base, expected.index_base);
        EXPECT_EQ(whole.group_names, expected.group_names);
        EXPECT_EQ(sorted(whole.facets, whole.facet_markers),
                  sorted(expected.facets, expected.facet_markers));
        EXPECT_EQ(sorted(whole.edges, whole.edge_markers),
                  sorted(expected.edges, expected.edge_markers));
    }
}

std::function<int(CellIndex)> blocks_of(const Mesh& mesh) {
    const auto per_rank = mesh.cells.size() / static_cast<std::size_t>(test::world().size()) + 1;
    return [per_rank](CellIndex c) { return static_cast<int>(c.value() / per_rank); };
}

TEST(MeshPart, WithoutCellNumbersHasTheCellsInTheOrderOfTheRanks) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    const AdaptiveMesh parts =
        AdaptiveMesh::from_parts(test::world(), part_of(mesh, blocks_of(mesh), false));
    const Mesh whole = parts.collect();
    EXPECT_TRUE(whole == mesh || !test::world().is_first());
}

TEST(MeshPart, KeepsNoVertexThatOnlyOthersUse) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    MeshPart part = part_of(mesh, blocks_of(mesh), true);
    std::set<std::uint64_t> used;
    for (const auto& cell : part.cells) used.insert(cell.begin(), cell.end());
    const auto listed = part.vertex_numbers.size();
    const bool is_any_left_out = test::world().sum(listed - used.size()) > 0;
    EXPECT_TRUE(is_any_left_out || test::world().size() == 1);
    const AdaptiveMesh parts = AdaptiveMesh::from_parts(test::world(), std::move(part));
    EXPECT_EQ(parts.points().size(), used.size());
    for (const GlobalVertex v : parts.vertex_numbers())
        EXPECT_TRUE(used.contains(static_cast<std::uint64_t>(v)));
}

TEST(MeshPart, KeepsVerticesOfNoCellOnOneProcess) {
    Mesh mesh = test::kuhn(1, 1, 1);
    mesh.points.push_back({5, 5, 5});  // number 8, which is not a multiple of 3
    mesh.points.push_back({6, 6, 6});  // number 9, which all processes list
    MeshPart part = part_of(mesh, rank_of_cell, true);
    if (test::world().rank() == test::world().size() - 1) {
        part.vertex_numbers.push_back(8);
        part.points.push_back({5, 5, 5});
    }
    const AdaptiveMesh parts = AdaptiveMesh::from_parts(test::world(), std::move(part));
    EXPECT_EQ(parts.vertex_count(), 10U);
    const auto numbers = parts.vertex_numbers();
    EXPECT_EQ(std::ranges::count(numbers, GlobalVertex{9}), test::world().is_first() ? 1 : 0);
    EXPECT_TRUE(parts.collect() == mesh || !test::world().is_first());
}

/// The message, the same on all processes, after the last one has spoiled its part.
std::string refused(const std::function<void(MeshPart&)>& spoil) {
    const Mesh mesh = without_repeated(test::marked(test::kuhn(3, 3, 3), 1));
    MeshPart part = part_of(mesh, rank_of_cell, true);
    if (test::world().rank() == test::world().size() - 1) spoil(part);
    return test::thrown_by<InputError>(
        [&] { (void)AdaptiveMesh::from_parts(test::world(), std::move(part)); });
}

TEST(MeshPart, ThatIsWrongOnOneProcessIsRefusedOnAllWithTheSameMessage) {
    using testing::HasSubstr;
    const std::string last = fmt::format("rank {}: ", test::world().size() - 1);
    EXPECT_THAT(refused([](MeshPart& p) { p.points.pop_back(); }), HasSubstr(last));
    EXPECT_THAT(refused([](MeshPart& p) { p.regions.push_back(1); }), HasSubstr("region tags"));
    EXPECT_THAT(refused([](MeshPart& p) { p.vertex_numbers[0] = p.vertex_numbers[1]; }),
                HasSubstr("listed twice"));
    EXPECT_THAT(refused([](MeshPart& p) { p.points[3].y = std::nan(""); }), HasSubstr("finite"));
    EXPECT_THAT(refused([](MeshPart& p) { p.points[3].y = 0x1p1023; }), HasSubstr("too large"));
    EXPECT_THAT(refused([](MeshPart& p) { p.cells[1][2] = 1000; }), HasSubstr("not listed"));
    EXPECT_THAT(refused([](MeshPart& p) { std::swap(p.cells[1][2], p.cells[1][3]); }),
                HasSubstr("cell 1 is inverted"));
    EXPECT_THAT(refused([](MeshPart& p) { p.cells[1][2] = p.cells[1][3]; }), HasSubstr("flat"));
    EXPECT_THAT(refused([](MeshPart& p) {
                    p.cells.push_back(p.cells[1]);
                    std::swap(p.cells.back()[0], p.cells.back()[1]);
                    std::swap(p.cells.back()[2], p.cells.back()[3]);
                    p.regions.push_back(0);
                    p.cell_numbers.push_back(p.cell_numbers.back() + 1);
                }),
                HasSubstr("has the vertices of cell 1"));
    EXPECT_THAT(refused([](MeshPart& p) { p.cell_numbers[0] = p.cell_numbers[1]; }),
                HasSubstr("ascend"));
    EXPECT_THAT(refused([](MeshPart& p) { p.cell_numbers.back() = 1000; }), HasSubstr("too large"));
    EXPECT_THAT(refused([](MeshPart& p) { p.index_base = 7; }), HasSubstr("ind"));
    EXPECT_THAT(refused([](MeshPart& p) { p.group_names[0].dimension = 4; }),
                HasSubstr("a group with a name has dimension 4"));
    EXPECT_THAT(refused([](MeshPart& p) { p.group_names[0].name = "a\nb"; }),
                HasSubstr("not printable"));
    EXPECT_THAT(refused([](MeshPart& p) { p.group_names.push_back(p.group_names[0]); }),
                HasSubstr("has two names"));
    EXPECT_THAT(refused([](MeshPart& p) {
                    p.vertex_numbers.push_back(999);
                    p.points.push_back({1, 2, 3});
                    p.point_markers.push_back(0);
                    p.point_attributes.insert(p.point_attributes.end(), p.attributes_per_point, 1);
                }),
                HasSubstr("up to 999"));
    EXPECT_THAT(refused([](MeshPart& p) {
                    p.facets[0] = {p.vertex_numbers[0], p.vertex_numbers[1], p.vertex_numbers[2]};
                }),
                HasSubstr("facet"));
    EXPECT_THAT(refused([](MeshPart& p) {
                    p.edges.push_back(p.edges[0]);
                    p.edge_markers.push_back(77);
                }),
                HasSubstr("edge"));
}

TEST(MeshPart, ThatContradictsAnotherIsRefused) {
    using testing::AllOf;
    using testing::HasSubstr;
    if (test::world().size() == 1) return;
    // Vertex 0 is on all processes.
    const auto place_of_0 = [](const MeshPart& p) {
        return std::ranges::find(p.vertex_numbers, 0U) - p.vertex_numbers.begin();
    };
    EXPECT_THAT(refused([&](MeshPart& p) {
                    p.points[static_cast<std::size_t>(place_of_0(p))].x -= 0x1p-40;
                }),
                HasSubstr("vertex 0: ranks 0 and"));
    EXPECT_THAT(refused([&](MeshPart& p) {
                    const auto place = static_cast<std::size_t>(place_of_0(p));
                    p.point_attributes[(place + 1) * p.attributes_per_point - 1] += 0.5;
                }),
                AllOf(HasSubstr("vertex 0: ranks 0 and"), HasSubstr("different attributes")));
    EXPECT_THAT(refused([&](MeshPart& p) { p.attributes_per_point = 0, p.point_attributes = {}; }),
                HasSubstr("attributes"));
    for (const auto& spoil : std::vector<std::function<void(GroupName&)>>{
             [](GroupName& group) { group.name += 'x'; }, [](GroupName& group) { group.tag += 9; },
             [](GroupName& group) { group.dimension = 1; }}) {
        EXPECT_THAT(refused([&](MeshPart& p) { spoil(p.group_names[0]); }),
                    HasSubstr("different names of groups"));
    }
    EXPECT_THAT(refused([](MeshPart& p) { p.group_names = {}; }), HasSubstr("names of groups"));
    EXPECT_THAT(refused([&](MeshPart& p) { p.regions = {}; }), HasSubstr("region tags"));
    EXPECT_THAT(refused([&](MeshPart& p) { p.cell_numbers = {}; }), HasSubstr("cell numbers"));
    EXPECT_THAT(refused([&](MeshPart& p) {
                    for (Marker& m : p.edge_markers) m = 8;
                }),
                HasSubstr("another marker"));
}

}  // namespace
}  // namespace octetra::distributed
