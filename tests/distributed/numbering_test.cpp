#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/index_map.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"

/// Compares the orientation of faces and facets, and numberings, with those of the whole mesh.
namespace octetra::distributed {
namespace {

/// Meshes after full sweeps, incremental levels, migration and coarsening.
std::vector<AdaptiveMesh> numbered_meshes() {
    std::vector<AdaptiveMesh> meshes;
    for (const PartitionMethod method : {PartitionMethod::block, PartitionMethod::random}) {
        AdaptiveMesh& mesh = meshes.emplace_back(
            distributed_mesh(test::marked_lattice(3, 1), {.method = method, .seed = 3}));
        (void)mesh.refine(Selection{.random = RandomShare{0.3, 5}});
        (void)mesh.rebalance({.most_over_mean = 1});
        (void)mesh.refine(steps[0]);
        (void)mesh.coarsen(Selection{.random = RandomShare{0.8, 2}});
    }
    return meshes;
}

std::uint64_t global_number(const AdaptiveMesh& mesh, VertexIndex v) {
    return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
}

template <std::size_t N>
std::array<std::uint64_t, N> global_numbers(const AdaptiveMesh& mesh,
                                            const std::array<VertexIndex, N>& vertices) {
    std::array<std::uint64_t, N> numbers{};
    std::ranges::transform(vertices, numbers.begin(),
                           [&](VertexIndex v) { return global_number(mesh, v); });
    return numbers;
}

template <std::size_t N>
std::array<VertexIndex, N> in_order(std::array<VertexIndex, N> vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

std::array<Point, 3> points_of(const AdaptiveMesh& mesh, const FacetVertices& face) {
    const auto points = mesh.points();
    return {points[face[0].value()], points[face[1].value()], points[face[2].value()]};
}

/// Returns whether the normal of this face points away from its cell.
bool points_away_from(const AdaptiveMesh& mesh, const FacetVertices& face, VertexIndex opposite) {
    const auto& [a, b, c] = points_of(mesh, face);
    return orientation(a, b, c, mesh.points()[opposite.value()]) < 0;
}

/// The boundary faces of this process, by their ascending vertices.
std::map<FacetVertices, BoundaryFace> boundary_of(const AdaptiveMesh& mesh) {
    std::map<FacetVertices, BoundaryFace> faces;
    for (const BoundaryFace& face : mesh.boundary()) {
        faces.emplace(in_order(outward_face(mesh.cells()[face.cell.value()], face.face)), face);
    }
    return faces;
}

TEST(Orientation, OfBoundaryFacesIsOutward) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        double flux = 0;  // of the vector field x through the boundary: three times the volume
        for (const auto& [number, face] : mesh.boundary()) {
            const CellVertices& cell = mesh.cells()[number.value()];
            const FacetVertices corners = outward_face(cell, face);
            EXPECT_TRUE(points_away_from(mesh, corners, cell[face]));
            const auto& [a, b, c] = points_of(mesh, corners);
            flux += (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                     a.z * (b.x * c.y - b.y * c.x)) /
                    2;
        }
        double volumes = 0;
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
            volumes += volume(corners_of(mesh, c));
        }
        double difference = 0;
        for (const auto& of_one : test::of_all(std::vector<double>{flux - 3 * volumes})) {
            difference += of_one[0];
        }
        EXPECT_NEAR(difference, 0, 1e-9);
    }
}

TEST(Orientation, OfTaggedFacetsIsOutwardOnTheBoundaryAndAscendingInside) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        const auto boundary = boundary_of(mesh);
        const std::vector<FacetVertices> oriented = mesh.oriented_facets();
        ASSERT_EQ(oriented.size(), mesh.facets().size());
        std::array<std::uint64_t, 3> kinds{};
        for (std::size_t f = 0; f < oriented.size(); ++f) {
            const FacetVertices ascending = in_order(mesh.facets()[f]);
            EXPECT_EQ(in_order(oriented[f]), ascending);
            const auto found = boundary.find(ascending);
            if (found == boundary.end()) {
                EXPECT_EQ(oriented[f], ascending);
                ++kinds[0];
            } else {
                const auto& [c, face] = found->second;
                const VertexIndex opposite = mesh.cells()[c.value()][face];
                EXPECT_TRUE(points_away_from(mesh, oriented[f], opposite));
                ++kinds[points_away_from(mesh, mesh.facets()[f], opposite) ? 1 : 2];
            }
        }
        test::world().sum(kinds);
        EXPECT_GT(std::ranges::min(kinds), 0U);  // some are oriented the other way in the input
    }
}

TEST(Orientation, OfEdgesAndFacesIsTheSameOnAllProcesses) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        for (const EdgeVertices& edge : mesh.number_edges().vertices) {
            EXPECT_LT(global_number(mesh, edge[0]), global_number(mesh, edge[1]));
        }
        const MeshFaces faces = mesh.number_faces();
        for (const FacetVertices& face : faces.vertices) {
            EXPECT_TRUE(std::ranges::is_sorted(global_numbers(mesh, face)));
        }
        for (CellIndex c{0}; c < faces.of_cell.end_index(); ++c) {
            const CellVertices& cell = mesh.cells()[c.value()];
            for (std::size_t f = 0; f < 4; ++f) {
                EXPECT_EQ(points_outward(cell, f),
                          points_away_from(mesh, faces.vertices[faces.of_cell[c][f]], cell[f]));
            }
        }
    }
}

