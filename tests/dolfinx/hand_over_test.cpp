#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <dolfinx/common/IndexMap.h>
#include <dolfinx/common/log.h>
#include <dolfinx/graph/AdjacencyList.h>
#include <dolfinx/mesh/utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/dolfinx/convert.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"

/// Meshes for DOLFINx made of randomly distributed lattices: the data of each rank's vertices and
/// cells agree with those of the whole mesh.
namespace octetra::dolfinx {
namespace {

namespace od = distributed;
using Triangle = std::array<std::int64_t, 3>;

od::AdaptiveMesh dealt_out(const Mesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<int> ranks(mesh.cells.size());
    for (int& rank : ranks)
        rank = static_cast<int>(random() % static_cast<unsigned>(test::world().size()));
    return od::AdaptiveMesh::distribute(test::world(), test::world().is_first() ? mesh : Mesh{},
                                        ranks);
}

/// The global numbers in DOLFINx of this rank's nodes, including ghosts.
std::vector<std::int64_t> global_nodes(const Handover& made) {
    return made.mesh->topology().index_map(0)->global_indices();
}

std::array<std::int64_t, 4> vertices_of_cell(const Handover& made, std::int32_t cell) {
    std::array<std::int64_t, 4> numbers{};
    const auto nodes = made.mesh->geometry().dofmap().links(cell);
    for (std::size_t k = 0; k < 4; ++k) {
        numbers[k] =
            made.mesh->geometry().input_global_indices()[static_cast<std::size_t>(nodes[k])];
    }
    return numbers;
}

/// Combines the pairs of all ranks into a map; fails the test if two of them contradict each other.
template <class Value>
std::map<std::int64_t, Value> map_of_all(const std::vector<std::pair<std::int64_t, Value>>& own) {
    struct Pair {
        std::int64_t key;
        Value value;
    };
    std::vector<Pair> sent;
    for (const auto& [key, value] : own) sent.push_back({key, value});
    std::map<std::int64_t, Value> map;
    for (const auto& of_rank : test::of_all(sent)) {
        for (const auto& [key, value] : of_rank) {
            EXPECT_EQ(map.try_emplace(key, value).first->second, value) << key;
        }
    }
    return map;
}

class HandOver : public testing::TestWithParam<std::optional<od::GhostsBy>> {
protected:
    /// By default it logs every step.
    static void SetUpTestSuite() { loguru::g_stderr_verbosity = loguru::Verbosity_WARNING; }

    Mesh whole_ = test::marked_lattice(3, 5);
    od::AdaptiveMesh mesh_ = dealt_out(whole_, 3);
    Handover made_ = to_mesh(mesh_, {.ghosts = GetParam()});
};

INSTANTIATE_TEST_SUITE_P(With, HandOver,
                         testing::Values(std::nullopt, od::GhostsBy::face, od::GhostsBy::vertex));

TEST_P(HandOver, HasTheSameDataOfAVertexOnAllRanks) {
    const auto& geometry = made_.mesh->geometry();
    const auto nodes = global_nodes(made_);
    std::vector<std::pair<std::int64_t, std::int64_t>> vertices;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const std::int64_t number = geometry.input_global_indices()[n];
        vertices.emplace_back(nodes[n], number);
        const Point& p = whole_.points[VertexIndex{static_cast<std::size_t>(number)}];
        EXPECT_THAT(geometry.x().subspan(3 * n, 3), testing::ElementsAre(p.x, p.y, p.z));
    }
    const auto map = map_of_all(vertices);
    EXPECT_EQ(map.size(), whole_.points.size());
    EXPECT_EQ(map.begin()->first, 0);
    EXPECT_EQ(map.rbegin()->first + 1, static_cast<std::int64_t>(map.size()));
}

TEST_P(HandOver, HasTheSameDataOfACellOnAllRanks) {
    const auto& cell_map = *made_.mesh->topology().index_map(3);
    const auto numbers = cell_map.global_indices();
    std::vector<std::pair<std::int64_t, std::array<std::int64_t, 4>>> cells;
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        cells.emplace_back(numbers[c], vertices_of_cell(made_, static_cast<std::int32_t>(c)));
    }
    EXPECT_EQ(map_of_all(cells).size(), whole_.cells.size());
    const std::size_t ghosts = GetParam() ? mesh_.ghosts(*GetParam()).cells.size() : 0;
    EXPECT_EQ(static_cast<std::size_t>(cell_map.num_ghosts()), ghosts);
    EXPECT_EQ(made_.cell_tags->values().size(), numbers.size());
}

