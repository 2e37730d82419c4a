#include <octetra/verify/mesh_slice.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/window_pieces.hpp>

#include "parts/exchange.hpp"

namespace octetra::verify {
namespace {

/// Distributes the slices of a list held by the first process, with `per_entity` elements for each
/// entity.
template <class T>
void share_out_list(const std::vector<T>& whole, std::uint64_t count, std::size_t per_entity,
                    std::vector<T>& slice, const ProcessGroup& group) {
    std::vector<std::vector<T>> to_each(static_cast<std::size_t>(group.size()));
    if (group.is_first() && !whole.empty()) {
        const auto at = [&](int rank) {
            const std::uint64_t begin = slice_begin(count, rank, group.size()) * per_entity;
            return whole.begin() + static_cast<std::ptrdiff_t>(begin);
        };
        for (int r = 0; r < group.size(); ++r) {
            to_each[static_cast<std::size_t>(r)].assign(at(r), at(r + 1));
        }
    }
    slice = std::move(exchange(group, std::move(to_each)).front());
}

/// Throws InputError if any kind of entity of the whole mesh cannot be numbered with 32 bits.
void check_countable(const MeshFacts& facts) {
    const std::uint64_t most = std::max({facts.vertices, facts.cells, facts.facets, facts.edges});
    if (most < VertexIndex::limit) return;
    throw InputError(
        fmt::format("the mesh is too large to be verified: {} entities of a kind; at most {} are "
                    "supported",
                    most, VertexIndex::limit));
}

}  // namespace

MeshSlice distribute_slices(const Mesh& mesh, const ProcessGroup& group) {
    struct Head {
        Totals totals;
        std::uint64_t attributes_per_point;
        std::uint32_t index_base;
    };
    const Head head =
        share_with_all(group, std::vector<Head>{{{mesh.points.size(), mesh.cells.size(),
                                                  mesh.facets.size(), mesh.edges.size()},
                                                 mesh.attributes_per_point,
                                                 mesh.index_base}})
            .front()
            .front();
    MeshSlice slice{{}, head.totals};
    Mesh& lists = slice.lists;
    lists.attributes_per_point = head.attributes_per_point;
    lists.index_base = head.index_base;
    const Totals& totals = head.totals;
    share_out_list(mesh.points, totals.vertices, 1, lists.points, group);
    share_out_list(mesh.point_markers, totals.vertices, 1, lists.point_markers, group);
    share_out_list(mesh.point_attributes, totals.vertices, head.attributes_per_point,
                   lists.point_attributes, group);
    share_out_list(mesh.cells, totals.cells, 1, lists.cells, group);
    share_out_list(mesh.regions, totals.cells, 1, lists.regions, group);
    share_out_list(mesh.facets, totals.facets, 1, lists.facets, group);
    share_out_list(mesh.facet_markers, totals.facets, 1, lists.facet_markers, group);
    share_out_list(mesh.edges, totals.edges, 1, lists.edges, group);
    share_out_list(mesh.edge_markers, totals.edges, 1, lists.edge_markers, group);
    return slice;
}

MeshSlice slice_of(MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    check_countable(facts);
    MeshSlice slice{{}, {facts.vertices, facts.cells, facts.facets, facts.edges}};
    Mesh& lists = slice.lists;
    lists.attributes_per_point = facts.attributes_per_point;
    lists.index_base = facts.index_base;
    const int size = mesh.group().size();
    const auto take = [](auto& list, auto span) {
        for (const auto& value : span) list.push_back(value);
    };
    const auto take_numbers = [](auto& list, auto span) {
        for (const auto& numbers : span) list.push_back(indices_of(numbers));
    };
    constexpr std::uint64_t at_once = std::uint64_t{1} << 16U;
    const int rank = mesh.group().rank();
    const Window vertices = slices_of(facts.vertices, size);
    lists.points.reserve(vertices.length_of(rank));
    for_each_piece(vertices, at_once, [&](const Window& piece) {
        take(lists.points, mesh.points(piece));
        if (facts.has_point_markers) take(lists.point_markers, mesh.point_markers(piece));
        if (facts.attributes_per_point > 0) {
            take(lists.point_attributes, mesh.point_attributes(piece));
        }
    });
    const Window cells = slices_of(facts.cells, size);
    lists.cells.reserve(cells.length_of(rank));
    for_each_piece(cells, at_once, [&](const Window& piece) {
        take_numbers(lists.cells, mesh.cells(piece));
        if (facts.has_regions) take(lists.regions, mesh.regions(piece));
    });
    for_each_piece(slices_of(facts.facets, size), at_once, [&](const Window& piece) {
        take_numbers(lists.facets, mesh.facets(piece));
        if (facts.has_facet_markers) take(lists.facet_markers, mesh.facet_markers(piece));
    });
    for_each_piece(slices_of(facts.edges, size), at_once, [&](const Window& piece) {
        take_numbers(lists.edges, mesh.edges(piece));
        if (facts.has_edge_markers) take(lists.edge_markers, mesh.edge_markers(piece));
    });
    return slice;
}

}  // namespace octetra::verify
