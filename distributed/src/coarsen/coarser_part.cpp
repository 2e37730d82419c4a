#include "coarsen/coarser_part.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "coarsen/coarser_interfaces.hpp"
#include "coarsen/coarser_list.hpp"
#include "comm/local_failure.hpp"
#include "history/vertex_levels.hpp"
#include "level/level.hpp"
#include "level/rounding_margin.hpp"
#include "pattern/length_order.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {
namespace {

/// Finds for each level the first bad piece of each root, as RoundingFailure asks.
class PieceCheck {
public:
    PieceCheck(const DistributedMesh& mesh, std::size_t level_count)
        : mesh_(&mesh), failures_(level_count), last_root_(level_count, no_root) {}

    void check(std::uint32_t level, std::size_t root, const CellVertices& parent,
               const Pieces<4>& pieces) {
        if (last_root_[level - 1] == root || has_rounding_margin(mesh_->points, parent)) return;
        for (std::size_t k = 0; k < pieces.count; ++k) {
            const int sign = sign_of(pieces.vertices[k], mesh_->points);
            if (sign > 0) continue;
            failures_[level - 1].note(mesh_->cell_ancestors.roots[root], sign);
            last_root_[level - 1] = root;
            return;
        }
    }
    [[nodiscard]] std::vector<RoundingFailure> failures() && { return std::move(failures_); }

private:
    static constexpr std::size_t no_root = std::numeric_limits<std::size_t>::max();

    const DistributedMesh* mesh_;
    std::vector<RoundingFailure> failures_;
    std::vector<std::size_t> last_root_;  ///< of each level, with a bad piece
};

Pieces<4> pieces_of(const CellVertices& cell, const KeptMidpoints<4>& midpoints,
                    const IndexVector<VertexIndex, Point>& points) {
    std::array<VertexIndex, 10> vertices;  // by place
    std::ranges::copy(cell, vertices.begin());
    std::ranges::copy(midpoints, vertices.begin() + 4);
    unsigned edges = 0;
    for (std::size_t e = 0; e < 6; ++e) edges |= midpoints[e].is_none() ? 0U : 1U << e;
    const Pattern& pattern =
        PatternTable::get().pattern(length_order(points, cell), static_cast<EdgeMask>(edges));
    Pieces<4> pieces{.count = pattern.child_count, .vertices = {}};
    for (std::size_t k = 0; k < pieces.count; ++k) {
        pieces.vertices[k] = child_of(vertices, pattern.children[k]);
    }
    return pieces;
}

Pieces<3> pieces_of(const FacetVertices& facet, const KeptMidpoints<3>& midpoints,
                    const IndexVector<VertexIndex, Point>& points) {
    const BisectedTriangle bisected = bisect_triangle(facet, midpoints, points);
    Pieces<3> pieces{.count = bisected.piece_count, .vertices = {}};
    std::ranges::copy(bisected.pieces, pieces.vertices.begin());
    return pieces;
}

Pieces<2> pieces_of(const EdgeVertices& edge, const KeptMidpoints<2>& midpoint) {
    return {.count = 2, .vertices = {{{edge[0], midpoint[0]}, {midpoint[0], edge[1]}}}};
}

/// What has no other numbers afterwards.
DistributedMesh unchanged_parts(const DistributedMesh& mesh) {
    DistributedMesh after;
    after.processes = mesh.processes;
    after.attributes_per_point = mesh.attributes_per_point;
    after.input_vertices = mesh.input_vertices;
    after.input_vertex_markers = mesh.input_vertex_markers;
    after.cell_ancestors = {mesh.cell_ancestors.roots, {}, mesh.cell_ancestors.markers};
    after.facet_ancestors = {mesh.facet_ancestors.roots, {}, mesh.facet_ancestors.markers};
    after.edge_ancestors = {mesh.edge_ancestors.roots, {}, mesh.edge_ancestors.markers};
    after.input_vertex_count = mesh.input_vertex_count;
    after.input_cell_count = mesh.input_cell_count;
    after.index_base = mesh.index_base;
    return after;
}

/// The numbers that vertices have afterwards, or would have if they stayed.
IndexVector<VertexIndex, VertexIndex> numbers_after(const KeptVertices& kept) {
    IndexVector<VertexIndex, VertexIndex> after;
    after.reserve(kept.size() + 1);
    std::size_t next = 0;
    for (const std::uint8_t stays : kept) {
        after.push_back(VertexIndex{next});
        next += stays;
    }
    after.push_back(VertexIndex{next});
    return after;
}

void renumber(auto& list, const IndexVector<VertexIndex, VertexIndex>& after) {
    for (auto& vertices : list) {
        for (VertexIndex& v : vertices) v = after[v];
    }
}

/// Vertices, and what belongs to them.
void keep_vertices(const DistributedMesh& mesh, const std::vector<VertexIndex>& kept,
                   const IndexVector<VertexIndex, VertexIndex>& number_after,
                   DistributedMesh& after) {
    const std::size_t first_midpoint = mesh.input_vertices.size();
    const std::size_t attributes = mesh.attributes_per_point;
    after.points.reserve(kept.size());
    after.point_attributes.reserve(kept.size() * attributes);
    after.midpoint_to_edge.reserve(kept.size() - first_midpoint);
    for (const VertexIndex v : kept) {
        after.points.push_back(mesh.points[v]);
        const auto values =
            mesh.point_attributes.begin() + static_cast<std::ptrdiff_t>(v.value() * attributes);
        after.point_attributes.insert(after.point_attributes.end(), values,
                                      values + static_cast<std::ptrdiff_t>(attributes));
        if (v.value() < first_midpoint) continue;
        const std::size_t m = v.value() - first_midpoint;
        after.midpoint_to_edge.push_back(mesh.midpoint_to_edge[m]);
        if (!mesh.midpoint_markers.empty()) {
            after.midpoint_markers.push_back(mesh.midpoint_markers[m]);
        }
    }
    renumber(after.midpoint_to_edge, number_after);
    for (const VertexIndex begin : mesh.level_begin) {
        after.level_begin.push_back(number_after[begin]);
    }
}

std::vector<VertexIndex> list_of(const KeptVertices& kept, std::size_t count) {
    std::vector<VertexIndex> list;
    list.reserve(count);
    for (VertexIndex v{0}; v < kept.end_index(); ++v) {
        if (kept[v] != 0) list.push_back(v);
    }
    return list;
}

}  // namespace

