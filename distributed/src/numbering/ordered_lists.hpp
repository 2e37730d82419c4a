#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {

/// A list of a mesh and its ancestors in canonical order: the mesh's own list, or a copy if that is
/// unordered. Refers to the mesh.
template <class List>
class OrderedList {
    using I = decltype(std::declval<const List&>().end_index());

public:
    OrderedList(const List& list, const AncestorMap& ancestors, const auto* unordered)
        : list_(&list), ancestors_(&ancestors) {
        if (unordered == nullptr || unordered->is_ordered()) return;
        auto ordered = unordered->ordered(list, ancestors);
        own_list_ = std::move(ordered.list);
        before_ = std::move(ordered.before);
        own_ancestors_ = {ancestors.roots, std::move(ordered.first), ancestors.markers};
        list_ = &own_list_;
        ancestors_ = &own_ancestors_;
    }
    OrderedList(const OrderedList&) = delete;
    OrderedList& operator=(const OrderedList&) = delete;
    OrderedList(OrderedList&&) = delete;
    OrderedList& operator=(OrderedList&&) = delete;
    ~OrderedList() = default;

    [[nodiscard]] const List& list() const { return *list_; }
    [[nodiscard]] const AncestorMap& ancestors() const { return *ancestors_; }
    /// The index of each entity in the mesh; empty if it is the same.
    [[nodiscard]] std::span<const I> before() const { return before_; }

private:
    const List* list_;
    const AncestorMap* ancestors_;
    List own_list_;
    AncestorMap own_ancestors_;
    std::vector<I> before_;
};

/// All lists of a mesh, which is not modified.
struct OrderedLists {
    explicit OrderedLists(const DistributedMesh& mesh)
        : cells(mesh.cells, mesh.cell_ancestors, mesh.adjacency ? &mesh.adjacency->cells : nullptr),
          facets(mesh.facets, mesh.facet_ancestors,
                 mesh.adjacency ? &mesh.adjacency->facets : nullptr),
          edges(mesh.edges, mesh.edge_ancestors,
                mesh.adjacency ? &mesh.adjacency->edges : nullptr) {}

    OrderedList<IndexVector<CellIndex, CellVertices>> cells;
    OrderedList<IndexVector<FacetIndex, FacetVertices>> facets;
    OrderedList<IndexVector<EdgeIndex, EdgeVertices>> edges;
};

}  // namespace octetra::distributed
