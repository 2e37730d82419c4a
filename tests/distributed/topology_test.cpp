#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Compares the topology reported by a mesh with that computed from all processes.
namespace octetra::distributed {
namespace {

template <std::size_t N>
using Numbers = std::array<std::uint64_t, N>;

/// A cell of the whole mesh, by global numbers of its vertices.
struct KnownCell {
    int rank;
    std::uint32_t cell;
    Numbers<4> vertices;
    std::array<Point, 4> points;
    Marker region;
};

std::uint64_t number_of(const AdaptiveMesh& mesh, VertexIndex v) {
    return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
}

std::vector<KnownCell> cells_of_all(const AdaptiveMesh& mesh) {
    std::vector<KnownCell> own;
    const auto regions = mesh.regions();
    for (std::uint32_t c = 0; c < mesh.cells().size(); ++c) {
        KnownCell& cell = own.emplace_back(
            KnownCell{test::world().rank(), c, {}, {}, regions.empty() ? 0 : regions[c]});
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = mesh.cells()[c][k];
            cell.vertices[k] = number_of(mesh, v);
            cell.points[k] = mesh.points()[v.value()];
        }
    }
    std::vector<KnownCell> all;
    for (const auto& from_one : test::of_all(own))
        all.insert(all.end(), from_one.begin(), from_one.end());
    return all;
}

template <std::size_t N>
Numbers<N> side_of(const Numbers<4>& cell, const std::array<std::uint8_t, N>& places) {
    Numbers<N> side{};
    for (std::size_t k = 0; k < N; ++k) side[k] = cell[places[k]];
    std::ranges::sort(side);
    return side;
}

class Topology : public testing::TestWithParam<PartitionMethod> {
protected:
    /// Meshes after one or two steps, some of which leave the mesh unordered.
    static std::vector<AdaptiveMesh> meshes() {
        std::vector<AdaptiveMesh> meshes;
        for (const Selection& selection :
             {Selection{}, Selection{.spheres = {{{0.5, 0.5, 0.5}, 0.45}}},
              Selection{.random = RandomShare{0.3, 5}}}) {
            const Mesh mesh = test::marked(test::perturbed_kuhn(3, 0.2, 1), 1);
            meshes.push_back(AdaptiveMesh::distribute(
                test::world(), mesh,
                partition_cells(mesh, test::world().size(), {.method = GetParam(), .seed = 3})));
            (void)meshes.back().refine(selection);
        }
        return meshes;
    }
};
INSTANTIATE_TEST_SUITE_P(Parts, Topology,
                         testing::Values(PartitionMethod::block, PartitionMethod::random),
                         [](const auto& i) { return fmt::format("{}", i.index); });

/// Compares the numbered faces or edges with those of all cells.
template <class AnySides, std::size_t N, std::size_t PerCell>
void expect_numbered(const AnySides& sides, const AdaptiveMesh& mesh,
                     const std::array<std::array<std::uint8_t, N>, PerCell>& places) {
    std::map<Numbers<N>, std::set<int>> ranks_of;
    for (const KnownCell& cell : cells_of_all(mesh)) {
        for (const auto& side : places) ranks_of[side_of(cell.vertices, side)].insert(cell.rank);
    }
    std::map<Numbers<N>, std::uint64_t> number_of_side;
    for (const auto& [side, ranks] : ranks_of) number_of_side.emplace(side, number_of_side.size());
    EXPECT_EQ(sides.count, ranks_of.size());

    std::size_t own = 0;
    for (const auto& [side, ranks] : ranks_of) own += ranks.count(test::world().rank());
    EXPECT_EQ(sides.vertices.size(), own);
    EXPECT_TRUE(std::ranges::is_sorted(sides.vertices));
    std::vector<std::uint64_t> owned;
    for (std::size_t i = 0; i < sides.vertices.size(); ++i) {
        Numbers<N> side{};
        std::ranges::transform(sides.vertices.at(i), side.begin(),
                               [&](VertexIndex v) { return number_of(mesh, v); });
        EXPECT_EQ(sides.numbers.at(i), number_of_side.at(side));
        std::set<int> others = ranks_of.at(side);
        others.erase(test::world().rank());
        using I = std::remove_cvref_t<decltype(sides.of_cell.at(0)[0])>;
        EXPECT_TRUE(std::ranges::equal(sides.sharing.sharers(I{i}), others));
        if (sides.sharing.is_owned(I{i})) owned.push_back(sides.numbers.at(i));
    }
    EXPECT_EQ(test::world().sum(owned.size()), sides.count);
    std::set<std::uint64_t> owned_once;
    for (const auto& from_one : test::of_all(owned)) {
        owned_once.insert(from_one.begin(), from_one.end());
    }
    EXPECT_EQ(owned_once.size(), sides.count);
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        for (std::size_t k = 0; k < PerCell; ++k) {
            std::array<VertexIndex, N> corners;
            for (std::size_t j = 0; j < N; ++j) corners[j] = mesh.cells()[c][places[k][j]];
            std::ranges::sort(corners);
            EXPECT_EQ(sides.vertices[sides.of_cell.at(c)[k]], corners);
        }
    }
}