CoarserPart coarser_part(const DistributedMesh& mesh, const KeptVertices& kept) {
    const VertexLevels levels(mesh);
    const auto number_after = numbers_after(kept);
    CoarserPart part;
    part.mesh = unchanged_parts(mesh);
    part.vertices_before = list_of(kept, number_after.back().value());
    keep_vertices(mesh, part.vertices_before, number_after, part.mesh);

    const auto take = [&](auto coarser, auto& list, AncestorMap& ancestors) {
        list = std::move(coarser.list);
        renumber(list, number_after);
        ancestors.first = std::move(coarser.first);
        return std::move(coarser.whole_of);
    };
    PieceCheck check(mesh, levels.count());
    auto cells =
        ListCoarsening<CellIndex, 4>(levels, kept)
            .run(mesh.cells, [&](auto level, auto root, const auto& cell, const auto& midpoints) {
                const Pieces<4> pieces = pieces_of(cell, midpoints, mesh.points);
                check.check(level, root, cell, pieces);
                return pieces;
            });
    part.failures = std::move(check).failures();
    part.halvings = std::move(cells.halvings);
    part.cell_after = take(std::move(cells), part.mesh.cells, part.mesh.cell_ancestors);
    part.facet_after = take(ListCoarsening<FacetIndex, 3>(levels, kept)
                                .run(mesh.facets,
                                     [&](auto, auto, const auto& facet, const auto& midpoints) {
                                         return pieces_of(facet, midpoints, mesh.points);
                                     }),
                            part.mesh.facets, part.mesh.facet_ancestors);
    part.edge_after =
        take(ListCoarsening<EdgeIndex, 2>(levels, kept)
                 .run(mesh.edges, [](auto, auto, const auto& edge,
                                     const auto& midpoint) { return pieces_of(edge, midpoint); }),
             part.mesh.edges, part.mesh.edge_ancestors);
    part.mesh.interfaces = coarser_interfaces(mesh.interfaces, levels, kept);
    for (Interface& interface : part.mesh.interfaces) {
        renumber(interface.edges, number_after);
        renumber(interface.faces, number_after);
    }
    return part;
}

void drop_empty_levels(CoarserPart& part) {
    const Communicator& processes = part.mesh.processes;
    LocalFailure failure;
    std::vector<std::uint64_t> has_any;
    auto& begins = part.mesh.level_begin;
    failure.attempt([&] {
        for (std::size_t t = 0; t < begins.size(); ++t) {
            const VertexIndex end =
                t + 1 < begins.size() ? begins[t + 1] : part.mesh.points.end_index();
            has_any.push_back(begins[t] < end ? 1 : 0);
        }
    });
    failure.agree(processes);
    processes.max(has_any);
    const bool any_failed =
        processes.max(std::ranges::any_of(part.failures, &RoundingFailure::found) ? 1 : 0) != 0;
    std::size_t left = 0;
    for (std::size_t t = 0; t < begins.size(); ++t) {
        if (has_any[t] == 0) continue;
        begins[left++] = begins[t];
        if (any_failed) part.failures[t].agree(part.mesh, static_cast<int>(left));
    }
    begins.resize(left);
}

}  // namespace octetra::distributed
