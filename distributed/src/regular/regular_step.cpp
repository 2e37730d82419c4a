#include "regular/regular_step.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>

#include "level/planned_level.hpp"
#include "pattern/length_order.hpp"
#include "regular/family_order.hpp"
#include "regular/generation_order.hpp"
#include "regular/pending_edges.hpp"
#include "regular/transition_cells_of.hpp"

namespace octetra::distributed {
namespace {

/// Returns a copy of a part in canonical order.
DistributedMesh copy_of(const DistributedMesh& mesh) {
    DistributedMesh copy;
    copy.processes = mesh.processes;
    copy.points = mesh.points;
    copy.attributes_per_point = mesh.attributes_per_point;
    copy.point_attributes = mesh.point_attributes;
    copy.input_vertices = mesh.input_vertices;
    copy.input_vertex_markers = mesh.input_vertex_markers;
    copy.level_begin = mesh.level_begin;
    copy.midpoint_to_edge = mesh.midpoint_to_edge;
    copy.midpoint_markers = mesh.midpoint_markers;
    copy.cells = mesh.cells;
    copy.cell_ancestors = mesh.cell_ancestors;
    copy.facets = mesh.facets;
    copy.facet_ancestors = mesh.facet_ancestors;
    copy.edges = mesh.edges;
    copy.edge_ancestors = mesh.edge_ancestors;
    copy.interfaces = mesh.interfaces;
    copy.input_vertex_count = mesh.input_vertex_count;
    copy.input_cell_count = mesh.input_cell_count;
    copy.index_base = mesh.index_base;
    copy.group_names = mesh.group_names;
    copy.closure = mesh.closure;
    copy.features = mesh.features;
    return copy;
}

RegularStep unchanged(const DistributedMesh& mesh) {
    return {.changes_anything = false,
            .mesh = copy_of(mesh),
            .cells = Descent(mesh.cells.size()),
            .facets = Descent(mesh.facets.size()),
            .edges = Descent(mesh.edges.size()),
            .vertices_before = {},
            .new_vertex_ends = {},
            .counts = {}};
}

class RegularRefinement {
public:
    RegularRefinement(const DistributedMesh& mesh, const RefineOptions& options)
        : processes_(mesh.processes),
          options_(options),
          vertex_count_before_(mesh.points.size()),
          step_(unchanged(mesh)),
          pending_(mesh.processes, mesh.cells.size()),
          cells_(transition_cells_of(step_.mesh)) {
        options_.max_cells = std::numeric_limits<std::uint64_t>::max();  // until the last level
    }
    RegularRefinement(const RegularRefinement&) = delete;
    RegularRefinement& operator=(const RegularRefinement&) = delete;
    RegularRefinement(RegularRefinement&&) = delete;
    RegularRefinement& operator=(RegularRefinement&&) = delete;
    ~RegularRefinement() = default;

    void mark(const MarkedCells& marked) {
        for (const CellIndex c : marked.cells) {
            if (!cells_.contains(c)) {
                pending_.add_open(c, all_edges);
                continue;
            }
            const auto family = cells_.family_of(c);
            complete(family);
            const std::uint32_t of_parent = cells_.generation_of(c) - 1;
            if (is_one_of_eight(c, family, of_parent)) pending_.add_open(c, all_edges);
        }
    }

    /// Collective.
    void run(std::uint64_t max_cells) {
        constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
        auto generation = pending_.greatest_below(no_limit, cells_);
        while (generation) {
            close(*generation);
            const auto lower = pending_.greatest_below(*generation, cells_);
            if (lower) {
                generation = lower;
                continue;
            }
            bisect(*generation);
            check_allowed(max_cells);
            generation = pending_.least(cells_);
        }
    }

    /// Collective.
    [[nodiscard]] RegularStep finish() && {
        const auto after = order_by_generation(mesh(), cells_.generations());
        step_.changes_anything = true;
        step_.vertices_before.resize(after.size(), VertexIndex::none());
        for (VertexIndex v{0}; v < VertexIndex{vertex_count_before_}; ++v) {
            step_.vertices_before[after[v].value()] = v;
        }
        for (std::size_t v = 0; v < step_.vertices_before.size(); ++v) {
            if (!step_.vertices_before[v].is_none()) continue;
            step_.new_vertex_ends.push_back(
                mesh().midpoint_to_edge[v - mesh().input_vertices.size()]);
        }
        return std::move(step_);
    }

private:
    [[nodiscard]] DistributedMesh& mesh() { return step_.mesh; }

    /// Returns whether a transition cell is one of the children that its parent has if all its
    /// edges are bisected.
    [[nodiscard]] bool is_one_of_eight(CellIndex cell, TransitionCells::Family family,
                                       std::uint32_t generation) {
        const DividedCell parent(mesh(), cells_, family, generation);
        const LengthOrder order = length_order(mesh().points, parent.corners());
        const Pattern& pattern = PatternTable::get().pattern(order, all_edges);
        return std::ranges::any_of(pattern.children, [&](const auto& places) {
            return std::ranges::is_permutation(child_of(parent.vertices, places),
                                               mesh().cells[cell]);
        });
    }

    /// Marks the edges of a family's parent that are not bisected.
    void complete(TransitionCells::Family family) {
        for (CellIndex sibling = family.begin; sibling < family.end; ++sibling) {
            pending_.add_open(sibling, cells_.edges_of_parent(sibling));
        }
    }

