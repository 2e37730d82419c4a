#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <numeric>
#include <optional>

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// Tests of AdaptiveMesh through its public interface.
namespace octetra::distributed {
namespace {

const Partition at_random{.method = PartitionMethod::random, .seed = 7};
const Partition in_blocks{.method = PartitionMethod::block};

/// On the first process, the mesh after these steps by the reference; an empty mesh on the others.
Mesh expected_after(const Mesh& mesh, std::span<const Selection> selections, Scheme scheme) {
    Mesh fine = mesh;
    if (!test::world().is_first()) return {};
    for (const Selection& selection : selections) {
        fine = reference::refine(fine, selection, scheme, 1).mesh;
    }
    return fine;
}

INSTANTIATE_TEST_SUITE_P(Parts, AdaptiveMeshIn, testing::Values(Partition{}, in_blocks, at_random),
                         [](const auto& i) { return fmt::format("{}", i.index); });

TEST_P(AdaptiveMeshIn, EqualsTheReferenceAfterEveryStep) {
    const Mesh mesh = test::marked(test::perturbed_kuhn(6, 0.2, 3), 3);
    for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
        AdaptiveMesh adapted = distributed_mesh(mesh, GetParam());
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const Adaptation step =
                k % 2 == 0 ? adapted.refine(marks_of(adapted, steps[k]), {.scheme = scheme})
                           : adapted.refine(steps[k], {.scheme = scheme});
            EXPECT_TRUE(step.changed);
            // With one process the kind of each level is known.
            EXPECT_TRUE(test::world().size() > 1 ||
                        step.cells.keeps_numbers() == (k != 2 && k != 5));
            const Mesh expected = expected_after(mesh, std::span(steps).first(k + 1), scheme);
            const Mesh whole = adapted.collect();
            EXPECT_TRUE(whole == expected || !test::world().is_first()) << k;
        }
    }
}

TEST(AdaptiveMesh, FindsASingleMarkAtAnyPosition) {
    const Mesh mesh = test::perturbed_kuhn(6, 0.2, 3);
    const auto ranks = partition_cells(mesh, test::world().size(), in_blocks);
    const AdaptiveMesh input = AdaptiveMesh::distribute(test::world(), mesh, ranks);
    const std::size_t most = test::world().max(input.cells().size());
    for (std::size_t c = 0; c < most; c += 7) {  // one mark in each word of eight
        std::vector<std::uint8_t> bytes(input.cells().size(), 0);
        std::vector<CellIndex> list;
        if (c < bytes.size()) {
            bytes[c] = 128;
            list.emplace_back(c);
        }
        AdaptiveMesh by_bytes = AdaptiveMesh::distribute(test::world(), mesh, ranks);
        AdaptiveMesh by_list = AdaptiveMesh::distribute(test::world(), mesh, ranks);
        EXPECT_TRUE(by_bytes.refine(bytes).changed);
        EXPECT_TRUE(by_list.refine(list).changed);
        EXPECT_TRUE(std::ranges::equal(by_bytes.cells(), by_list.cells())) << c;
    }
}

TEST_P(AdaptiveMeshIn, WritesTheFilesOfTheWholeMesh) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, 3), GetParam());
    std::optional<test::TemporaryFolder> folder;  // one folder for all processes
    std::string path;
    if (test::world().is_first()) {
        folder.emplace();
        path = (*folder / "mesh.mesh").string();
    }
    std::vector<char> letters(path.begin(), path.end());
    test::world().broadcast(letters);
    path.assign(letters.begin(), letters.end());
    for (const Selection& selection : {steps[0], steps[2]}) {
        (void)mesh.refine(selection);
        EXPECT_EQ(mesh.write(path), "");
        Mesh expected = mesh.collect();
        if (!test::world().is_first()) continue;
        const std::string bytes = test::content_of(path);
        expected.index_base = 1;
        WholeMesh whole(expected);
        (void)write_mesh(whole, path);
        EXPECT_EQ(bytes, test::content_of(path));
    }
}

