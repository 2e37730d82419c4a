#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/shape.hpp>
#include <octetra/core/triangle_tree.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/reference/history.hpp>

#include "distributed/adaptive_steps.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// Compares the cells that expressions mark with a search on one process that has the whole mesh.
namespace octetra::distributed {
namespace {

Selection where(const std::string& text) { return {.where = {Expression(text)}}; }

Mesh tagged_grid() {
    Mesh mesh = test::tagged(test::kuhn(3, 3, 3));
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        const auto& [a, b, c] = mesh.facets[f];
        const bool is_low = mesh.points[a].x + mesh.points[b].x + mesh.points[c].x == 0;
        mesh.facet_markers[f] = is_low ? 7 : 8;
    }
    mesh.group_names = {{2, 7, "low side"}, {3, 1, "inside"}};
    return mesh;
}

/// A function of a vertex: linear on the first coordinate.
double height(const Point& p) { return 2 * p.x - p.y * p.z; }

/// A field with a value for each vertex and one for each cell.
std::vector<Field> fields_of(const AdaptiveMesh& mesh) {
    std::vector<double> on_vertices;
    for (const Point& p : mesh.points()) on_vertices.push_back(height(p));
    std::vector<double> on_cells;
    for (const std::uint64_t number : mesh.cell_numbers()) {
        on_cells.push_back(static_cast<double>(number % 17) / 16);
    }
    std::vector<double> vectors;
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const Point p = centroid(corners_of(mesh, c));
        vectors.insert(vectors.end(), {p.x, p.y, p.z});
    }
    return {{"u", FieldOn::vertices, 1, on_vertices},
            {"e", FieldOn::cells, 1, on_cells},
            {"v", FieldOn::cells, 3, vectors}};
}

/// The marks of all cells in canonical order, on every process.
std::vector<std::uint8_t> marks_of_all(const AdaptiveMesh& mesh,
                                       const std::vector<std::uint8_t>& marks) {
    std::map<std::uint64_t, std::uint8_t> by_number;
    const auto numbers = test::of_all(mesh.cell_numbers());
    const auto lists = test::of_all(marks);
    for (std::size_t r = 0; r < numbers.size(); ++r) {
        for (std::size_t c = 0; c < numbers[r].size(); ++c) by_number[numbers[r][c]] = lists[r][c];
    }
    std::vector<std::uint8_t> all;
    for (const auto& [number, mark] : by_number) all.push_back(mark);
    return all;
}

/// Returns 1 for the cells with a face that no other cell has, else 0.
std::vector<double> boundary_by_search(const Mesh& mesh) {
    std::map<FacetVertices, int> faces;
    const auto face_of = [&](const CellVertices& cell, std::size_t k) {
        FacetVertices face;
        for (std::size_t i = 0; i < 3; ++i) face[i] = cell[cell_faces[k][i]];
        std::ranges::sort(face);
        return face;
    };
    for (const CellVertices& cell : mesh.cells) {
        for (std::size_t k = 0; k < 4; ++k) ++faces[face_of(cell, k)];
    }
    std::vector<double> values;
    for (const CellVertices& cell : mesh.cells) {
        double value = 0;
        for (std::size_t k = 0; k < 4; ++k) value = faces[face_of(cell, k)] == 1 ? 1 : value;
        values.push_back(value);
    }
    return values;
}

double distance_by_search(const Mesh& mesh, const Corners& corners, Marker marker) {
    double least = std::numeric_limits<double>::infinity();
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        if (mesh.facet_markers[f] != marker) continue;
        const auto& [a, b, c] = mesh.facets[f];
        least = std::min(least, squared_distance(centroid(corners),
                                                 {mesh.points[a], mesh.points[b], mesh.points[c]}));
    }
    return std::sqrt(least);
}

using Oracle = std::function<bool(const Mesh&, CellIndex)>;

Corners corners_in(const Mesh& mesh, CellIndex c) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
    return corners;
}

class MarkedCells : public AdaptiveMeshIn {
protected:
    /// Collective. Expects that the oracle, evaluated on the first process, marks the same cells.
    static void expect_marked(const AdaptiveMesh& mesh, const std::string& text,
                              const Oracle& oracle) {
        SCOPED_TRACE(text);
        const auto fields = fields_of(mesh);
        const auto marks = marks_of_all(mesh, mesh.marked_cells(where(text), fields));
        const Mesh whole = mesh.collect();
        if (!mesh.processes().is_first()) return;
        ASSERT_EQ(marks.size(), whole.cells.size());
        std::size_t count = 0;
        for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
            ASSERT_EQ(marks[c.value()] != 0, oracle(whole, c)) << "cell " << c.value();
            count += marks[c.value()];
        }
        EXPECT_GT(count, 0U);
        EXPECT_LT(count, marks.size());
    }
};

