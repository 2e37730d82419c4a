#include "select/facet_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include <octetra/core/cell_quantities.hpp>
#include <octetra/core/triangle_tree.hpp>

#include "level/incremental/adjacency.hpp"
#include "select/boxes_of_others.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Throws InputError, which lists the markers of all processes.
[[noreturn]] void refuse_marker_of_all(const DistributedMesh& mesh, const Term& term) {
    const std::set<Marker> here(mesh.facet_ancestors.markers.begin(),
                                mesh.facet_ancestors.markers.end());
    std::set<Marker> all;
    for (const auto& markers :
         lists_of_all(mesh.processes, std::vector<Marker>(here.begin(), here.end()))) {
        all.insert(markers.begin(), markers.end());
    }
    refuse_marker(term, all, mesh.group_names.list());
}

/// Returns the facets of this process with one of these markers, in units of 2^exponent.
std::vector<Triangle> facets_with(const DistributedMesh& mesh, const std::vector<Marker>& markers,
                                  int exponent) {
    std::vector<Triangle> triangles;
    const AncestorMap& ancestors = mesh.facet_ancestors;
    if (ancestors.markers.empty()) return triangles;
    const auto add = [&](FacetIndex f, std::size_t root) {
        if (std::ranges::find(markers, ancestors.markers[root]) == markers.end()) return;
        const auto& [a, b, c] = mesh.facets[f];
        triangles.push_back({scaled_by(mesh.points[a], exponent),
                             scaled_by(mesh.points[b], exponent),
                             scaled_by(mesh.points[c], exponent)});
    };
    if (mesh.adjacency != nullptr) {
        for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
            add(f, mesh.adjacency->facets.root_of(f));
        }
        return triangles;
    }
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        for (std::uint32_t f = ancestors.first[r]; f < ancestors.first[r + 1]; ++f) {
            add(FacetIndex{f}, r);
        }
    }
    return triangles;
}

struct Query {
    Point point;
    double bound;  ///< a squared distance that is not greater is of no use
};

/// Collective. Replaces the squared distances of centroids by those to nearer facets of others.
void ask_others(const Communicator& processes, const TriangleTree& tree,
                const std::vector<Point>& centroids, std::vector<double>& squared) {
    const BoxesOfOthers others(lists_of_all(processes, tree.boxes(most_boxes)), processes.rank());
    const auto size = static_cast<std::size_t>(processes.size());
    std::vector<std::vector<Query>> queries(size);
    std::vector<std::vector<std::uint32_t>> asked(size);  // the cells of the queries
    for (std::size_t c = 0; c < centroids.size(); ++c) {
        const double bound = others.bound(centroids[c], squared[c]);
        others.for_each_within(centroids[c], bound, [&](std::size_t r) {
            queries[r].push_back({centroids[c], squared[c]});
            asked[r].push_back(static_cast<std::uint32_t>(c));
        });
    }
    std::vector<std::vector<double>> answers(size);
    const auto received = processes.all_to_all(queries);
    for (std::size_t r = 0; r < size; ++r) {
        for (const auto& [point, bound] : received[r]) {
            answers[r].push_back(tree.least_squared_distance(point, bound));
        }
    }
    const auto replies = processes.all_to_all(answers);
    for (std::size_t r = 0; r < size; ++r) {
        for (std::size_t i = 0; i < asked[r].size(); ++i) {
            double& least = squared[asked[r][i]];
            least = std::min(least, replies[r][i]);
        }
    }
}

}  // namespace

std::vector<double> facet_distances(const DistributedMesh& mesh, const Term& term) {
    const std::vector<Marker> markers = markers_of(term.name, mesh.group_names.list());
    const int exponent = common_exponent(mesh);
    const TriangleTree tree(facets_with(mesh, markers, exponent));
    if (mesh.processes.max(tree.empty() ? 0 : 1) == 0) refuse_marker_of_all(mesh, term);
    std::vector<Point> centroids;
    std::vector<double> squared;
    for (const auto& [a, b, c, d] : mesh.cells) {
        const Point p = centroid({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
        centroids.push_back(scaled_by(p, exponent));
        squared.push_back(tree.least_squared_distance(centroids.back()));
    }
    if (mesh.processes.size() > 1) ask_others(mesh.processes, tree, centroids, squared);
    std::vector<double> distances;
    for (const double square : squared)
        distances.push_back(std::scalbn(std::sqrt(square), exponent));
    return distances;
}

}  // namespace octetra::distributed
