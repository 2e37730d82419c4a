#include <algorithm>

#include "files/stretches/readers.hpp"

namespace octetra {
namespace {

/// Collective. Returns whether any process has a marker other than 0. If not, drops the markers: in
/// this format, zeros mean that there are none.
bool keep_if_any(const ProcessGroup& group, std::vector<Marker>& markers) {
    const bool any = std::ranges::any_of(markers, [](Marker m) { return m != 0; });
    if (group.sum(any ? 1 : 0) > 0) return true;
    std::vector<Marker>().swap(markers);
    return false;
}

}  // namespace

void set_common_facts(const MeshFacts& counts, const ProcessGroup& group, MeshShare& mesh_share) {
    MeshFacts& facts = mesh_share.facts;
    facts = counts;
    facts.index_base = facts.vertices == 0 ? 0 : 1;
    facts.first_midpoint = facts.vertices;
    Mesh& lists = mesh_share.lists;
    lists.index_base = facts.index_base;
    facts.has_point_markers = keep_if_any(group, lists.point_markers);
    facts.has_regions = keep_if_any(group, lists.regions);
    facts.has_facet_markers = keep_if_any(group, lists.facet_markers);
    facts.has_edge_markers = keep_if_any(group, lists.edge_markers);
}

}  // namespace octetra