TEST_P(HandOver, NamesTheOwnersOfGhosts) {
    for (const int dimension : {0, 3}) {
        const auto& map = *made_.mesh->topology().index_map(dimension);
        const auto ranges = test::of_all(std::vector{map.local_range()});
        ASSERT_EQ(map.owners().size(), map.ghosts().size());
        for (std::size_t k = 0; k < map.ghosts().size(); ++k) {
            const auto [begin, end] = ranges[static_cast<std::size_t>(map.owners()[k])].front();
            EXPECT_TRUE(begin <= map.ghosts()[k] && map.ghosts()[k] < end);
            EXPECT_NE(map.owners()[k], test::world().rank());
        }
        const auto all_sources = test::of_all(map.src());
        for (int rank = 0; rank < test::world().size(); ++rank) {
            const auto& sources = all_sources[static_cast<std::size_t>(rank)];
            EXPECT_EQ(std::ranges::count(sources, test::world().rank()),
                      std::ranges::count(map.dest(), rank));
        }
    }
}

TEST_P(HandOver, TagsFacetsOnAllRanksThatHaveThem) {
    std::map<Triangle, Marker> expected;
    for (FacetIndex f{0}; f < whole_.facets.end_index(); ++f) {
        Triangle key{};
        std::ranges::transform(whole_.facets[f], key.begin(), &VertexIndex::value);
        std::ranges::sort(key);
        expected[key] = whole_.facet_markers[f];
    }
    std::map<std::int32_t, Marker> tags;
    for (std::size_t i = 0; i < made_.facet_tags->indices().size(); ++i) {
        tags[made_.facet_tags->indices()[i]] = made_.facet_tags->values()[i];
    }
    const auto& facets = *made_.mesh->topology().connectivity(2, 0);
    for (std::int32_t f = 0; f < facets.num_nodes(); ++f) {
        Triangle key{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto node = static_cast<std::size_t>(facets.links(f)[k]);
            key[k] = made_.mesh->geometry().input_global_indices()[node];
        }
        std::ranges::sort(key);
        ASSERT_EQ(tags.contains(f), expected.contains(key));
        if (!tags.contains(f)) continue;
        EXPECT_EQ(tags[f], expected[key]);
    }
}

TEST_P(HandOver, HasTheBoundaryOfTheWholeMesh) {
    ::dolfinx::mesh::Topology& topology = made_.mesh->topology_mutable();
    topology.create_connectivity(2, 3);
    EXPECT_EQ(test::world().sum(::dolfinx::mesh::exterior_facet_indices(topology).size()),
              test::world().sum(mesh_.boundary().size()));
}

TEST_P(HandOver, IsRestoredUnchanged) {
    const auto [again, back] = from_mesh(made_.mesh, &*made_.cell_tags, &*made_.facet_tags);
    EXPECT_TRUE(std::ranges::equal(again.cells(), mesh_.cells()));
    EXPECT_TRUE(std::ranges::equal(again.vertex_numbers(), mesh_.vertex_numbers()));
    EXPECT_EQ(again.regions(), mesh_.regions());
    EXPECT_EQ(back.cells, made_.cells);
    EXPECT_EQ(back.vertices, made_.vertices);
    using Entry = std::pair<std::set<std::size_t>, Marker>;
    const auto facets_of = [](const Mesh& mesh) {
        std::set<Entry> facets;
        for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
            std::set<std::size_t> vertices;
            for (const VertexIndex v : mesh.facets[f]) vertices.insert(v.value());
            facets.emplace(vertices, mesh.facet_markers[f]);
        }
        return facets;
    };
    EXPECT_EQ(facets_of(again.collect()), facets_of(mesh_.collect()));
}

TEST_P(HandOver, FollowsTheMeshThroughAStep) {
    const od::Adaptation step = mesh_.refine(std::vector<std::uint8_t>(mesh_.cells().size(), 1));
    const Handover finer = to_mesh(mesh_, {.ghosts = GetParam(), .tags = false});
    EXPECT_FALSE(finer.cell_tags || finer.facet_tags);
    EXPECT_EQ(finer.mesh->topology().index_map(3)->size_global(),
              8 * made_.mesh->topology().index_map(3)->size_global());
    EXPECT_EQ(made_.cells.size(), step.cells.count_before());
    EXPECT_EQ(finer.cells.size(), step.cells.count());
}

}  // namespace
}  // namespace octetra::dolfinx