TEST_P(AdaptiveMeshIn, KnowsOfEveryVertexItsNumberItsSharersAndItsOwner) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, 1), GetParam());
    for (const Selection& selection : steps) {
        (void)mesh.refine(selection);
        struct Vertex {
            std::uint64_t number;
            Point point;
        };
        std::vector<Vertex> own;
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            own.push_back({static_cast<std::uint64_t>(mesh.vertex_numbers()[v]), mesh.points()[v]});
        }
        std::map<std::uint64_t, std::vector<int>> ranks;
        std::map<std::uint64_t, Point> points;
        const auto all = test::of_all(own);
        for (std::size_t r = 0; r < all.size(); ++r) {
            for (const Vertex& v : all[r]) {
                ranks[v.number].push_back(static_cast<int>(r));
                EXPECT_EQ(points.try_emplace(v.number, v.point).first->second, v.point);
            }
        }
        EXPECT_EQ(mesh.vertex_count(), ranks.size());
        EXPECT_EQ(ranks.rbegin()->first + 1, ranks.size());

        // A process's report of an owner and of the interface with this process.
        struct OwnerReport {
            std::uint64_t number;
            int owner;
        };
        std::vector<OwnerReport> said;
        const Sharing<VertexIndex>& sharing = mesh.vertex_sharing();
        for (std::size_t v = 0; v < own.size(); ++v) {
            std::vector<int> expected = ranks[own[v].number];
            std::erase(expected, test::world().rank());
            EXPECT_TRUE(std::ranges::equal(sharing.sharers(VertexIndex{v}), expected));
            said.push_back({own[v].number, sharing.owner(VertexIndex{v})});
            EXPECT_EQ(std::ranges::count(ranks[own[v].number], said.back().owner), 1);
        }
        std::map<std::uint64_t, int> owners;
        for (const auto& from_one : test::of_all(said)) {
            for (const auto& [number, owner] : from_one) {
                EXPECT_EQ(owners.try_emplace(number, owner).first->second, owner);
            }
        }
        std::vector<int> neighbours;
        std::vector<std::vector<std::uint64_t>> listed;
        std::vector<std::vector<std::uint64_t>> owned;
        std::vector<std::vector<std::uint64_t>> received;
        for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
            neighbours.push_back(with.rank);
            auto& list = listed.emplace_back();
            for (const VertexIndex v : with.entities) list.push_back(own[v.value()].number);
            auto& owned_list = owned.emplace_back();
            for (const VertexIndex v : with.owned) owned_list.push_back(own[v.value()].number);
            auto& received_list = received.emplace_back();
            for (const VertexIndex v : with.received) {
                received_list.push_back(own[v.value()].number);
            }
        }
        EXPECT_EQ(test::world().exchange_with(neighbours, listed), listed);
        EXPECT_EQ(test::world().exchange_with(neighbours, owned), received);
    }
}

TEST_P(AdaptiveMeshIn, ReturnsTheAncestorOfEachCellFacetAndEdge) {
    AdaptiveMesh mesh =
        distributed_mesh(test::marked(test::perturbed_kuhn(3, 0.2, 2), 2), GetParam());
    for (const Selection& selection : steps) {
        const std::vector<CellVertices> cells(mesh.cells().begin(), mesh.cells().end());
        const std::vector<FacetVertices> facets(mesh.facets().begin(), mesh.facets().end());
        const std::vector<EdgeVertices> edges(mesh.edges().begin(), mesh.edges().end());
        const auto regions = mesh.regions();
        const auto facet_markers = mesh.facet_markers();
        const auto edge_markers = mesh.edge_markers();
        const std::size_t vertex_count = mesh.points().size();

        const Adaptation step = mesh.refine(selection);
        ASSERT_EQ(step.vertex_count_before, vertex_count);
        ASSERT_EQ(vertex_count + step.new_vertex_ends.size(), mesh.points().size());
        for (std::size_t k = 0; k < step.new_vertex_ends.size(); ++k) {
            const auto [a, b] = step.new_vertex_ends[k];
            EXPECT_EQ(mesh.points()[vertex_count + k],
                      midpoint(mesh.points()[a.value()], mesh.points()[b.value()]));
        }
        // Children have corners of the parent and midpoints of its edges, and their shares add up
        // to 1.
        const auto check = [&](const EntityTransfer& entity_transfer, const auto& before,
                               const auto& after, const auto& markers_before,
                               const auto& markers_after) {
            ASSERT_EQ(entity_transfer.count_before(), before.size());
            ASSERT_EQ(entity_transfer.count(), after.size());
            std::vector<double> shares(before.size(), 0);
            std::vector<char> is_reported(after.size(), 0);
            const auto parents = entity_transfer.parents();
            entity_transfer.for_each_new(
                [&](std::size_t number, std::size_t whole, unsigned halvings) {
                    EXPECT_EQ(parents[number], whole);
                    EXPECT_EQ(is_reported[number], 0);
                    is_reported[number] = 1;
                    shares[whole] += 1.0 / (1U << halvings);
                });
            for (std::size_t i = 0; i < after.size(); ++i) {
                const auto& whole = before[parents[i]];
                const auto is_corner = [&](VertexIndex v) {
                    return std::ranges::find(whole, v) != whole.end();
                };
                EXPECT_TRUE(std::ranges::all_of(after[i], [&](VertexIndex v) {
                    if (is_corner(v)) return true;
                    const auto [a, b] = step.new_vertex_ends.at(v.value() - vertex_count);
                    return is_corner(a) && is_corner(b);
                }));
                EXPECT_TRUE(is_reported[i] != 0 || after[i] == before[i]);
                EXPECT_EQ(markers_after[i], markers_before[parents[i]]);
            }
            for (const double share : shares) EXPECT_TRUE(share == 1 || share == 0) << share;
        };
        check(step.cells, cells, mesh.cells(), regions, mesh.regions());
        check(step.facets, facets, mesh.facets(), facet_markers, mesh.facet_markers());
        check(step.edges, edges, mesh.edges(), edge_markers, mesh.edge_markers());
    }
}

