#include <gtest/gtest.h>

#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

/// What all ranks write together: slices of the canonical order, and one file.
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

/// Collective. A folder of the first process's that all know.
class SharedFolder {
public:
    SharedFolder() {
        if (world().is_first()) own_ = std::make_unique<test::TemporaryFolder>();
        std::vector<char> name;
        if (own_) {
            const std::string path = own_->path().native();
            name.assign(path.begin(), path.end());
        }
        world().broadcast(name);
        path_ = std::string(name.begin(), name.end());
    }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }

private:
    std::unique_ptr<test::TemporaryFolder> own_;
    std::filesystem::path path_;
};

/// Collective. All slices of all windows, put together on the first process.
template <class T>
std::vector<T> put_together(std::uint64_t count, std::uint64_t slice_length, auto&& slice_of) {
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
    const MeshFacts& f = slices.facts();
    const auto expect = [&]<class T>(const std::vector<T>& expected, std::uint64_t count,
                                     std::span<const T> (MeshSource::*slice)(const Window&)) {
        const auto found = put_together<T>(
            count, length, [&](const Window& window) { return (slices.*slice)(window); });
        if (world().is_first()) {
            EXPECT_TRUE(found == expected) << length;
        }
    };
    using Source = MeshSource;
    expect.operator()<Point>(whole.mesh.points, f.vertices, &Source::points);
    expect.operator()<Marker>(whole.mesh.point_markers, f.vertices, &Source::point_markers);
    expect.operator()<double>(whole.mesh.point_attributes, f.vertices, &Source::point_attributes);
    expect.operator()<EdgeVertices>(whole.maps.midpoint_to_edge, f.vertices - f.first_midpoint,
                                    &Source::midpoint_ends);
    expect.operator()<CellVertices>(whole.mesh.cells, f.cells, &Source::cells);
    expect.operator()<Marker>(whole.mesh.regions, f.cells, &Source::regions);
    expect.operator()<CellIndex>(whole.maps.cell_to_parent, f.cells, &Source::parents);
    expect.operator()<FacetVertices>(whole.mesh.facets, f.facets, &Source::facets);
    expect.operator()<Marker>(whole.mesh.facet_markers, f.facets, &Source::facet_markers);
    expect.operator()<EdgeVertices>(whole.mesh.edges, f.edges, &Source::edges);
    expect.operator()<Marker>(whole.mesh.edge_markers, f.edges, &Source::edge_markers);
}

TEST(Slices, OfEveryLengthMakeUpTheWholeMesh) {
    const Selection selection{.random = RandomShare{0.1, 3}};
    for (const std::string partition : {"lepp", "random:1"}) {
        const Mesh mesh = test::marked(test::shaken_kuhn(2, 0.3, 5), 1);
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

class FilesOfAllRanks : public testing::TestWithParam<std::string> {
protected:
    /// Collective. All ranks write the file, the first one the reference's, and compares.
    void expect_equal_files(const Mesh& mesh, const Selection& selection, int levels) const {
        const SharedFolder folder;
        CanonicalMesh fine(refined(mesh, GetParam(), selection, levels));
        std::string maps;
        if (world().is_first()) {
            const auto expected = reference::refine(mesh, selection, Scheme::eight, levels);
            WholeMesh source(expected.mesh, &expected.maps);
            for (const std::string name : {"r.ele", "r.mesh", "r.vtu"}) {
                (void)write_mesh(source, folder / name);
            }
            write_maps(source, folder / "r.maps");
        }
        for (const std::string name : {"d.ele", "d.mesh", "d.vtu"}) {
            (void)write_mesh(fine, folder / name);
        }
        write_maps(fine.whole(), folder / "d.maps");
        if (!world().is_first()) return;
        for (const std::string extension :
             {".node", ".ele", ".face", ".edge", ".mesh", ".vtu", ".maps"}) {
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
    expect_equal_files(test::marked(test::shaken_kuhn(3, 0.3, 5), 1),
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
