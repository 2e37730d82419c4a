#include <map>
#include <set>

#include <gtest/gtest.h>

#include "reference/random_history.hpp"
#include "support/coarsening.hpp"
#include "support/conformity.hpp"
#include "support/nesting.hpp"

/// Properties of a mesh after coarsening, compared with the mesh before.
namespace octetra::reference {
namespace {

constexpr double scale = random_history_scale;

class CoarsenedMesh : public testing::TestWithParam<std::uint64_t> {
protected:
    struct Pair {
        CellMarks marked;
        std::vector<Refinement> before;
        std::vector<Refinement> after;
    };
    [[nodiscard]] static std::vector<Pair> pairs() {
        std::vector<Pair> pairs;
        for (const Call& call : random_coarsenings(GetParam())) {
            pairs.push_back({call.marked, replay(call.before), replay(call.after)});
        }
        return pairs;
    }
};

/// The ascending corners, and the region tag.
std::pair<Corners, Marker> geometry_of(const Mesh& mesh, CellIndex c) {
    Corners corners = test::corners_of(mesh, c);
    std::ranges::sort(corners, std::less<>{});
    return {corners, mesh.regions[c]};
}

TEST_P(CoarsenedMesh, HasEveryCellThatWasNotMarked) {
    for (const auto& [marked, before, after] : pairs()) {
        const auto cells = test::geometry(after.back().mesh);
        const Mesh& old = before.back().mesh;
        for (CellIndex c{0}; c < old.cells.end_index(); ++c) {
            if (marked[c] != 0) continue;
            EXPECT_TRUE(std::ranges::binary_search(cells, geometry_of(old, c), std::less<>{}));
        }
    }
}

/// For facets or edges that have an unmarked cell.
template <class I, std::size_t N>
void expect_tags_stay(const Mesh& old, const CellMarks& marked, const Mesh& coarser,
                      IndexVector<I, std::array<VertexIndex, N>> Mesh::*list,
                      IndexVector<I, Marker> Mesh::*markers) {
    Mesh unmarked = old;
    (unmarked.*list).clear();
    (unmarked.*markers).clear();
    for (I i{0}; i < (old.*list).end_index(); ++i) {
        for (CellIndex c{0}; c < old.cells.end_index(); ++c) {
            const bool has_it = std::ranges::all_of((old.*list)[i], [&](VertexIndex v) {
                return std::ranges::count(old.cells[c], v) > 0;
            });
            if (marked[c] != 0 || !has_it) continue;
            (unmarked.*list).append((old.*list)[i]);
            (unmarked.*markers).append((old.*markers)[i]);
            break;
        }
    }
    EXPECT_TRUE(std::ranges::includes(test::geometry(coarser, coarser.*list, coarser.*markers),
                                      test::geometry(unmarked, unmarked.*list, unmarked.*markers),
                                      std::less<>{}));
}

TEST_P(CoarsenedMesh, HasTheTaggedFacetsAndEdgesOfCellsThatWereNotMarked) {
    for (const auto& [marked, before, after] : pairs()) {
        const Mesh& old = before.back().mesh;
        expect_tags_stay(old, marked, after.back().mesh, &Mesh::facets, &Mesh::facet_markers);
        expect_tags_stay(old, marked, after.back().mesh, &Mesh::edges, &Mesh::edge_markers);
    }
}

/// The marker and the two attributes of each vertex.
using Tags = std::map<Point, std::tuple<Marker, double, double>>;

Tags tags_of(const Mesh& mesh) {
    Tags tags;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        const double* const attributes = &mesh.point_attributes[2 * v.value()];
        tags[mesh.points[v]] = {mesh.point_markers[v], attributes[0], attributes[1]};
    }
    return tags;
}

TEST_P(CoarsenedMesh, HasVerticesOfTheOneBeforeWithTheirMarkersAndAttributes) {
    for (const auto& [marked, before, after] : pairs()) {
        const Tags old = tags_of(before.back().mesh);
        const Tags tags = tags_of(after.back().mesh);
        EXPECT_EQ(tags.size(), after.back().mesh.points.size());
        EXPECT_TRUE(std::ranges::includes(old, tags));
    }
}

TEST_P(CoarsenedMesh, IsRefinedByTheOneBefore) {
    for (const auto& [marked, before, after] : pairs()) {
        EXPECT_TRUE(test::refines(before.back(), after.back(), scale));
        EXPECT_TRUE(test::refines(after.back(), after.front(), scale));
    }
}

TEST_P(CoarsenedMesh, HasNoCellBackByMoreThanOneGeneration) {
    for (const auto& [marked, before, after] : pairs()) {
        const Mesh& old = before.back().mesh;
        const Mesh& coarser = after.back().mesh;
        const auto parents = test::parents(before, scale);
        const auto around = test::cells_around(before.back(), after.back(), scale);
        for (CellIndex c{0}; c < old.cells.end_index(); ++c) {
            for (const CellIndex larger : around[c]) {
                EXPECT_TRUE(
                    test::contains(parents[c.value()], test::corners_of(coarser, larger), scale));
            }
        }
    }
}

TEST_P(CoarsenedMesh, ConformsAfterEveryStep) {
    for (const auto& [marked, before, after] : pairs()) {
        for (const Refinement& refinement : after) {
            const auto census = test::count_faces(refinement.mesh);
            EXPECT_EQ(census.faults, 0U);
            EXPECT_EQ(census.boundary_faces, refinement.mesh.facets.size());  // all are tagged
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, CoarsenedMesh, testing::Range<std::uint64_t>(0, 12));

}  // namespace
}  // namespace octetra::reference
