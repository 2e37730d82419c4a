#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/expression.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/evaluated_mesh.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// Target sizes and metrics, compared with a search on one process that has the whole mesh.
namespace octetra::distributed {
namespace {

std::string too_large(const std::string& size) { return "longest > (" + size + ")"; }

/// All numbers are multiples of a power of two, so that sums and products are exact.
double size_at(const Point& p) { return 0.25 + p.x / 8 + p.y / 16; }

/// A symmetric tensor: xx, yy, zz, xy, yz, xz.
std::array<double, 6> metric_at_point(const Point& p) {
    return {4 + p.x, 2 + p.y * 4, 8, 0.5, p.z / 4, -0.25};
}

std::vector<Field> size_fields(const AdaptiveMesh& mesh) {
    std::vector<double> sizes;
    std::vector<double> metrics;
    for (const Point& p : mesh.points()) {
        sizes.push_back(size_at(p));
        const auto metric = metric_at_point(p);
        metrics.insert(metrics.end(), metric.begin(), metric.end());
    }
    std::vector<double> of_cells;
    std::vector<double> metrics_of_cells;
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const Point p = centroid(corners_of(mesh, c));
        of_cells.push_back(size_at(p));
        const auto metric = metric_at_point(p);
        metrics_of_cells.insert(metrics_of_cells.end(), metric.begin(), metric.end());
    }
    return {{"h", FieldOn::vertices, 1, sizes},
            {"m", FieldOn::vertices, 6, metrics},
            {"hc", FieldOn::cells, 1, of_cells},
            {"mc", FieldOn::cells, 6, metrics_of_cells}};
}

Corners corners_by_search(const Mesh& mesh, CellIndex c) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
    return corners;
}

double longest_edge_by_search(const Corners& corners) {
    double longest = 0;
    for (const auto& [i, j] : cell_edges) {
        const Point& a = corners[i];
        const Point& b = corners[j];
        longest = std::max(longest, (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                                        (a.z - b.z) * (a.z - b.z));
    }
    return std::sqrt(longest);
}

/// The greatest length in the metric, which `metric(corner)` returns.
double longest_by_metric(const Corners& corners, auto&& metric) {
    double longest = 0;
    for (const auto& [i, j] : cell_edges) {
        const std::array<double, 6> a = metric(corners[i]);
        const std::array<double, 6> b = metric(corners[j]);
        const std::array<double, 3> v{corners[j].x - corners[i].x, corners[j].y - corners[i].y,
                                      corners[j].z - corners[i].z};
        const auto entry = [&](std::size_t k) { return (a[k] + b[k]) / 2; };
        const std::array<std::array<std::size_t, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
        double square = 0;
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) square += v[r] * entry(place[r][c]) * v[c];
        }
        longest = std::max(longest, std::sqrt(square));
    }
    return longest;
}

class SizeMarks : public EvaluatedMesh {
protected:
    /// Collective. Expects the cells whose longest edge is longer than size(whole mesh, cell).
    static void expect_too_large(const AdaptiveMesh& mesh, const std::string& text,
                                 const std::function<double(const Mesh&, CellIndex)>& size) {
        SCOPED_TRACE(text);
        const auto marks = marks_where(mesh, too_large(text), size_fields(mesh));
        const Mesh whole = mesh.collect();
        if (!mesh.processes().is_first()) return;
        ASSERT_EQ(marks.size(), whole.cells.size());
        for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
            const double longest = longest_edge_by_search(corners_by_search(whole, c));
            ASSERT_EQ(marks[c.value()] != 0, longest > size(whole, c)) << "cell " << c.value();
        }
        EXPECT_GT(std::ranges::count(marks, 1), 0);
        EXPECT_GT(std::ranges::count(marks, 0), 0);
    }
};

TEST_P(SizeMarks, AreTheCellsWithAnEdgeLongerThanTheSizeAtTheirCentroid) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    for (std::size_t step = 0; step < steps.size(); ++step) {
        const auto at_centroid = [&](const Mesh& whole, CellIndex c) {
            return size_at(centroid(corners_by_search(whole, c))) * 3;
        };
        expect_too_large(mesh, "3 * size(h)", at_centroid);
        expect_too_large(mesh, "3 * size(hc)", at_centroid);
        const double limit = step < 3 ? 5 : 2.5;  // so that some cells are small enough
        const std::string factor = step < 3 ? "5" : "2.5";
        const auto in_metric = [&](const Mesh& whole, CellIndex c) {
            const Corners corners = corners_by_search(whole, c);
            return longest_edge_by_search(corners) / longest_by_metric(corners, metric_at_point) *
                   limit;
        };
        expect_too_large(mesh, factor + " * size(m)", in_metric);
        expect_too_large(
            mesh, factor + " * longest / metric_longest(mc)", [&](const Mesh& whole, CellIndex c) {
                const Corners corners = corners_by_search(whole, c);
                const Point p = centroid(corners);
                return longest_edge_by_search(corners) * limit /
                       longest_by_metric(corners, [&](const Point&) { return metric_at_point(p); });
            });
        if (step + 1 < steps.size()) (void)mesh.refine(steps[step]);
    }
}