/// Compares a contiguous numbering with the reports of all processes; key(i) identifies an entity.
template <class I>
void expect_contiguous(const IndexMap<I>& map, const Sharing<I>& sharing, std::size_t count,
                       auto&& key) {
    const auto rank = static_cast<std::size_t>(test::world().rank());
    ASSERT_EQ(map.entities.size(), count);
    ASSERT_EQ(map.numbers.size(), count);
    ASSERT_EQ(map.rank_begin.size(), static_cast<std::size_t>(test::world().size()) + 1);
    EXPECT_EQ(map.copy_owners.size(), count - map.owned_count);
    EXPECT_EQ(map.rank_begin[rank + 1] - map.rank_begin[rank], map.owned_count);
    EXPECT_EQ(std::set(map.entities.begin(), map.entities.end()).size(), count);
    struct Entry {
        std::array<std::uint64_t, 4> key;
        std::uint64_t number;
    };
    std::vector<Entry> own;
    for (std::size_t k = 0; k < count; ++k) {
        const I i = map.entities[k];
        const std::uint64_t number = map.numbers[i.value()];
        if (k < map.owned_count) {
            EXPECT_TRUE(sharing.is_owned(i));
            EXPECT_EQ(number, map.rank_begin[rank] + k);
        } else {
            const int owner = map.copy_owners[k - map.owned_count];
            EXPECT_EQ(owner, sharing.owner(i));
            EXPECT_TRUE(number >= map.rank_begin[static_cast<std::size_t>(owner)] &&
                        number < map.rank_begin[static_cast<std::size_t>(owner) + 1]);
        }
        own.push_back({key(i), number});
    }
    std::map<std::array<std::uint64_t, 4>, std::uint64_t> seen;
    std::set<std::uint64_t> numbers;
    for (const auto& of_one : test::of_all(own)) {
        for (const auto& [entity, number] : of_one) {
            EXPECT_EQ(seen.try_emplace(entity, number).first->second, number);
            numbers.insert(number);
        }
    }
    EXPECT_EQ(numbers.size(), seen.size());
    EXPECT_EQ(map.rank_begin.back(), numbers.size());
}

TEST(IndexMap, NumbersOwnedEntitiesConsecutivelyAndCopiesAsTheirOwners) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        const std::size_t vertices = mesh.points().size();
        expect_contiguous(make_index_map(test::world(), mesh.vertex_sharing(), vertices),
                          mesh.vertex_sharing(), vertices, [&](VertexIndex v) {
                              return std::array<std::uint64_t, 4>{global_number(mesh, v), 0, 0, 0};
                          });
        const auto check = [&](const auto& sides) {
            expect_contiguous(make_index_map(test::world(), sides.sharing, sides.vertices.size()),
                              sides.sharing, sides.vertices.size(), [&](auto i) {
                                  return std::array<std::uint64_t, 4>{sides.numbers[i], 0, 0, 0};
                              });
        };
        check(mesh.number_edges());
        check(mesh.number_faces());
        const IndexMap<CellIndex> cells = mesh.cell_index_map();
        EXPECT_EQ(cells.owned_count, mesh.cells().size());
        const auto rank = static_cast<std::size_t>(test::world().rank());
        for (std::size_t c = 0; c < cells.owned_count; ++c) {
            EXPECT_EQ(cells.numbers[c], cells.rank_begin[rank] + c);
        }
        EXPECT_EQ(cells.rank_begin.back(), test::world().sum(mesh.cells().size()));
    }
}

TEST(CellNumbers, AreThoseOfTheWholeMeshInTheOrderOfFiles) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        std::vector<CellVertices> whole;
        for (const CellVertices& cell : mesh.collect().cells) whole.push_back(cell);
        test::world().broadcast(whole);
        const std::vector<std::uint64_t> numbers = mesh.cell_numbers();
        ASSERT_EQ(numbers.size(), mesh.cells().size());
        for (std::size_t c = 0; c < numbers.size(); ++c) {
            const auto own = global_numbers(mesh, mesh.cells()[c]);
            ASSERT_TRUE(std::ranges::equal(whole.at(numbers[c]), own, {},
                                           [](VertexIndex v) { return std::uint64_t{v.value()}; }));
        }
    }
}

TEST(VertexAttributes, AreThoseOfFiles) {
    for (const AdaptiveMesh& mesh : numbered_meshes()) {
        std::vector<double> whole = mesh.collect().point_attributes;
        test::world().broadcast(whole);
        ASSERT_EQ(mesh.attributes_per_vertex(), 2U);
        ASSERT_EQ(mesh.vertex_attributes().size(), 2 * mesh.points().size());
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            for (std::size_t k = 0; k < 2; ++k) {
                EXPECT_EQ(mesh.vertex_attributes()[2 * v + k],
                          whole.at(2 * global_number(mesh, VertexIndex{v}) + k));
            }
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
