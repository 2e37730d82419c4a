#include <utility>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "adapt/mesh_state.hpp"

namespace octetra::distributed {
namespace {

/// Returns a copy with the same capacity, which incremental levels rely on.
template <class T>
std::vector<T> copy_with_room(const std::vector<T>& list, bool is_wanted) {
    std::vector<T> copy;
    if (!is_wanted) return copy;
    reserve_in_huge_pages(copy, list.capacity());
    copy.assign(list.begin(), list.end());
    return copy;
}

}  // namespace

DetachedArrays AdaptiveMesh::detach_arrays(const ArraysInUse& in_use) {
    DistributedMesh& mesh = state_->mesh;
    std::vector<GlobalVertex>& numbers = state_->numbers.of_vertex;
    std::vector<std::uint64_t>& roots = mesh.cell_ancestors.roots;
    DetachedArrays detached{.points = copy_with_room<Point>(mesh.points, in_use.points),
                            .cells = copy_with_room<CellVertices>(mesh.cells, in_use.cells),
                            .facets = copy_with_room<FacetVertices>(mesh.facets, in_use.facets),
                            .edges = copy_with_room<EdgeVertices>(mesh.edges, in_use.edges),
                            .vertex_numbers = copy_with_room(numbers, in_use.vertex_numbers),
                            .roots = copy_with_room(roots, in_use.roots)};
    // The original arrays, to which spans refer, are returned; the copies become the mesh's arrays.
    const auto detach = [](auto& list, auto& copy, bool is_wanted) {
        if (is_wanted) list.swap(copy);
    };
    detach(static_cast<std::vector<Point>&>(mesh.points), detached.points, in_use.points);
    detach(static_cast<std::vector<CellVertices>&>(mesh.cells), detached.cells, in_use.cells);
    detach(static_cast<std::vector<FacetVertices>&>(mesh.facets), detached.facets, in_use.facets);
    detach(static_cast<std::vector<EdgeVertices>&>(mesh.edges), detached.edges, in_use.edges);
    detach(numbers, detached.vertex_numbers, in_use.vertex_numbers);
    detach(roots, detached.roots, in_use.roots);
    return detached;
}

}  // namespace octetra::distributed