    /// Collective. Closes the marked edges of a generation, and marks the edges of parents that
    /// must be completed. Edges that were closed before require no others: the closure of a set is
    /// the union of the closures of its edges.
    void close(std::uint32_t generation) {
        const auto mark_cells = [&] { return pending_.take_open(generation, cells_); };
        PlannedLevel plan = close_level(mesh(), mark_cells, options_, Tuning{}, &cells_);
        if (!plan.changes_anything()) return;
        step_.counts += plan.counts;
        const MarkedCells closed = plan.level->closed_marks();
        for (std::size_t k = 0; k < closed.cells.size(); ++k) {
            const CellIndex c = closed.cells[k];
            pending_.add(c, closed.edges[k]);
            if (!cells_.contains(c)) continue;
            const bool is_finer = (closed.edges[k] & ~unsigned{cells_.edges_of_parent(c)}) != 0;
            if (is_finer) complete(cells_.family_of(c));
        }
    }

    /// Collective. Bisects the closed edges of a generation.
    void bisect(std::uint32_t generation) {
        const auto mark_cells = [&] { return pending_.of_generation(generation, cells_); };
        PlannedLevel plan = close_level(mesh(), mark_cells, options_, Tuning{}, &cells_);
        const MarkedCells closed = plan.level->closed_marks();
        bisect_level(plan, mesh(), options_, static_cast<int>(generation) + 1);
        const ListChanges changes = plan.changes();
        const IndexVector<CellIndex, CellVertices> before = mesh().cells;
        plan.commit();
        step_.cells.append(changes.cells);
        step_.facets.append(changes.facets);
        step_.edges.append(changes.edges);

        IndexVector<CellIndex, EdgeMask> marked;
        marked.assign(before.size(), 0);
        for (std::size_t k = 0; k < closed.cells.size(); ++k) {
            marked[closed.cells[k]] = closed.edges[k];
        }
        std::vector<std::uint32_t> first(marked.size() + 1, 0);
        changes.cells.for_each_new([&](std::size_t number, std::size_t parent, unsigned) {
            first[parent + 1] = static_cast<std::uint32_t>(number + 1);
        });
        cells_.add_midpoints(generation);
        auto kinds = order_families(mesh(), step_.cells, cells_, {first, marked, generation});
        keep_pending(before, first, marked);
        cells_.set_kinds(std::move(kinds));
    }

    /// Transfers the marks of edges that the level did not bisect to the cells after it. An edge of
    /// a bisected transition cell is an edge of some piece of its family.
    void keep_pending(const IndexVector<CellIndex, CellVertices>& before,
                      const std::vector<std::uint32_t>& first,
                      const IndexVector<CellIndex, EdgeMask>& bisected) {
        PendingEdges after(processes_, mesh().cells.size());
        for (CellIndex c{0}; c < before.end_index(); ++c) {
            const unsigned edges = pending_.of(c) & ~unsigned{bisected[c]};
            if (edges == 0) continue;
            const auto family = cells_.contains(c)
                                    ? cells_.family_of(c)
                                    : TransitionCells::Family{c, CellIndex{c.value() + 1U}};
            const CellIndex end{first[family.end.value()]};
            // The faces of new cells may require further edges.
            const bool is_new = end.value() - first[family.begin.value()] >
                                family.end.value() - family.begin.value();
            for (CellIndex piece{first[family.begin.value()]}; piece < end; ++piece) {
                const auto in_piece = [&](unsigned of_cell) {
                    return common_edges(mesh().cells[piece], before[c], of_cell & edges);
                };
                after.add_open(piece, in_piece(is_new ? all_edges : pending_.open_of(c)));
                after.add(piece, in_piece(all_edges));
            }
        }
        pending_ = std::move(after);
    }
    /// Returns the edges of a cell that are among these edges of another.
    static unsigned common_edges(const CellVertices& cell, const CellVertices& other,
                                 unsigned edges) {
        unsigned common = 0;
        for (std::size_t e = 0; e < 6; ++e) {
            const std::array ends{cell[cell_edges[e][0]], cell[cell_edges[e][1]]};
            for (std::size_t f = 0; f < 6; ++f) {
                if ((edges >> f & 1U) == 0) continue;
                const std::array of_other{other[cell_edges[f][0]], other[cell_edges[f][1]]};
                if (std::ranges::is_permutation(ends, of_other)) common |= 1U << e;
            }
        }
        return common;
    }

    /// Collective.
    void check_allowed(std::uint64_t max_cells) {
        if (max_cells == std::numeric_limits<std::uint64_t>::max()) return;
        if (processes_.sum(mesh().cells.size()) <= max_cells) return;
        throw InputError(fmt::format(
            "the step would make more than the {} cells allowed: mark fewer cells, or allow more",
            max_cells));
    }

    Communicator processes_;
    RefineOptions options_;
    std::size_t vertex_count_before_;
    RegularStep step_;
    PendingEdges pending_;
    TransitionCells cells_;
};

}  // namespace

RegularStep regular_step(const DistributedMesh& mesh, const MarkedCells& marked,
                         const RefineOptions& options) {
    if (mesh.processes.max(marked.cells.empty() ? 0 : 1) == 0) return {};
    RegularRefinement refinement(mesh, options);
    refinement.mark(marked);
    refinement.run(options.max_cells);
    return std::move(refinement).finish();
}

}  // namespace octetra::distributed
