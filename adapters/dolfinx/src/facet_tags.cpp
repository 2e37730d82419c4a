#include "facet_tags.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <dolfinx/common/IndexMap.h>
#include <dolfinx/common/Scatterer.h>
#include <dolfinx/graph/AdjacencyList.h>

namespace octetra::dolfinx {
namespace {

namespace od = distributed;

constexpr std::int64_t no_marker = std::numeric_limits<std::int64_t>::min();

struct TaggedFacet {
    std::array<std::int32_t, 3> nodes{};  ///< ascending
    Marker marker = 0;
};

std::vector<TaggedFacet> tagged_facets(const od::AdaptiveMesh& mesh, const Nodes& nodes) {
    const std::vector<Marker> markers = mesh.facet_markers();
    std::vector<TaggedFacet> facets(markers.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            facets[f].nodes[k] = nodes.of_vertex[mesh.facets()[f][k].value()];
        }
        std::ranges::sort(facets[f].nodes);
        facets[f].marker = markers[f];
    }
    std::ranges::sort(facets, {}, &TaggedFacet::nodes);
    return facets;
}

/// Returns, for each facet of DOLFINx, the marker if it is one of the tagged facets.
std::vector<std::int64_t> markers_of_facets(
    const std::vector<TaggedFacet>& tagged, std::size_t node_count,
    const ::dolfinx::graph::AdjacencyList<std::int32_t>& facets) {
    std::vector<std::int64_t> markers(static_cast<std::size_t>(facets.num_nodes()), no_marker);
    std::vector<std::uint8_t> is_at_tagged(node_count, 0);  // excludes most facets from the search
    for (const TaggedFacet& facet : tagged) {
        for (const std::int32_t node : facet.nodes)
            is_at_tagged[static_cast<std::size_t>(node)] = 1;
    }
    for (std::int32_t f = 0; f < facets.num_nodes(); ++f) {
        const auto corners = facets.links(f);
        if (!std::ranges::all_of(corners, [&](std::int32_t node) {
                return is_at_tagged[static_cast<std::size_t>(node)] != 0;
            })) {
            continue;
        }
        std::array<std::int32_t, 3> nodes{corners[0], corners[1], corners[2]};
        std::ranges::sort(nodes);
        const auto found = std::ranges::lower_bound(tagged, nodes, {}, &TaggedFacet::nodes);
        if (found != tagged.end() && found->nodes == nodes) {
            markers[static_cast<std::size_t>(f)] = found->marker;
        }
    }
    return markers;
}

/// Collective. A facet is tagged on one rank: sends the marker to its owner, and from there to all
/// ranks that have the facet.
void share_markers(const ::dolfinx::common::IndexMap& facets, std::vector<std::int64_t>& markers) {
    const auto own = std::span(markers).first(static_cast<std::size_t>(facets.size_local()));
    const auto ghosts = std::span(markers).subspan(own.size());
    ::dolfinx::common::Scatterer scatterer(facets, 1);
    scatterer.scatter_rev<std::int64_t>(
        own, ghosts, [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
    scatterer.scatter_fwd<std::int64_t>(own, ghosts);
}

}  // namespace

std::optional<MarkerTags> tag_facets(const od::AdaptiveMesh& mesh, const Nodes& nodes,
                                     const std::shared_ptr<const ::dolfinx::mesh::Mesh>& made) {
    std::vector<TaggedFacet> tagged;
    mesh.processes().transaction([&] { tagged = tagged_facets(mesh, nodes); });
    if (mesh.processes().max(std::uint64_t{tagged.size()}) == 0) return std::nullopt;
    ::dolfinx::mesh::Topology& topology = made->topology_mutable();
    topology.create_entities(2);
    auto markers = markers_of_facets(tagged, nodes.vertices.size(), *topology.connectivity(2, 0));
    share_markers(*topology.index_map(2), markers);
    std::vector<std::int32_t> facets;
    std::vector<Marker> values;
    for (std::size_t f = 0; f < markers.size(); ++f) {
        if (markers[f] == no_marker) continue;
        facets.push_back(static_cast<std::int32_t>(f));
        values.push_back(static_cast<Marker>(markers[f]));
    }
    return MarkerTags(made, 2, std::move(facets), std::move(values));
}

}  // namespace octetra::dolfinx
