#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <octetra/core/selection.hpp>

#include "petsc/plex_support.hpp"

/// Compares the volumes and areas of the points with each label value with those of the mesh.
namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;
using Measures = std::map<Marker, double>;

/// The sum over all processes for each marker from -4 to 9.
Measures over_all(Measures measures) {
    for (Marker marker = -4; marker <= 9; ++marker) {
        const PetscReal all = sum_over_all(measures.contains(marker) ? measures[marker] : 0);
        measures.erase(marker);
        if (all > 0) measures[marker] = all;
    }
    return measures;
}

/// For each value of a label the measure of the points at this depth, each counted once.
Measures measures_of(DM plex, const char* name, PetscInt depth) {
    const std::vector<char> is_leaf = are_leaves(plex);
    Measures measures;
    PetscInt begin = 0;
    PetscInt end = 0;
    EXPECT_EQ(DMPlexGetDepthStratum(plex, depth, &begin, &end), 0);
    for (PetscInt p = begin; p < end; ++p) {
        PetscInt value = -1;
        EXPECT_EQ(DMGetLabelValue(plex, name, p, &value), 0);
        if (value == -1 || is_leaf[static_cast<std::size_t>(p)] != 0) continue;
        PetscReal measure = 0;
        PetscReal centroid[3];
        PetscReal normal[3];
        EXPECT_EQ(DMPlexComputeCellGeometryFVM(plex, p, &measure, centroid, normal), 0);
        measures[static_cast<Marker>(value)] += measure;
    }
    return over_all(measures);
}

double length(const Point& a, const Point& b) {
    return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

double area(const Point& a, const Point& b, const Point& c) {
    const double x = length(a, b);
    const double y = length(b, c);
    const double z = length(c, a);
    const double s = (x + y + z) / 2;
    return std::sqrt(s * (s - x) * (s - y) * (s - z));
}

void expect_equal(const Measures& a, const Measures& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [marker, measure] : a) {
        ASSERT_TRUE(b.contains(marker)) << marker;
        EXPECT_NEAR(measure, b.at(marker), 1e-8 * measure) << marker;
    }
}

class PlexLabelsOf : public testing::TestWithParam<const char*> {
protected:
    AdaptiveMesh mesh_ = adapted_mesh(GetParam());
    OwnedPlex plex_{to_plex(mesh_)};

    /// The measures of listed facets or edges, each counted once, on the first process.
    template <class I, std::size_t N>
    static Measures expected(const Mesh& whole,
                             const IndexVector<I, std::array<VertexIndex, N>>& list,
                             const IndexVector<I, Marker>& markers, auto&& measure) {
        Measures measures;
        std::set<std::array<VertexIndex, N>> known;
        for (I i{0}; i < list.end_index(); ++i) {
            auto key = list[i];
            std::ranges::sort(key);
            if (known.insert(key).second) measures[markers[i]] += measure(whole.points, list[i]);
        }
        return over_all(measures);
    }
};
INSTANTIATE_TEST_SUITE_P(Partitions, PlexLabelsOf, testing::Values("rcb", "random:3"));

TEST_P(PlexLabelsOf, CellsHaveTheVolumesOfRegions) {
    Measures expected;
    const auto regions = mesh_.regions();
    for (std::size_t c = 0; c < regions.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh_.points()[mesh_.cells()[c][k].value()];
        }
        expected[regions[c]] += volume(corners);
    }
    expect_equal(measures_of(plex_, "Cell Sets", 3), over_all(expected));
}

TEST_P(PlexLabelsOf, FacesHaveTheAreasOfFacets) {
    const Mesh whole = mesh_.collect();
    expect_equal(measures_of(plex_, "Face Sets", 2),
                 expected(whole, whole.facets, whole.facet_markers,
                          [](const auto& points, const FacetVertices& f) {
                              return area(points[f[0]], points[f[1]], points[f[2]]);
                          }));
}

TEST_P(PlexLabelsOf, EdgesHaveTheLengthsOfEdges) {
    const Mesh whole = mesh_.collect();
    expect_equal(measures_of(plex_, "Edge Sets", 1),
                 expected(whole, whole.edges, whole.edge_markers,
                          [](const auto& points, const EdgeVertices& e) {
                              return length(points[e[0]], points[e[1]]);
                          }));
}

TEST_P(PlexLabelsOf, SharedPointsAreTheSameOnAllThatHaveThem) {
    if (test::world().size() == 1) return;
    PetscSF sharers = nullptr;
    must(DMGetPointSF(plex_, &sharers));
    for (const char* name : {"Face Sets", "Edge Sets"}) {
        std::vector<PetscInt> values(are_leaves(plex_).size());
        for (std::size_t p = 0; p < values.size(); ++p) {
            must(DMGetLabelValue(plex_, name, static_cast<PetscInt>(p), &values[p]));
        }
        std::vector<PetscInt> of_owner = values;
        must(PetscSFBcastBegin(sharers, MPIU_INT, values.data(), of_owner.data(), MPI_REPLACE));
        must(PetscSFBcastEnd(sharers, MPIU_INT, values.data(), of_owner.data(), MPI_REPLACE));
        EXPECT_EQ(of_owner, values) << name;
    }
}

TEST(PlexLabelNames, AreTheCallersAndEmptyOnesLeaveOut) {
    const AdaptiveMesh mesh = adapted_mesh("rcb");
    const OwnedPlex plex(
        to_plex(mesh, PETSC_COMM_WORLD, {.cells = "material", .faces = "", .edges = "wires"}));
    for (const auto& [name, is_there] :
         std::map<std::string, PetscBool>{{"material", PETSC_TRUE},
                                          {"wires", PETSC_TRUE},
                                          {"Cell Sets", PETSC_FALSE},
                                          {"Face Sets", PETSC_FALSE}}) {
        PetscBool has = PETSC_FALSE;
        must(DMHasLabel(plex, name.c_str(), &has));
        EXPECT_EQ(has, is_there) << name;
    }
}

}  // namespace
}  // namespace octetra::petsc
