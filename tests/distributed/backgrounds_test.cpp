#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/evaluated_mesh.hpp"
#include "select/background_cells.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// Values of background meshes, compared with a search on one process that has the whole mesh.
namespace octetra::distributed {
namespace {

class Backgrounds : public EvaluatedMesh {};

TEST_P(Backgrounds, AreInterpolatedAtTheCentroid) {
    const Mesh input = test::kuhn(4, 4, 4, 0.75);
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    AdaptiveMesh background = distributed_mesh(input, GetParam());
    const auto linear = [](const Point& p) { return 1 + p.x / 4 - p.y / 8 + p.z / 2; };
    std::vector<double> on_vertices;
    for (const Point& p : background.points()) on_vertices.push_back(linear(p));
    std::vector<double> on_cells;
    for (const std::uint64_t number : background.cell_numbers()) {
        on_cells.push_back(static_cast<double>(number));
    }
    const std::vector<Background> backgrounds{
        background.as_background("linear", {"u", FieldOn::vertices, 1, on_vertices}),
        background.as_background("cells", {"n", FieldOn::cells, 1, on_cells})};
    for (std::size_t step = 0; step < 4; ++step) {
        const auto marks = marks_where(
            mesh, "abs(background(linear) - (1 + x / 4 - y / 8 + z / 2)) < 1e-13", {}, backgrounds);
        EXPECT_EQ(std::ranges::count(marks, 0), 0);
        const Mesh whole = mesh.collect();
        std::vector<double> expected;
        if (mesh.processes().is_first()) {
            for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
                const Point p = centroid(corners_of_whole(whole, c));
                double least = 1e9;  // the first of the cells that contain the point
                for (CellIndex b{0}; b < input.cells.end_index(); ++b) {
                    const Corners around = corners_of_whole(input, b);
                    double volumes = 0;
                    for (std::size_t k = 0; k < 4; ++k) {
                        Corners part = around;
                        part[k] = p;
                        volumes += volume(part);
                    }
                    if (volumes < volume(around) * (1 + 1e-12)) {
                        least = std::min(least, static_cast<double>(b.value()));
                    }
                }
                expected.push_back(least);
            }
        }
        expect_values(mesh, "background(cells)", expected, backgrounds);
        (void)mesh.refine(steps[step]);
    }
}

TEST_P(Backgrounds, HaveTheValueOfTheClosestPointOutside) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    (void)mesh.refine(steps[2]);
    const auto count_of = [&](double side, const std::string& text) {
        AdaptiveMesh background = distributed_mesh(test::kuhn(2, 2, 2, side / 2), GetParam());
        std::vector<double> values;
        for (const Point& p : background.points()) values.push_back(1 + (p.x + 2 * p.y) / side);
        const std::vector<Background> backgrounds{
            background.as_background("b", {"u", FieldOn::vertices, 1, values})};
        return std::ranges::count(marks_where(mesh, text, {}, backgrounds), 0);
    };
    EXPECT_EQ(count_of(1, "abs(background(b) - (1 + min(x, 1) + 2 * min(y, 1))) < 1e-13"), 0);
    // All points of a cube that is much smaller are equally close.
    EXPECT_EQ(count_of(1e-200, "background(b) >= 1 and background(b) <= 4"), 0);
    EXPECT_EQ(count_of(1e200, "abs(background(b) - 1) < 1e-13"), 0);
}

/// Cells with a common edge or vertex, below z = 0 before a random rotation: the closest point of
/// both to a point above is on it.
TEST(BackgroundCells, WithACommonClosestPointAreEquallyClose) {
    std::mt19937 random(1);
    const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    for (int trial = 0; trial < 2000; ++trial) {
        const double angle = draw(0, 7);
        const double tilt = draw(0, 7);
        const auto place = [&](double x, double y, double z) {
            const double u = x * std::cos(angle) - y * std::sin(angle);
            const double v = x * std::sin(angle) + y * std::cos(angle);
            return Point{u, v * std::cos(tilt) - z * std::sin(tilt),
                         v * std::sin(tilt) + z * std::cos(tilt)};
        };
        const bool at_vertex = trial % 2 == 0;
        const double end = draw(0.5, 1);
        const auto cell = [&](double value) {
            BackgroundCell made{.corners = {place(-1, 0, 0), place(end, 0, 0), Point{}, Point{}},
                                .values = {value, value, value, value}};
            for (const std::size_t k : {2U, 3U}) {
                made.corners[k] = place(draw(-1, 0.4), draw(-1, 1), draw(-1, -0.5));
            }
            if (at_vertex) made.corners[0] = place(draw(-1, -0.5), draw(-1, 1), draw(-1, -0.5));
            std::ranges::sort(made.corners);
            return made;
        };
        const Point p = place(at_vertex ? end : draw(-0.9, 0.4), 0, draw(0.1, 1));
        EXPECT_EQ(closest_value(p, cell(1)).squared, closest_value(p, cell(2)).squared);
    }
}

TEST_P(Backgrounds, AreRefusedOnAllProcessesAlike) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(2, 2, 2)), GetParam());
    const std::size_t cells = mesh.cells().size();
    const std::vector<Background> one{
        mesh.as_background("b", {"u", FieldOn::cells, 1, std::vector<double>(cells, 1)})};
    EXPECT_EQ(
        test::thrown_by<InputError>([&] { (void)marks_where(mesh, "background(c) < 1", {}, one); }),
        "background(c): there is no such background mesh; there are b");
    EXPECT_EQ(test::thrown_by<InputError>([&] { (void)marks_where(mesh, "background(c) < 1"); }),
              "background(c): there is no such background mesh");
    const auto refused = [&](const Field& field) {
        return test::thrown_by<InputError>([&] { (void)mesh.as_background("b", field); });
    };
    EXPECT_EQ(refused({"u", FieldOn::cells, 3, std::vector<double>(3 * cells, 1)}),
              "background(b): the field has 3 components instead of 1");
    EXPECT_EQ(refused({"u", FieldOn::cells, 1, std::vector<double>(cells, std::nan(""))}),
              "background(b): a value is not a number");
}

INSTANTIATE_TEST_SUITE_P(Partitions, Backgrounds,
                         testing::Values(Partition{.method = PartitionMethod::rcb},
                                         Partition{.method = PartitionMethod::random, .seed = 3}));

}  // namespace
}  // namespace octetra::distributed