TEST_P(Topology, NumbersEdgesAndFacesAsTheWholeMeshDoes) {
    for (const AdaptiveMesh& mesh : meshes()) {
        expect_numbered(mesh.number_edges(), mesh, cell_edges);
        expect_numbered(mesh.number_faces(), mesh, cell_faces);
    }
}

TEST_P(Topology, HasTheNeighbourBehindEachFace) {
    for (const AdaptiveMesh& mesh : meshes()) {
        std::map<Numbers<3>, std::vector<FaceNeighbour>> cells_at;
        for (const KnownCell& cell : cells_of_all(mesh)) {
            for (const auto& face : cell_faces) {
                cells_at[side_of(cell.vertices, face)].push_back({cell.rank, CellIndex{cell.cell}});
            }
        }
        const FaceNeighbours neighbours = mesh.face_neighbours();
        std::vector<BoundaryFace> boundary;
        for (std::uint32_t c = 0; c < mesh.cells().size(); ++c) {
            Numbers<4> cell{};
            std::ranges::transform(mesh.cells()[c], cell.begin(),
                                   [&](VertexIndex v) { return number_of(mesh, v); });
            for (std::uint8_t f = 0; f < 4; ++f) {
                std::vector<FaceNeighbour> others = cells_at.at(side_of(cell, cell_faces[f]));
                std::erase(others, FaceNeighbour{test::world().rank(), CellIndex{c}});
                const FaceNeighbour& neighbour = neighbours.at(c)[f];
                EXPECT_EQ(neighbour.is_boundary(), others.empty());
                if (others.empty()) boundary.push_back({CellIndex{c}, f});
                EXPECT_TRUE(others.empty() || neighbour == others.front());
            }
        }
        EXPECT_EQ(mesh.boundary(), boundary);
    }
}

TEST_P(Topology, HasGhostCellsByFaceAndByVertexAndTheirValues) {
    for (const AdaptiveMesh& mesh : meshes()) {
        const std::vector<KnownCell> all = cells_of_all(mesh);
        for (const GhostsBy by : {GhostsBy::face, GhostsBy::vertex}) {
            const std::ptrdiff_t in_common = by == GhostsBy::face ? 3 : 1;
            const GhostLayer layer = mesh.ghosts(by);
            std::map<std::pair<int, std::uint32_t>, KnownCell> expected;
            for (const KnownCell& other : all) {
                if (other.rank == test::world().rank()) continue;
                const bool is_near = std::ranges::any_of(all, [&](const KnownCell& own) {
                    return own.rank == test::world().rank() &&
                           std::ranges::count_if(own.vertices, [&](std::uint64_t v) {
                               return std::ranges::find(other.vertices, v) != other.vertices.end();
                           }) >= in_common;
                });
                if (is_near) expected.emplace(std::pair(other.rank, other.cell), other);
            }
            ASSERT_EQ(layer.cells.size(), expected.size());
            EXPECT_TRUE(std::ranges::is_sorted(layer.owners));
            for (std::size_t g = 0; g < layer.cells.size(); ++g) {
                const KnownCell& cell =
                    expected.at({layer.owners[g].rank, layer.owners[g].cell.value()});
                EXPECT_EQ(layer.regions[g], cell.region);
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::size_t v = layer.cells[g][k].value();
                    const std::size_t own = mesh.points().size();
                    EXPECT_EQ(v < own ? mesh.points()[v] : layer.points.at(v - own),
                              cell.points[k]);
                    EXPECT_EQ(v < own ? mesh.vertex_numbers()[v] : layer.vertex_numbers.at(v - own),
                              GlobalVertex{cell.vertices[k]});
                }
            }
            std::vector<int> own_values;
            for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
                own_values.push_back(test::world().rank());
                own_values.push_back(static_cast<int>(c));
            }
            const auto values = layer.values(test::world(), own_values, 2);
            for (std::size_t g = 0; g < layer.cells.size(); ++g) {
                EXPECT_EQ(values[2 * g], layer.owners[g].rank);
                EXPECT_EQ(static_cast<std::uint32_t>(values[2 * g + 1]),
                          layer.owners[g].cell.value());
            }
            if (test::world().is_first()) own_values.push_back(0);
            const std::size_t own = mesh.cells().size();
            const auto words = test::thrown_by<InputError>(
                [&] { (void)layer.values(test::world(), std::span<const int>(own_values), 2); });
            if (test::world().is_first()) {
                EXPECT_EQ(words, fmt::format("rank 0: {} values for cells, and {} are needed",
                                             2 * own + 1, 2 * own));
            }
        }
    }
}

/// For each vertex of this process, whether `is_in_set` holds for its global number.
std::vector<std::uint8_t> flags_of(const AdaptiveMesh& mesh,
                                   const std::function<bool(std::uint64_t)>& is_in_set) {
    std::vector<std::uint8_t> flags;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        flags.push_back(is_in_set(number_of(mesh, VertexIndex{v})) ? 1 : 0);
    }
    return flags;
}

