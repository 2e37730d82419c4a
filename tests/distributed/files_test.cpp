#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

/// Tests of collective writing: slices of the canonical order, and one file.
namespace octetra::distributed {
namespace {

const Communicator& world() { return test::world(); }

DistributedMesh refined(const Mesh& mesh, const std::string& partition, const Selection& selection,
                        int levels) {
    DistributedMesh part = distribute(
        world(), mesh, partition_cells(mesh, world().size(), parse_partition(partition)));
    refine(part, selection, {.levels = levels});
    return part;
}

/// Collective. The slices of all windows, concatenated on the first process.
template <class T>
std::vector<T> concatenated(std::uint64_t count, std::uint64_t slice_length, auto&& slice_of) {
    std::vector<T> all;
    const std::uint64_t stride = slice_length * static_cast<std::uint64_t>(world().size());
    for (Window window{0, slice_length, count}; window.begin < count; window.begin += stride) {
        const std::span<const T> slice = slice_of(window);
        for (const auto& one : world().gather(std::vector<T>(slice.begin(), slice.end()))) {
            all.insert(all.end(), one.begin(), one.end());
        }
    }
    return all;
}

void expect_slices(MeshSource& slices, std::uint64_t length, const Collected& whole) {
    WholeMesh expected(whole.mesh, &whole.maps);
    const MeshFacts& f = slices.facts();
    const auto expect = [&]<class T>(std::uint64_t count,
                                     std::span<const T> (MeshSource::*slice)(const Window&)) {
        const auto found = concatenated<T>(
            count, length, [&](const Window& window) { return (slices.*slice)(window); });
        if (world().is_first()) {
            EXPECT_TRUE(std::ranges::equal(found, (expected.*slice)(whole_window(count))))
                << length;
        }
    };
    using Source = MeshSource;
    expect(f.vertices, &Source::points);
    expect(f.vertices, &Source::point_markers);
    expect(f.vertices, &Source::point_attributes);
    expect(f.vertices - f.first_midpoint, &Source::midpoint_ends);
    expect(f.cells, &Source::cells);
    expect(f.cells, &Source::regions);
    expect(f.cells, &Source::parents);
    expect(f.facets, &Source::facets);
    expect(f.facets, &Source::facet_markers);
    expect(f.edges, &Source::edges);
    expect(f.edges, &Source::edge_markers);
}

TEST(Slices, OfEveryLengthMakeUpTheWholeMesh) {
    const Selection selection{.random = RandomShare{0.1, 3}};
    for (const std::string partition : {"lepp", "random:1"}) {
        const Mesh mesh = test::marked(test::perturbed_kuhn(2, 0.3, 5), 1);
        const reference::Refinement expected = reference::refine(mesh, selection, Scheme::eight, 2);
        const Collected whole{expected.mesh, expected.maps};
        CanonicalMesh fine(refined(mesh, partition, selection, 2));
        const std::uint64_t cells = fine.facts().cells;
        ASSERT_EQ(cells, expected.mesh.cells.size());
        for (const std::uint64_t length : {std::uint64_t{5}, std::uint64_t{64}, cells / 2, cells}) {
            expect_slices(fine.whole(), length, whole);
        }
    }
}

/// Collective. Slices of `length` entities that are as far apart as possible, concatenated on the
/// first process.
template <class T>
std::vector<T> concatenated_ranges(std::uint64_t count, std::uint64_t length, auto&& slice_of) {
    const auto ranks = static_cast<std::uint64_t>(world().size());
    const std::uint64_t share = (count + ranks - 1) / ranks;
    std::vector<T> own;
    for (std::uint64_t begin = 0; begin < share; begin += length) {
        const std::span<const T> slice =
            slice_of(Window{begin, std::min(length, share - begin), count, share});
        own.insert(own.end(), slice.begin(), slice.end());
    }
    std::vector<T> all;
    for (const auto& one : world().gather(own)) all.insert(all.end(), one.begin(), one.end());
    return all;
}

TEST(Slices, ThatAreFarApartMakeUpTheWholeMesh) {
    const Mesh mesh = test::marked(test::perturbed_kuhn(2, 0.3, 5), 1);
    const Selection selection{.random = RandomShare{0.1, 3}};
    const reference::Refinement expected = reference::refine(mesh, selection, Scheme::eight, 2);
    for (const std::string partition : {"block", "random:1"}) {
        CanonicalMesh fine(refined(mesh, partition, selection, 2));
        const std::uint64_t count = fine.facts().cells;
        WholeMesh whole(expected.mesh, &expected.maps);
        for (const std::uint64_t length : {std::uint64_t{7}, std::uint64_t{64}, count}) {
            const auto cells = concatenated_ranges<VertexNumbers<4>>(
                count, length, [&](const Window& window) { return fine.whole().cells(window); });
            const auto regions = concatenated_ranges<Marker>(
                count, length, [&](const Window& window) { return fine.whole().regions(window); });
            if (!world().is_first()) continue;
            EXPECT_TRUE(std::ranges::equal(cells, whole.cells(whole_window(count)))) << length;
            EXPECT_TRUE(std::ranges::equal(regions, whole.regions(whole_window(count)))) << length;
        }
    }
}

/// The number of digits is known without requesting the vertices.
TEST(Slices, KnowHowManyDigitsTheirVerticesHave) {
    const Mesh mesh = test::marked(test::perturbed_kuhn(3, 0.3, 5), 1);
    CanonicalMesh fine(refined(mesh, "random:1", {.random = RandomShare{0.2, 3}}, 2));
    MeshSource& slices = fine.whole();
    const auto expect = [&](std::uint64_t count, auto digits, auto digits_one_by_one) {
        const auto ranks = static_cast<std::uint64_t>(world().size());
        for (const std::uint64_t length : {(count + ranks - 1) / ranks, std::uint64_t{40}}) {
            for (const std::uint64_t index_base : {0U, 1U}) {
                const Window window{0, length, count};
                EXPECT_EQ(digits(window, index_base), digits_one_by_one(window, index_base))
                    << length << " from " << index_base;
            }
        }
    };
    const MeshFacts& f = slices.facts();
    ASSERT_GT(f.vertices, 1000);
    expect(
        f.cells, [&](const Window& w, std::uint64_t base) { return slices.cell_digits(w, base); },
        [&](const Window& w, std::uint64_t base) {
            return slices.MeshSource::cell_digits(w, base);
        });
    expect(
        f.facets, [&](const Window& w, std::uint64_t base) { return slices.facet_digits(w, base); },
        [&](const Window& w, std::uint64_t base) {
            return slices.MeshSource::facet_digits(w, base);
        });
    expect(
        f.edges, [&](const Window& w, std::uint64_t base) { return slices.edge_digits(w, base); },
        [&](const Window& w, std::uint64_t base) {
            return slices.MeshSource::edge_digits(w, base);
        });
}

/// Collective. The mesh as the last part of one with `vertices` more vertices before it.
DistributedMesh behind(std::uint64_t vertices, const Mesh& mesh) {
    DistributedMesh part = distribute(world(), mesh, partition_cells(mesh, world().size(), {}));
    for (GlobalVertex& v : part.input_vertices) {
        v = GlobalVertex{static_cast<std::uint64_t>(v) + vertices};
    }
    part.input_vertex_count += vertices;
    refine(part, {.random = RandomShare{0.3, 3}}, {.levels = 2});
    return part;
}

TEST(Slices, NumberVerticesBeyond32Bits) {
    if (world().size() == 1) return;  // a single process numbers its vertices from 0
    constexpr std::uint64_t far = std::uint64_t{1} << 33U;
    const Mesh mesh = test::marked(test::perturbed_kuhn(2, 0.3, 5), 1);
    CanonicalMesh near(behind(0, mesh));
    CanonicalMesh beyond(behind(far, mesh));
    const MeshFacts& f = near.facts();
    ASSERT_EQ(beyond.facts().vertices, f.vertices + far);
    ASSERT_EQ(beyond.facts().first_midpoint, f.first_midpoint + far);
    const auto expect = [&]<std::size_t N>(
                            std::uint64_t count,
                            std::span<const VertexNumbers<N>> (MeshSource::*slice)(const Window&)) {
        const Window window{0, count / 2 + 1, count};
        const auto lower = (near.whole().*slice)(window);
        const auto upper = (beyond.whole().*slice)(window);
        ASSERT_EQ(lower.size(), upper.size());
        for (std::size_t i = 0; i < lower.size(); ++i) {
            for (std::size_t k = 0; k < N; ++k) ASSERT_EQ(upper[i][k], lower[i][k] + far);
        }
    };
    expect(f.cells, &MeshSource::cells);
    expect(f.facets, &MeshSource::facets);
    expect(f.edges, &MeshSource::edges);
    expect(f.vertices - f.first_midpoint, &MeshSource::midpoint_ends);
    const auto points = near.whole().points({0, f.vertices, f.vertices});
    const auto last = beyond.whole().points({far, f.vertices, f.vertices + far});
    EXPECT_TRUE(std::ranges::equal(points, last));
    EXPECT_THROW(static_cast<void>(collect(behind(far, mesh))), InputError);
}

class FilesOfAllRanks : public testing::TestWithParam<std::string> {
protected:
    /// Collective. All ranks write the file; the first one compares it with the reference's.
    void expect_equal_files(const Mesh& mesh, const Selection& selection, int levels) const {
        const test::SharedFolder folder;
        CanonicalMesh fine(refined(mesh, GetParam(), selection, levels));
        std::string maps;
        if (world().is_first()) {
            const auto expected = reference::refine(mesh, selection, Scheme::eight, levels);
            WholeMesh source(expected.mesh, &expected.maps);
            for (const std::string name : {"r.ele", "r.mesh", "r.meshb", "r.vtu", "r.vtkhdf"}) {
                (void)write_mesh(source, folder / name);
            }
            write_maps(source, folder / "r.maps");
        }
        for (const std::string name : {"d.ele", "d.mesh", "d.meshb", "d.vtu", "d.vtkhdf"}) {
            (void)write_mesh(fine, folder / name);
        }
        write_maps(fine.whole(), folder / "d.maps");
        if (!world().is_first()) return;
        for (const std::string extension :
             {".node", ".ele", ".face", ".edge", ".mesh", ".meshb", ".vtu", ".vtkhdf", ".maps"}) {
            if (!std::filesystem::exists(folder / ("r" + extension))) {
                EXPECT_FALSE(std::filesystem::exists(folder / ("d" + extension))) << extension;
                continue;
            }
            EXPECT_TRUE(test::content_of(folder / ("r" + extension)) ==
                        test::content_of(folder / ("d" + extension)))
                << extension;
        }
    }
};

TEST_P(FilesOfAllRanks, AreTheReferencesOfAMeshWithEverythingMarked) {
    expect_equal_files(test::featured(test::marked(test::perturbed_kuhn(3, 0.3, 5), 1), 1),
                       {.random = RandomShare{0.1, 3}}, 2);
}

TEST_P(FilesOfAllRanks, AreTheReferencesWhereNothingWasMarked) {
    expect_equal_files(test::kuhn(1, 1, 1), {.regions = {7}}, 1);
}

/// More than one window of every list, and more than one compressed block of every array.
TEST_P(FilesOfAllRanks, AreTheReferencesOfAMeshOfManyWindows) {
    Mesh mesh = test::kuhn(18, 18, 18, 1.0 / 3);
    test::list_boundary(mesh);
    expect_equal_files(mesh, {.boxes = {{{0, 0, 0}, {6, 6, 6}}}}, 1);
}

INSTANTIATE_TEST_SUITE_P(, FilesOfAllRanks, testing::Values("block", "lepp", "random:3"),
                         [](const auto& suite) {
                             return suite.param.substr(0, suite.param.find(':'));
                         });

}  // namespace
}  // namespace octetra::distributed