TEST_P(MarkedCells, AreThoseOfASearchOnTheWholeMesh) {
    AdaptiveMesh mesh = distributed_mesh(tagged_grid(), GetParam());
    for (std::size_t step = 0; step <= steps.size() - 1; ++step) {
        expect_marked(mesh, "distance(7) < 0.77", [](const Mesh& whole, CellIndex c) {
            return distance_by_search(whole, corners_in(whole, c), 7) < 0.77;
        });
        expect_marked(mesh, "distance(\"low side\") > 1.03", [](const Mesh& whole, CellIndex c) {
            return distance_by_search(whole, corners_in(whole, c), 7) > 1.03;
        });
        expect_marked(mesh, "distance(8) >= 0.31 and region != 2",
                      [](const Mesh& whole, CellIndex c) {
                          return distance_by_search(whole, corners_in(whole, c), 8) >= 0.31 &&
                                 whole.regions[c] != 2;
                      });
        expect_marked(mesh, "boundary", [](const Mesh& whole, CellIndex c) {
            static Mesh last;
            static std::vector<double> values;
            if (last != whole) values = boundary_by_search(last = whole);
            return values[c.value()] != 0;
        });
        expect_marked(mesh, "field(u) < 0.87", [](const Mesh& whole, CellIndex c) {
            std::array<double, 4> values{};
            for (std::size_t k = 0; k < 4; ++k) values[k] = height(corners_in(whole, c)[k]);
            std::ranges::sort(values);
            return (((values[0] + values[1]) + values[2]) + values[3]) / 4 < 0.87;
        });
        expect_marked(mesh, "field_max(u) > 1.9", [](const Mesh& whole, CellIndex c) {
            bool is_any = false;
            for (const Point& p : corners_in(whole, c)) is_any |= height(p) > 1.9;
            return is_any;
        });
        expect_marked(mesh, "field(e) > 0.5",
                      [](const Mesh&, CellIndex c) { return c.value() % 17 > 8; });
        expect_marked(mesh, "fraction(e, 0.03)",
                      [](const Mesh&, CellIndex c) { return c.value() % 17 == 16; });
        expect_marked(mesh, "bulk(e, 0.02)",
                      [](const Mesh&, CellIndex c) { return c.value() % 17 == 16; });
        expect_marked(mesh, "field(v) > 2", [](const Mesh& whole, CellIndex c) {
            const Point p = centroid(corners_in(whole, c));
            return std::sqrt((0 + p.x * p.x) + p.y * p.y + p.z * p.z) > 2;
        });
        if (step + 1 < steps.size()) (void)mesh.refine(steps[step]);
    }
}

TEST_P(MarkedCells, AreThoseThatTheReferenceMarksLevelByLevel) {
    const std::vector<std::string> texts{
        "distance(7) < 0.9 and longest > 0.5",
        "generation < 2 and x + y < 1.4 or boundary and eta < 0.7 and z > 2",
        "not boundary and generation >= 1 or region == 3 and volume > 0.01",
        "min_dihedral < 45 and distance(\"low side\") > 2.2",
    };
    const Mesh input = tagged_grid();
    AdaptiveMesh mesh = distributed_mesh(input, GetParam());
    reference::History history{input, {}};
    for (const std::string& text : texts) {
        SCOPED_TRACE(text);
        Selection selection = where(text);
        if (text.starts_with("min")) selection.narrowed_by = {{.regions = {0, 1, 2}}};
        const auto marks = marks_of_all(mesh, mesh.marked_cells(selection));
        reference::Refinement present = reference::replay(history).back();
        const reference::CellMarks expected = reference::marked_cells(present, selection);
        ASSERT_TRUE(std::ranges::equal(marks, expected));
        EXPECT_GT(std::ranges::count(marks, 1), 0);
        history = reference::refined(history, expected, Scheme::eight);
        (void)mesh.refine(selection);
    }
    (void)mesh.coarsen(where("distance(7) < 1.5"));
    const Mesh whole = mesh.collect();
    EXPECT_LT(whole.cells.size(), reference::replay(history).back().mesh.cells.size());
}

TEST_P(MarkedCells, AreRefusedOnAllProcessesAlike) {
    AdaptiveMesh mesh = distributed_mesh(tagged_grid(), GetParam());
    (void)mesh.refine(steps[0]);
    const auto fields = fields_of(mesh);
    const auto refused = [&](const std::string& text) {
        return test::thrown_by<InputError>([&] { (void)mesh.marked_cells(where(text), fields); });
    };
    EXPECT_EQ(refused("distance(9) < 1"),
              "distance(9): no facet has this marker; there are 7, 8, with the names low side");
    EXPECT_EQ(refused("distance(inside) < 1"),
              "distance(inside): no facet is in a group of this name; there are the markers 7, 8, "
              "with the names low side");
    EXPECT_EQ(refused("field(w) < 1"), "field(w): there is no such field; there are u, e, v");
    // The centroid of cell 0 is the first one with this property, in the order of files.
    EXPECT_EQ(refused("sqrt(x - 9) < 1"), "the expression has no value in cell 0: sqrt(x - 9) < 1");
    EXPECT_EQ(test::thrown_by<InputError>([&] { (void)mesh.refine(where("field(u) < 1")); }),
              "field(u): this mesh has no fields");
    if (test::world().size() == 1) return;
    const bool is_first = test::world().is_first();
    EXPECT_THAT(test::thrown_by<InputError>(
                    [&] { (void)mesh.marked_cells(where(is_first ? "x < 1" : "x < 2")); }),
                testing::HasSubstr("expression"));
    EXPECT_THAT(test::thrown_by<InputError>([&] {
                    (void)mesh.refine(is_first ? where("distance(7) < 1") : Selection{.all = true});
                }),
                testing::HasSubstr("expression"));
}

INSTANTIATE_TEST_SUITE_P(Partitions, MarkedCells,
                         testing::Values(Partition{.method = PartitionMethod::rcb},
                                         Partition{.method = PartitionMethod::random, .seed = 3}));

}  // namespace
}  // namespace octetra::distributed