/// The number of flags that are missing on a process that flags only the vertices of its own faces.
std::size_t missed_by_own_faces(const AdaptiveMesh& mesh, std::vector<std::uint8_t> flags) {
    for (const auto& [cell, face] : mesh.boundary()) {
        for (const std::uint8_t k : cell_faces[face]) {
            flags[mesh.cells()[cell.value()][k].value()] = 0;
        }
    }
    return static_cast<std::size_t>(std::ranges::count(flags, 1));
}

TEST_P(Topology, KnowsEachBoundaryVertexAlsoWhereAnotherProcessHasTheFace) {
    std::size_t missed = 0;
    for (const AdaptiveMesh& mesh : meshes()) {
        std::map<Numbers<3>, int> cells_at;
        for (const KnownCell& cell : cells_of_all(mesh)) {
            for (const auto& face : cell_faces) ++cells_at[side_of(cell.vertices, face)];
        }
        std::set<std::uint64_t> expected;
        for (const auto& [face, count] : cells_at) {
            if (count == 1) expected.insert(face.begin(), face.end());
        }
        const auto flags = mesh.boundary_vertices();
        EXPECT_EQ(flags, flags_of(mesh, [&](auto v) { return expected.contains(v); }));
        missed += missed_by_own_faces(mesh, flags);
    }
    if (GetParam() != PartitionMethod::random) return;  // connected parts may miss none
    EXPECT_EQ(test::world().sum(missed) > 0, test::world().size() > 1);
}

TEST_P(Topology, KnowsTheVerticesOfAMarkerOnAllProcessesThatHaveThem) {
    for (const AdaptiveMesh& mesh : meshes()) {
        const std::vector<Marker> vertex_markers = mesh.vertex_markers();
        const Mesh whole = mesh.collect();
        for (const Marker marker : {-4, 1, 3, 99}) {
            std::array<std::set<std::uint64_t>, 4> sets;
            const auto collect = [&](const auto& list, const auto& markers, auto& set) {
                for (std::size_t i = 0; i < list.size(); ++i) {
                    if (markers.at(i) != marker) continue;
                    for (const VertexIndex v : list.at(i)) set.insert(v.value());
                }
            };
            for (std::size_t v = 0; v < whole.points.size(); ++v) {
                if (whole.point_markers.at(v) == marker) sets[0].insert(v);
            }
            collect(whole.edges, whole.edge_markers, sets[1]);
            collect(whole.facets, whole.facet_markers, sets[2]);
            collect(whole.cells, whole.regions, sets[3]);
            for (int dimension = 0; dimension < 4; ++dimension) {
                auto& set = sets.at(static_cast<std::size_t>(dimension));
                std::vector<std::uint64_t> numbers(set.begin(), set.end());
                test::world().broadcast(numbers);
                const auto expected = flags_of(
                    mesh, [&](std::uint64_t v) { return std::ranges::binary_search(numbers, v); });
                EXPECT_EQ(mesh.vertices_of(marker, dimension), expected) << marker << dimension;
            }
        }
        std::vector<Marker> all_markers(whole.point_markers.begin(), whole.point_markers.end());
        test::world().broadcast(all_markers);
        ASSERT_EQ(vertex_markers.size(), mesh.points().size());
        for (std::size_t v = 0; v < vertex_markers.size(); ++v) {
            EXPECT_EQ(vertex_markers[v], all_markers.at(number_of(mesh, VertexIndex{v})));
        }
        EXPECT_EQ(mesh.vertices_of("r"), mesh.vertices_of(3, 3));
        EXPECT_EQ(mesh.vertices_of("\"outer\" wall # 1"), mesh.vertices_of(-4, 2));
        if (test::world().size() > 1) {  // arguments that differ between processes
            const bool is_first = test::world().is_first();
            EXPECT_THROW((void)mesh.vertices_of(3, is_first ? 0 : 3), InputError);
            EXPECT_THROW((void)mesh.vertices_of(is_first ? "r" : "wall"), InputError);
        }
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)mesh.vertices_of("wall"); }),
                    testing::HasSubstr("no group is named 'wall'; the groups are a region"));
        EXPECT_EQ(test::thrown_by<InputError>([&] { (void)mesh.vertices_of(1, 4); }),
                  "a dimension is one of 0, 1, 2 and 3, not 4");
    }
}

TEST_P(Topology, SetsAFlagWhereOneOfTheProcessesHasSetIt) {
    for (const AdaptiveMesh& mesh : meshes()) {
        std::vector<std::uint8_t> flags(mesh.points().size(), 0);
        for (std::size_t v = 0; v < flags.size(); ++v) {
            const bool is_shared = !mesh.vertex_sharing().sharers(VertexIndex{v}).empty();
            flags[v] = is_shared && mesh.vertex_sharing().is_owned(VertexIndex{v}) ? 1 : 0;
        }
        combine_everywhere(mesh.processes(), mesh.vertex_sharing(), flags.size(), flags,
                           std::logical_or<>{});
        for (std::size_t v = 0; v < flags.size(); ++v) {
            EXPECT_EQ(flags[v] != 0, !mesh.vertex_sharing().sharers(VertexIndex{v}).empty());
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
