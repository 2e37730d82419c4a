#include "files/input/finish_share.hpp"

#include <algorithm>

namespace octetra {

bool are_significant(const std::vector<Marker>& markers, bool zeros_are_none) {
    if (!zeros_are_none) return !markers.empty();
    return std::ranges::any_of(markers, [](Marker m) { return m != 0; });
}

void finish_share(const MeshFacts& counts, bool zeros_are_none, const ProcessGroup& group,
                  MeshShare& share) {
    MeshFacts& facts = share.facts;
    Mesh& lists = share.lists;
    facts = counts;
    if (facts.vertices == 0) lists.index_base = 0;  // whatever the format counts from
    facts.index_base = lists.index_base;
    facts.first_midpoint = facts.vertices;
    const auto keep_if_any = [&](std::vector<Marker>& markers) {
        const bool any = are_significant(markers, zeros_are_none);
        if (group.sum(any ? 1 : 0) > 0) return true;
        std::vector<Marker>().swap(markers);
        return false;
    };
    facts.has_point_markers = keep_if_any(lists.point_markers);
    facts.has_regions = keep_if_any(lists.regions);
    facts.has_facet_markers = keep_if_any(lists.facet_markers);
    facts.has_edge_markers = keep_if_any(lists.edge_markers);
    share.first_vertex = group.sum_before(lists.points.size());
    share.first_cell = group.sum_before(lists.cells.size());
    share.first_facet = group.sum_before(lists.facets.size());
    share.first_edge = group.sum_before(lists.edges.size());
}

}  // namespace octetra
