#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/evaluated_mesh.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// Graded sizes, compared with a search on one process that has the
/// whole mesh.
namespace octetra::distributed {
namespace {

/// The pairs of cells that share a face.
std::vector<std::pair<std::size_t, std::size_t>> face_pairs(const Mesh& mesh) {
    std::map<FacetVertices, std::size_t> first;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const auto& [i, j, k] : cell_faces) {
            FacetVertices face{mesh.cells[c][i], mesh.cells[c][j], mesh.cells[c][k]};
            std::ranges::sort(face);
            const auto [found, is_new] = first.try_emplace(face, c.value());
            if (!is_new) pairs.emplace_back(found->second, c.value());
        }
    }
    return pairs;
}

/// Lowers sizes pair by pair until nothing changes.
std::vector<double> graded_by_search(const Mesh& mesh, std::vector<double> sizes,
                                     double gradation) {
    std::vector<Point> centroids;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        centroids.push_back(centroid(corners_of_whole(mesh, c)));
    }
    const auto pairs = face_pairs(mesh);
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        const auto lower = [&](std::size_t to, std::size_t from) {
            const Point& a = centroids[to];
            const Point& b = centroids[from];
            const double length = std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                                            (a.z - b.z) * (a.z - b.z));
            const double limit = sizes[from] + (gradation - 1) * length;
            if (limit < sizes[to]) {
                sizes[to] = limit;
                is_changed = true;
            }
        };
        for (const auto& [a, b] : pairs) {
            lower(a, b);
            lower(b, a);
        }
    }
    return sizes;
}

class GradedSizes : public EvaluatedMesh {};

TEST_P(GradedSizes, AreTheGreatestOnesThatGrowSlowlyFromCellToCell) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    for (std::size_t step = 0; step < steps.size(); ++step) {
        for (const double gradation : {1.25, 1.7, 3.0}) {
            const Mesh whole = mesh.collect();
            std::vector<double> sizes;
            std::vector<double> graded;
            if (mesh.processes().is_first()) {
                for (CellIndex c{0}; c < whole.cells.end_index(); ++c) {
                    const Point p = centroid(corners_of_whole(whole, c));
                    // Small in two corners, and large elsewhere.
                    const bool is_small = p.x + p.y + p.z < 1.6 || p.x + p.y + p.z > 7.4;
                    sizes.push_back(is_small ? ((0.1 * p.y + 0.01) - 5) + 5 : 5);
                }
                graded = graded_by_search(whole, sizes, gradation);
                EXPECT_NE(sizes, graded);
            }
            expect_values(
                mesh,
                "graded((x + y + z < 1.6 or x + y + z > 7.4) * (0.1 * y + 0.01 - 5) + 5, " +
                    std::to_string(gradation) + ") * 1",
                graded);
        }
        if (step + 1 < steps.size()) (void)mesh.refine(steps[step]);
    }
}

TEST_P(GradedSizes, UseFieldsMarkersAndTheHistory) {
    AdaptiveMesh mesh = distributed_mesh(test::tagged(test::kuhn(3, 3, 3)), GetParam());
    (void)mesh.refine(steps[0]);
    (void)mesh.refine(steps[2]);
    std::vector<double> sizes;
    for (const Point& p : mesh.points()) sizes.push_back(0.25 + p.x * p.y / 8);
    const std::vector<Field> fields{{"h", FieldOn::vertices, 1, sizes}};
    // Without a limit that is reached, a size is that of the expression.
    EXPECT_EQ(marks_where(mesh, "longest > graded(size(h) + generation / 4, 1e9)", fields),
              marks_where(mesh, "longest > size(h) + generation / 4", fields));
    EXPECT_NE(marks_where(mesh, "longest > graded(size(h) + generation / 4, 1.1)", fields),
              marks_where(mesh, "longest > size(h) + generation / 4", fields));
    const auto refused = [&](const std::string& text) {
        return test::thrown_by<InputError>([&] { (void)marks_where(mesh, text, fields); });
    };
    EXPECT_EQ(refused("longest > graded(sqrt(x - 9), 1.3)"),
              "the expression has no value in cell 0: sqrt(x - 9)");
    EXPECT_EQ(refused("longest > graded(field(w), 1.3)"),
              "field(w): there is no such field; there are h");
}

INSTANTIATE_TEST_SUITE_P(Partitions, GradedSizes,
                         testing::Values(Partition{.method = PartitionMethod::rcb},
                                         Partition{.method = PartitionMethod::random, .seed = 3}));

}  // namespace
}  // namespace octetra::distributed