/// A cell value of a program that cannot be divided.
struct Material {
    int number = 0;
    int phase = 0;
    friend bool operator==(const Material&, const Material&) = default;
};

TEST_P(AdaptiveMeshIn, TransfersLinearFunctionsExactlyAndKeepsSums) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, 4), GetParam());
    const auto linear = [&] {
        std::vector<double> values;
        for (const auto& [x, y, z] : mesh.points()) {
            values.push_back(1 + 2 * x - y);
            values.push_back(z - 4 * y);
        }
        return values;
    };
    std::vector<double> u = linear();
    std::vector<float> mass(mesh.cells().size(), 1);
    std::vector<int> root(mesh.cells().size());
    std::iota(root.begin(), root.end(), 0);
    std::vector<Material> material;
    for (const int r : root) material.push_back({r, -r});
    const auto first_cells = mesh.cells().size();
    for (const Selection& selection : steps) {
        const Adaptation step = mesh.refine(selection);
        u = step.transfer_vertices(std::move(u), 2);
        mass = step.transfer_cells(std::move(mass), 1, CellValues::divided);
        root = step.transfer_cells(std::move(root));
        EXPECT_THROW((void)step.transfer_cells(material, 1, CellValues::divided),
                     std::invalid_argument);
        material = step.transfer_cells(std::move(material));
        EXPECT_EQ(u, linear());
    }
    std::vector<double> mass_of_root(first_cells, 0);
    for (std::size_t c = 0; c < mass.size(); ++c) {
        mass_of_root[static_cast<std::size_t>(root[c])] += double{mass[c]};
    }
    EXPECT_EQ(mass_of_root, std::vector<double>(first_cells, 1));
    ASSERT_EQ(material.size(), root.size());
    for (std::size_t c = 0; c < root.size(); ++c) {
        EXPECT_EQ(material[c], (Material{root[c], -root[c]}));
    }
    const Adaptation nothing = mesh.refine(Selection{});
    EXPECT_EQ(nothing.transfer_cells(mass), mass);
    mass.push_back(1);
    EXPECT_THROW((void)nothing.transfer_cells(mass), std::invalid_argument);
}

TEST_P(AdaptiveMeshIn, BisectsMarkedEdgesAndWhatClosureAdds) {
    // Lists the longest edges of marked cells on all processes that have them; scheme 2t marks
    // exactly these.
    const Mesh whole = test::perturbed_kuhn(3, 0.2, 6);
    for (const Selection& selection : {steps[0], steps[2]}) {
        AdaptiveMesh by_edges = distributed_mesh(whole, GetParam());
        std::vector<EdgeVertices> longest;
        for (std::size_t c = 0; c < by_edges.cells().size(); ++c) {
            if (!marks(selection, corners_of(by_edges, c), 0, GlobalCell{0})) continue;
            const CellVertices& cell = by_edges.cells()[c];
            EdgeVertices best{cell[0], cell[1]};
            const auto length = [&](const EdgeVertices& e) {
                const Point& a = by_edges.points()[e[0].value()];
                const Point& b = by_edges.points()[e[1].value()];
                return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
            };
            for (const auto& [i, j] : cell_edges) {
                const EdgeVertices edge{cell[j], cell[i]};
                if (length(edge) > length(best)) best = edge;
            }
            longest.push_back(best);
        }
        (void)by_edges.refine_edges(longest);
        const Mesh expected = expected_after(whole, std::span(&selection, 1), Scheme::two);
        EXPECT_TRUE(by_edges.collect() == expected);
    }
}

