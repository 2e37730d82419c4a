#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <octetra/core/mesh_source.hpp>

#include "files/output/text_slices.hpp"

namespace octetra {

/// The vertices and markers of the cells, facets or edges of a MeshSource, as a file lists them.
template <std::size_t N>
struct EntityList {
    std::uint64_t count;
    bool has_markers;
    std::span<const VertexNumbers<N>> (MeshSource::*vertices)(const Window&);
    std::span<const Marker> (MeshSource::*markers)(const Window&);
    std::uint64_t (MeshSource::*digits)(const Window&, std::uint64_t index_base);
};

[[nodiscard]] inline EntityList<4> list_of_cells(const MeshFacts& facts) {
    return {facts.cells, facts.has_regions, &MeshSource::cells, &MeshSource::regions,
            &MeshSource::cell_digits};
}
[[nodiscard]] inline EntityList<3> list_of_facets(const MeshFacts& facts) {
    return {facts.facets, facts.has_facet_markers, &MeshSource::facets, &MeshSource::facet_markers,
            &MeshSource::facet_digits};
}
[[nodiscard]] inline EntityList<2> list_of_edges(const MeshFacts& facts) {
    return {facts.edges, facts.has_edge_markers, &MeshSource::edges, &MeshSource::edge_markers,
            &MeshSource::edge_digits};
}

/// Collective. Returns the size in bytes of the vertices of this process's slice as text, numbered
/// from `index_base`, with one separator after each number.
template <std::size_t N>
[[nodiscard]] std::uint64_t bytes_of_vertices(MeshSource& mesh, const EntityList<N>& list,
                                              const Window& slices, std::uint64_t index_base) {
    return (mesh.*list.digits)(slices, index_base) + N * slices.length_of(mesh.group().rank());
}

/// Collective. Returns the sum of bytes_of(marker) over this process's slice of a list with
/// markers.
template <std::size_t N>
[[nodiscard]] std::uint64_t bytes_of_markers(MeshSource& mesh, const EntityList<N>& list,
                                             const Window& slices, auto&& bytes_of) {
    std::uint64_t bytes = 0;
    for_each_piece(slices, lines_of_a_turn(list.count, mesh.group()), [&](const Window& piece) {
        for (const Marker marker : (mesh.*list.markers)(piece)) bytes += bytes_of(marker);
    });
    return bytes;
}

}  // namespace octetra
