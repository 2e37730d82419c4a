#include "topology/orient_facets.hpp"

#include <algorithm>
#include <utility>

#include <octetra/distributed/sides.hpp>

#include "topology/face_neighbours.hpp"

namespace octetra::distributed {
namespace {

FacetVertices sorted(FacetVertices face) {
    std::ranges::sort(face);
    return face;
}

}  // namespace

std::vector<FacetVertices> orient_facets(const DistributedMesh& mesh) {
    std::vector<std::pair<FacetVertices, FacetVertices>> boundary;  // sorted, outward
    for (const auto& [cell, face] : find_boundary(mesh)) {
        const FacetVertices outward = outward_face(mesh.cells[cell], face);
        boundary.emplace_back(sorted(outward), outward);
    }
    std::ranges::sort(boundary);
    std::vector<FacetVertices> oriented;
    oriented.reserve(mesh.facets.size());
    for (const FacetVertices& facet : mesh.facets) {
        const FacetVertices ascending = sorted(facet);
        const auto found = std::ranges::lower_bound(
            boundary, ascending, {}, &std::pair<FacetVertices, FacetVertices>::first);
        const bool is_boundary = found != boundary.end() && found->first == ascending;
        oriented.push_back(is_boundary ? found->second : ascending);
    }
    return oriented;
}

}  // namespace octetra::distributed