TEST_P(AdaptiveMeshIn, ExchangesValuesOfSharedVertices) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, 1), GetParam());
    (void)mesh.refine(steps[2]);
    const Sharing<VertexIndex>& sharing = mesh.vertex_sharing();
    const std::size_t count = mesh.points().size();
    const auto& world = test::world();

    std::vector<int> values(2 * count, world.rank());
    update_copies(world, sharing, count, values, 2);
    for (std::size_t v = 0; v < count; ++v) {
        EXPECT_EQ(values[2 * v], sharing.owner(VertexIndex{v}));
        EXPECT_EQ(values[2 * v + 1], sharing.owner(VertexIndex{v}));
    }
    std::vector<double> ones(count, 1);
    combine_everywhere(world, sharing, count, ones, std::plus<>());
    std::vector<int> least(count, world.rank());
    combine_everywhere(world, sharing, count, std::span(least),
                       [](int a, int b) { return std::min(a, b); });
    std::uint64_t owned = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const auto sharers = sharing.sharers(VertexIndex{v});
        EXPECT_EQ(ones[v], static_cast<double>(1 + sharers.size()));
        const int first = sharers.empty() ? world.rank() : std::min(sharers[0], world.rank());
        EXPECT_EQ(least[v], first);
        owned += sharing.is_owned(VertexIndex{v}) ? 1U : 0U;
    }
    EXPECT_EQ(world.sum(owned), mesh.vertex_count());

    // A list that is too short on one process: the same message on all.
    if (world.rank() == world.size() - 1) ones.pop_back();
    const auto words =
        test::thrown_by<InputError>([&] { update_copies(world, sharing, count, std::span(ones)); });
    EXPECT_THAT(words, testing::HasSubstr("values for"));
}

/// A number that a cell contributes to each of its vertices; sums of these are exact.
double weight_of(const Corners& corners) {
    double sum = 0;
    for (const Point& p : corners) sum += p.x + 2 * p.y + 4 * p.z;
    return sum;
}

/// Assembly as in solvers: each process sums over its own cells, and shared values are then added.
std::vector<double> assembled(const AdaptiveMesh& mesh) {
    std::vector<double> values(mesh.points().size(), 0);
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        for (const VertexIndex v : mesh.cells()[c]) {
            values[v.value()] += weight_of(corners_of(mesh, c));
        }
    }
    combine_everywhere(test::world(), mesh.vertex_sharing(), values.size(), std::span(values),
                       std::plus<>());
    return values;
}

TEST(AdaptiveMesh, HasSharersAlsoWherePartsTouchInOneVertexOrEdgeOnly) {
    // Fans of cells round one vertex and round one edge, each cell on another process: few cells
    // share a face or an edge.
    Mesh round_vertex;
    round_vertex.points = {{0, 0, 0}};
    Mesh round_edge;
    round_edge.points = {{0, 0, 0}, {0, 0, 1}};
    for (int k = 0; k < 6; ++k) {
        const double x = k < 3 ? 1 : -1;
        const double at = 1 + k % 3 * 2;
        const auto add = [](Mesh& mesh, std::initializer_list<Point> points, std::size_t first) {
            CellVertices cell;
            for (std::size_t i = 0; i < first; ++i) cell[i] = VertexIndex{i};
            std::size_t i = first;
            for (const Point& p : points) cell[i++] = mesh.points.append(p);
            if (orientation(mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                            mesh.points[cell[3]]) < 0) {
                std::swap(cell[2], cell[3]);
            }
            mesh.cells.push_back(cell);
        };
        add(round_vertex, {{x, at, 0}, {x, at + 1, 0}, {x, at, 1}}, 1);
        add(round_edge, {{x, at, 0}, {x, at + 1, 0}}, 2);
    }
    for (const Mesh& whole : {round_vertex, round_edge}) {
        std::vector<int> ranks;
        for (int c = 0; c < 6; ++c) ranks.push_back(c % test::world().size());
        AdaptiveMesh parts = AdaptiveMesh::distribute(test::world(), whole, ranks);
        for (int step = 0; step < 2; ++step) {
            const Mesh fine = parts.collect();
            std::vector<double> expected(fine.points.size(), 0);
            for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
                Corners corners;
                for (std::size_t k = 0; k < 4; ++k) corners[k] = fine.points[fine.cells[c][k]];
                for (const VertexIndex v : fine.cells[c]) expected[v.value()] += weight_of(corners);
            }
            test::world().broadcast(expected);
            const std::vector<double> values = assembled(parts);
            for (std::size_t v = 0; v < values.size(); ++v) {
                EXPECT_EQ(values[v],
                          expected[static_cast<std::uint64_t>(parts.vertex_numbers()[v])]);
            }
            (void)parts.refine(Selection{.all = true});
        }
    }
}

TEST_P(AdaptiveMeshIn, IsVerifiedWithoutBeingCollectedOrChanged) {
    Mesh coarse = test::perturbed_kuhn(3, 0.2, 2);
    test::list_boundary(coarse);
    AdaptiveMesh mesh = distributed_mesh(coarse, GetParam());
    const Selection selection = steps[0];
    (void)mesh.refine(selection);
    CanonicalMesh fine = mesh.canonical();
    const auto verdict = verify::verify_refinement(
        verify::distribute_slices(coarse, test::world()), verify::slice_of(fine.whole()),
        test::world(), {.request = verify::Request{selection, Scheme::eight, 1}});
    EXPECT_TRUE(verdict.valid());
    (void)mesh.refine(Selection{.all = true});  // further steps are possible
}

}  // namespace
}  // namespace octetra::distributed
