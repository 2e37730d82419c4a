#include <atomic>
#include <mutex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/reference/refine.hpp>

#include "parts/cut_space.hpp"
#include "parts/mesh_part.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// The parts of a mesh that the processes of a group judge.
namespace octetra::verify {
namespace {

/// So long that the boxes of its ends do not interact.
Mesh bar() {
    Mesh mesh = test::kuhn(24, 1, 1);
    test::list_boundary(mesh);
    mesh.regions.assign(mesh.cells.size(), 3);
    mesh.point_markers.assign(mesh.points.size(), 0);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        mesh.point_markers[v] = static_cast<Marker>(v.value());
    }
    return mesh;
}

/// Calls visit(part of the mesh, domain) for each process of a group.
void for_each_part(int size, const Mesh& mesh, auto&& visit) {
    std::mutex one_at_a_time;
    test::run_together(size, [&](const ProcessGroup& group) {
        const Parts parts = part_of(verify::distribute_slices(mesh, group), group);
        const std::scoped_lock lock(one_at_a_time);
        visit(parts.fine, parts.domain);
    });
}

class PartsTest : public testing::TestWithParam<int> {};

TEST_P(PartsTest, OwnEveryVertexAndCellOnce) {
    const Mesh mesh = test::perturbed_kuhn(4, 0.2, 5);
    std::vector<int> owners_of_vertex(mesh.points.size(), 0);
    std::vector<int> owners_of_cell(mesh.cells.size(), 0);
    for_each_part(GetParam(), mesh, [&](const MeshPart& part, const Domain& domain) {
        const Mesh& seen = part.mesh;
        for (VertexIndex v{0}; v < seen.points.end_index(); ++v) {
            if (domain.owns(seen.points[v])) ++owners_of_vertex[part.numbers.of(v).value()];
        }
        for (CellIndex c{0}; c < seen.cells.end_index(); ++c) {
            if (domain.owns(seen.cells[c], seen.points)) {
                ++owners_of_cell[part.numbers.of(c).value()];
            }
        }
    });
    EXPECT_EQ(owners_of_vertex, std::vector<int>(mesh.points.size(), 1));
    EXPECT_EQ(owners_of_cell, std::vector<int>(mesh.cells.size(), 1));
}

TEST_P(PartsTest, AreSubsetsOfTheWholeMeshInItsOrder) {
    const Mesh mesh = bar();
    for_each_part(GetParam(), mesh, [&](const MeshPart& part, const Domain&) {
        const Mesh& seen = part.mesh;
        ASSERT_EQ(seen.regions.size(), seen.cells.size());
        ASSERT_EQ(seen.facet_markers.size(), seen.facets.size());
        EXPECT_TRUE(
            std::is_sorted(part.numbers.cells.numbers.begin(), part.numbers.cells.numbers.end()));
        for (VertexIndex v{0}; v < seen.points.end_index(); ++v) {
            EXPECT_EQ(seen.points[v], mesh.points[part.numbers.of(v)]);
            EXPECT_EQ(seen.point_markers[v], mesh.point_markers[part.numbers.of(v)]);
        }
        for (CellIndex c{0}; c < seen.cells.end_index(); ++c) {
            CellVertices vertices = seen.cells[c];
            for (VertexIndex& v : vertices) v = part.numbers.of(v);
            EXPECT_EQ(vertices, mesh.cells[part.numbers.of(c)]);
        }
        for (FacetIndex f{0}; f < seen.facets.end_index(); ++f) {
            const FacetIndex whole{part.numbers.facets.of(f.value())};
            EXPECT_EQ(seen.facet_markers[f], mesh.facet_markers[whole]);
        }
    });
}

TEST_P(PartsTest, SeeAllCellsAtWhatTheyOwn) {
    const Mesh mesh = test::perturbed_kuhn(4, 0.2, 6);
    std::vector<int> cells_at(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) ++cells_at[v.value()];
    }
    for_each_part(GetParam(), mesh, [&](const MeshPart& part, const Domain& domain) {
        std::vector<int> seen_at(part.mesh.points.size(), 0);
        for (const CellVertices& cell : part.mesh.cells) {
            for (const VertexIndex v : cell) ++seen_at[v.value()];
        }
        for (VertexIndex v{0}; v < part.mesh.points.end_index(); ++v) {
            if (!domain.owns(part.mesh.points[v])) continue;
            EXPECT_EQ(seen_at[v.value()], cells_at[part.numbers.of(v).value()]);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Sizes, PartsTest, testing::Values(2, 3, 4, 7),
                         [](const auto& instance) { return fmt::format("{}", instance.param); });

TEST(Parts, SeeNoMoreThanTheirNeighbourhood) {
    const Mesh mesh = bar();
    const Mesh fine = reference::refine(mesh, {.all = true}, Scheme::eight, 1).mesh;
    std::atomic<std::size_t> most = 0;
    test::run_together(4, [&](const ProcessGroup& group) {
        const Parts parts = parts_of(verify::distribute_slices(mesh, group),
                                     verify::distribute_slices(fine, group), group);
        most = std::max(most.load(), parts.fine.mesh.cells.size());
    });
    // A quarter, and on each side two cubes of 48 fine cells each and the cells that touch them.
    EXPECT_LE(most, fine.cells.size() / 4 + 6 * 48);
}

TEST(Parts, OfAMeshWithFewerCellsThanProcesses) {
    EXPECT_EQ(test::codes_of(test::verified_by_all(test::one_cell(test::regular_corners))), "");
    EXPECT_EQ(test::codes_of(test::verified_by_all(Mesh{})), "");
}

/// The verdict is that of one process alone, also between parts that do not interact.
TEST(Parts, AreJudgedLikeTheWholeForAnyFault) {
    const Mesh coarse = bar();
    const Request request{.selection = {.cells = {GlobalCell{7}, GlobalCell{70}, GlobalCell{130}}},
                          .levels = 2};
    const auto fine = reference::refine(coarse, request.selection, request.scheme, request.levels);
    const auto judged = [&](const Mesh& mesh) {
        return test::verified_by_all(coarse, mesh, {.request = request, .maps = &fine.maps});
    };
    ASSERT_EQ(test::codes_of(judged(fine.mesh)), "");
    const std::size_t cells = fine.mesh.cells.size();
    for (std::size_t i = 0; i < 12; ++i) {
        const CellIndex c{(i * 37 + 11) % cells};
        const CellIndex d{(i * 101 + 5) % cells};
        const VertexIndex v = fine.mesh.cells[d][i % 4];
        SCOPED_TRACE(fmt::format("cell {}, vertex {}", c.value(), v.value()));
        std::vector<Mesh> broken(6, fine.mesh);
        test::drop_cell(broken[0], c);
        test::flip_cell(broken[1], c);
        test::unmerge_vertex(broken[2], c, i % 4);
        const Point& p = fine.mesh.points[v];
        test::move_vertex(broken[3], v, {p.x + 0x1p-5, p.y, p.z});
        test::bisect_alone(broken[4], c, i % 6);
        broken[5].regions[c] = 4;
        broken[5].regions[d] = 5;
        for (const Mesh& mesh : broken) EXPECT_FALSE(judged(mesh).valid());
    }
}

TEST(Slices, AreThoseOfTheMeshWherever) {
    const Mesh mesh = bar();
    test::run_together(3, [&](const ProcessGroup& group) {
        const MeshSlice slice = verify::distribute_slices(group.is_first() ? mesh : Mesh{}, group);
        EXPECT_EQ(slice.totals.cells, mesh.cells.size());
        const std::uint64_t begin = slice_begin(mesh.cells.size(), group.rank(), 3);
        for (CellIndex c{0}; c < slice.lists.cells.end_index(); ++c) {
            EXPECT_EQ(slice.lists.cells[c], mesh.cells[CellIndex{begin + c.value()}]);
        }
        const std::uint64_t end = slice_begin(mesh.cells.size(), group.rank() + 1, 3);
        EXPECT_EQ(slice.lists.cells.size(), end - begin);
    });
    WholeMesh source(mesh);
    EXPECT_EQ(verify::slice_of(source).lists, mesh);
}

TEST(Slices, OfAFileAreThoseOfItsMesh) {
    const test::TemporaryFolder folder;
    Mesh mesh = test::perturbed_kuhn(26, 0.1, 1);  // several rounds
    test::list_boundary(mesh);
    mesh.regions.assign(mesh.cells.size(), 3);
    for (const std::string_view name : {"mesh.ele", "mesh.mesh"}) {
        const auto path = folder.path() / name;
        ASSERT_EQ(write_mesh(mesh, path), "");
        for (const int size : {1, 2, 5}) {
            test::run_together(size, [&](const ProcessGroup& group) {
                const MeshSlice read = verify::read_slice(path, {}, group);
                MeshSlice expected = verify::distribute_slices(mesh, group);
                expected.lists.index_base = read.lists.index_base;
                EXPECT_EQ(read.lists, expected.lists) << name;
                EXPECT_EQ(read.totals.cells, mesh.cells.size());
            });
        }
    }
}

TEST(Slices, OfABadFileAreAnErrorOnAllProcesses) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "bad.mesh";
    write_text("MeshVersionFormatted 2 Dimension 3\nVertices 1\n0 0\n", path);
    const auto message_of = [](auto&& read) {
        try {
            read();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    const std::string alone = message_of([&] { (void)read_mesh(path); });
    ASSERT_NE(alone, "none");
    test::run_together(3, [&](const ProcessGroup& group) {
        EXPECT_EQ(message_of([&] { (void)verify::read_slice(path, {}, group); }), alone);
    });
}

}  // namespace
}  // namespace octetra::verify