TEST_P(SizeMarks, OfAMetricAreTheCellsWithAnEdgeLongerThanOne) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    (void)mesh.refine(steps[0]);
    EXPECT_EQ(marks_where(mesh, too_large("size(m)"), size_fields(mesh)),
              marks_where(mesh, "metric_longest(m) > 1", size_fields(mesh)));
}

TEST_P(SizeMarks, AreRefusedForTheFaultyValueWithTheLowestNumber) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    (void)mesh.refine(steps[0]);
    const auto numbers = mesh.vertex_numbers();
    const auto refused = [&](const Field& field, const std::string& text) {
        return test::thrown_by<InputError>(
            [&] { (void)mesh.marked_cells({.where = {Expression(text)}}, std::array{field}); });
    };
    const auto on_vertices = [&](std::size_t components, auto&& value) {
        Field field{"f", FieldOn::vertices, components, std::vector<double>()};
        auto& values = std::get<std::vector<double>>(field.values);
        for (const GlobalVertex number : numbers) {
            const auto of = value(static_cast<std::uint64_t>(number));
            values.insert(values.end(), of.begin(), of.end());
        }
        return field;
    };
    using One = std::array<double, 1>;
    using Six = std::array<double, 6>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refused(on_vertices(1, [&](auto n) { return One{n >= 7 ? 0.0 : 1.0}; }),
                      "longest > size(f)"),
              "size(f): the size of vertex 7 is not above 0");
    EXPECT_EQ(refused(on_vertices(1, [&](auto n) { return One{n % 5 == 4 ? nan : 1.0}; }),
                      "longest > size(f)"),
              "size(f): the size of vertex 4 is not above 0");
    EXPECT_EQ(
        refused(on_vertices(6, [&](auto n) { return Six{1, 1, 1, n > 10 ? 1.0 : 0.5, 0, 0}; }),
                "metric_longest(f) > 1"),
        "metric_longest(f): the metric of vertex 11 is not positive definite");
    EXPECT_EQ(refused(on_vertices(6, [&](auto n) { return Six{1, 1, n == 9 ? -1.0 : 1, 0, 0, 0}; }),
                      "longest > size(f)"),
              "size(f): the metric of vertex 9 is not positive definite");
    EXPECT_EQ(refused(on_vertices(1, [](auto) { return One{1}; }), "metric_longest(f) > 1"),
              "metric_longest(f): the field has 1 component; a metric has 6");
    EXPECT_EQ(refused({"f", FieldOn::cells, 3, std::vector<double>(3 * mesh.cells().size(), 1)},
                      "longest > size(f)"),
              "size(f): the field has 3 components; a size has 1, and a metric has 6");
    std::vector<double> of_cells;
    for (const std::uint64_t number : mesh.cell_numbers()) of_cells.push_back(number > 20 ? -1 : 1);
    EXPECT_EQ(refused({"f", FieldOn::cells, 1, of_cells}, "longest > size(f)"),
              "size(f): the size of cell 21 is not above 0");
}

TEST_P(SizeMarks, DoNotDependOnTheScaleOfAMetric) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    const auto lengths = [&](double factor) {
        const std::vector<double> one{factor, factor, factor, 0, 0, 0};
        Field field{"f", FieldOn::vertices, 6, std::vector<double>()};
        auto& values = std::get<std::vector<double>>(field.values);
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            values.insert(values.end(), one.begin(), one.end());
        }
        return field;
    };
    const auto longer_than = [&](const std::string& length, double factor) {
        return mesh.marked_cells({.where = {Expression("metric_longest(f) > " + length)}},
                                 std::array{lengths(factor)});
    };
    const std::vector<std::uint8_t> none(mesh.cells().size(), 0);
    const std::vector<std::uint8_t> all(mesh.cells().size(), 1);
    // The longest edges are the diagonals of cubes.
    EXPECT_EQ(longer_than("1.7e150", 1e300), all);
    EXPECT_EQ(longer_than("1.8e150", 1e300), none);
    EXPECT_EQ(longer_than("1.7e-150", 1e-300), all);
    EXPECT_EQ(longer_than("1.8e-150", 1e-300), none);
}

INSTANTIATE_TEST_SUITE_P(Partitions, SizeMarks,
                         testing::Values(Partition{.method = PartitionMethod::rcb},
                                         Partition{.method = PartitionMethod::random, .seed = 3}));

}  // namespace
}  // namespace octetra::distributed
