#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/world.hpp"
#include "level/tuning.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/thrown.hpp"

/// If rounding makes several children of a cell flat or inverted, both engines report the first one
/// in canonical order. The tests derive it from small whole numbers, where midpoints are exact; far
/// from the origin, where only whole numbers are representable, the same midpoints are rounded.
namespace octetra::distributed {
namespace {

/// Doubles from here to twice as much are whole numbers.
constexpr double far_out = 0x1p52;

Point moved(const Point& p, double by) { return {p.x + by, p.y + by, p.z + by}; }

Mesh moved(Mesh mesh, double by) {
    for (Point& p : mesh.points) p = moved(p, by);
    return mesh;
}

/// The orientations of the children that one more level makes of a cell, in canonical order. Before
/// the last level all coordinates are whole numbers.
std::vector<int> signs_far_out(const Mesh& cell, Scheme scheme, int levels) {
    const Mesh fine = moved(reference::refine(cell, {.all = true}, scheme, levels).mesh, far_out);
    std::vector<int> signs;
    for (CellIndex c{0}; c < fine.cells.end_index(); ++c) {
        const Corners p = test::corners_of(fine, c);
        signs.push_back(orientation(p[0], p[1], p[2], p[3]));
    }
    return signs;
}

/// A cell that the last of these levels makes invalid: its first bad child has the sign `first`,
/// and a later one the sign `later`.
Mesh spoiled_cell(int first, int later, Scheme scheme, int levels) {
    std::mt19937_64 random(1);
    const std::uint64_t grid = levels == 1 ? 1 : 2;  // the first of two levels is exact
    const auto coordinate = [&] { return static_cast<double>(random() % 12 * grid); };
    while (true) {
        std::array<Point, 4> p;
        for (Point& corner : p) corner = {coordinate(), coordinate(), coordinate()};
        if (orientation(p[0], p[1], p[2], p[3]) == 0) continue;
        const Mesh cell = test::one_cell(p);
        const auto signs = signs_far_out(cell, scheme, levels);
        const auto bad = std::ranges::find_if(signs, [](int sign) { return sign <= 0; });
        if (bad == signs.end() || *bad != first) continue;
        if (std::find(bad, signs.end(), later) != signs.end()) return cell;
    }
}

/// Places the cells in a row, so that they do not meet.
Mesh in_a_row(const std::vector<Mesh>& cells) {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 4>> all;
    for (const Mesh& cell : cells) {
        const std::size_t n = points.size();
        all.push_back({n, n + 1, n + 2, n + 3});
        const double along = 64.0 * static_cast<double>(all.size());
        for (const VertexIndex v : cell.cells.front()) {
            const Point& p = cell.points[v];
            points.push_back({p.x + along, p.y, p.z});
        }
    }
    return test::mesh_of(points, all);
}

class FirstBadChild : public testing::TestWithParam<std::tuple<Scheme, int, double>> {
protected:
    const Scheme scheme = std::get<0>(GetParam());
    const int levels = std::get<1>(GetParam());
    const Tuning tuning{.incremental_below = std::get<2>(GetParam())};

    /// Checks the message of both engines, on all ranks, with several partitions.
    void expect_message(const Mesh& mesh, const std::string& words) const {
        Selection every;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) every.cells.push_back(GlobalCell{c});
        EXPECT_THAT(test::thrown_by<InputError>(
                        [&] { (void)reference::refine(mesh, every, scheme, levels); }),
                    testing::HasSubstr(words));
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const auto cell_to_rank = partition_cells(
                mesh, test::world().size(), {.method = PartitionMethod::random, .seed = seed});
            DistributedMesh part = distribute(test::world(), mesh, cell_to_rank);
            EXPECT_THAT(test::thrown_by<InputError>([&] {
                            (void)refine(part, every, {scheme, levels}, tuning);
                        }),
                        testing::HasSubstr(words));
        }
    }
};

TEST_P(FirstBadChild, IsReportedAsFlatOrInverted) {
    const Mesh good = test::one_cell({{{0, 0, 0}, {16, 0, 0}, {0, 16, 0}, {0, 0, 16}}});
    const Mesh flat_first = spoiled_cell(0, -1, scheme, levels);
    const Mesh inverted_first = spoiled_cell(-1, 0, scheme, levels);
    const std::string place = "cell 1, level " + std::to_string(levels);
    const std::string makes = ": bisection would make a child that is ";
    expect_message(moved(in_a_row({good, flat_first, inverted_first, good}), far_out),
                   place + makes + "flat");
    expect_message(moved(in_a_row({good, inverted_first, flat_first, good}), far_out),
                   place + makes + "inverted");
}

INSTANTIATE_TEST_SUITE_P(SchemesLevelsWays, FirstBadChild,
                         testing::Combine(testing::Values(Scheme::eight, Scheme::four),
                                          testing::Values(1, 2), testing::Values(0.0, 10.0)));

}  // namespace
}  // namespace octetra::distributed
