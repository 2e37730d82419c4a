#include "regular/regular_step.hpp"

#include <algorithm>
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

using Edges = std::vector<EdgeVertices>;  // lower end first; ascending

/// Calls f for each edge of the mask.
void for_each_edge(const CellVertices& cell, EdgeMask mask, auto&& f) {
    for (std::size_t e = 0; e < 6; ++e) {
        if ((unsigned{mask} >> e & 1U) == 0) continue;
        const auto& [low, high] = std::minmax(cell[cell_edges[e][0]], cell[cell_edges[e][1]]);
        f(EdgeVertices{low, high});
    }
}

/// The marked edges that are not bisected yet, by generation.
class PendingEdges {
public:
    explicit PendingEdges(const Communicator& processes) : processes_(processes) {}

    void add(std::uint32_t generation, Edges edges) {
        if (edges.empty()) return;
        if (lists_.size() <= generation) lists_.resize(generation + std::size_t{1});
        Edges& list = lists_[generation];
        list.insert(list.end(), edges.begin(), edges.end());
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    [[nodiscard]] const Edges& of(std::uint32_t generation) const {
        static const Edges none;
        return generation < lists_.size() ? lists_[generation] : none;
    }
    void clear(std::uint32_t generation) {
        if (generation < lists_.size()) lists_[generation].clear();
    }

    /// Collective. Returns the greatest generation below `limit` of which any process has edges.
    [[nodiscard]] std::optional<std::uint32_t> greatest_below(std::size_t limit) const {
        std::size_t next = std::min(limit, lists_.size());
        while (next > 0 && lists_[next - 1].empty()) --next;
        const std::uint64_t greatest = processes_.max(next);
        if (greatest == 0) return std::nullopt;
        return static_cast<std::uint32_t>(greatest - 1);
    }
    /// Collective. Returns the least generation of which any process has edges.
    [[nodiscard]] std::optional<std::uint32_t> least() const {
        constexpr std::uint64_t complement = std::numeric_limits<std::uint32_t>::max();
        const auto first = std::ranges::find_if(lists_, [](auto& list) { return !list.empty(); });
        const bool has_any = first != lists_.end();
        const auto own = static_cast<std::uint64_t>(first - lists_.begin());
        const std::uint64_t least = processes_.max(has_any ? complement - own : 0);
        if (least == 0) return std::nullopt;
        return static_cast<std::uint32_t>(complement - least);
    }

private:
    Communicator processes_;
    std::vector<Edges> lists_;
};

class RegularRefinement {
public:
    RegularRefinement(const DistributedMesh& mesh, const RefineOptions& options)
        : processes_(mesh.processes),
          options_(options),
          vertex_count_before_(mesh.points.size()),
          step_(unchanged(mesh)),
          pending_(mesh.processes),
          cells_(transition_cells_of(step_.mesh)) {
        options_.max_cells = std::numeric_limits<std::uint64_t>::max();  // until the last level
    }
    RegularRefinement(const RegularRefinement&) = delete;
    RegularRefinement& operator=(const RegularRefinement&) = delete;
    RegularRefinement(RegularRefinement&&) = delete;
    RegularRefinement& operator=(RegularRefinement&&) = delete;
    ~RegularRefinement() = default;

    void mark(const MarkedCells& marked) {
        std::vector<Edges> edges;
        const auto add = [&](std::uint32_t generation, CellIndex c, EdgeMask mask) {
            if (edges.size() <= generation) edges.resize(generation + std::size_t{1});
            for_each_edge(mesh().cells[c], mask,
                          [&](const EdgeVertices& edge) { edges[generation].push_back(edge); });
        };
        for (const CellIndex c : marked.cells) {
            const std::uint32_t generation = cells_.generation_of(mesh().cells[c]);
            if (!cells_.contains(c)) {
                add(generation, c, all_edges);
                continue;
            }
            const auto family = cells_.family_of(c);
            for (CellIndex sibling = family.begin; sibling < family.end; ++sibling) {
                add(generation - 1, sibling, cells_.edges_of_parent(sibling));
            }
            if (is_one_of_eight(c, family, generation - 1)) add(generation, c, all_edges);
        }
        for (std::uint32_t g = 0; g < edges.size(); ++g) pending_.add(g, std::move(edges[g]));
    }

    /// Collective.
    void run(std::uint64_t max_cells) {
        auto generation = pending_.greatest_below(std::numeric_limits<std::size_t>::max());
        while (generation) {
            PlannedLevel plan = close(*generation);
            const auto lower = pending_.greatest_below(*generation);
            if (lower) {
                generation = lower;
                continue;
            }
            bisect(std::move(plan), *generation);
            check_allowed(max_cells);
            generation = pending_.least();
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

    /// Returns the cells with an edge of the list, each with its edges in the list.
    [[nodiscard]] MarkedCells cells_with(const Edges& edges) {
        MarkedCells marked;
        IndexVector<VertexIndex, std::uint8_t> is_end;
        is_end.assign(mesh().points.size(), 0);
        for (const auto& [a, b] : edges) is_end[a] = is_end[b] = 1;
        for (CellIndex c{0}; !edges.empty() && c < mesh().cells.end_index(); ++c) {
            const auto& [p, q, r, s] = mesh().cells[c];
            if (is_end[p] + is_end[q] + is_end[r] + is_end[s] < 2) continue;
            unsigned mask = 0;
            std::size_t e = 0;
            for_each_edge(mesh().cells[c], all_edges, [&](const EdgeVertices& edge) {
                if (std::ranges::binary_search(edges, edge)) mask |= 1U << e;
                ++e;
            });
            if (mask == 0) continue;
            marked.cells.push_back(c);
            marked.edges.push_back(static_cast<EdgeMask>(mask));
        }
        marked.count = marked.cells.size();
        return marked;
    }

    /// Collective. Closes the marked edges of a generation, and marks the edges of parents that
    /// must be completed.
    PlannedLevel close(std::uint32_t generation) {
        const auto mark_cells = [&] { return cells_with(pending_.of(generation)); };
        PlannedLevel plan = close_level(mesh(), mark_cells, options_, Tuning{}, &cells_);
        step_.counts += plan.counts;
        closed_ = plan.level->closed_marks();
        Edges edges;
        Edges of_parents;
        for (std::size_t k = 0; k < closed_.cells.size(); ++k) {
            const CellIndex c = closed_.cells[k];
            for_each_edge(mesh().cells[c], closed_.edges[k],
                          [&](const EdgeVertices& edge) { edges.push_back(edge); });
            if (!cells_.contains(c)) continue;
            if ((closed_.edges[k] & ~unsigned{cells_.edges_of_parent(c)}) == 0) continue;
            const auto family = cells_.family_of(c);
            for (CellIndex sibling = family.begin; sibling < family.end; ++sibling) {
                for_each_edge(mesh().cells[sibling], cells_.edges_of_parent(sibling),
                              [&](const EdgeVertices& edge) { of_parents.push_back(edge); });
            }
        }
        pending_.add(generation, std::move(edges));
        if (!of_parents.empty()) pending_.add(generation - 1, std::move(of_parents));
        return plan;
    }

    /// Collective. Bisects the edges of a generation, as closed last.
    void bisect(PlannedLevel plan, std::uint32_t generation) {
        bisect_level(plan, mesh(), options_, static_cast<int>(generation) + 1);
        const ListChanges changes = plan.changes();
        plan.commit();
        pending_.clear(generation);
        step_.cells.append(changes.cells);
        step_.facets.append(changes.facets);
        step_.edges.append(changes.edges);

        std::vector<EdgeMask> marked(changes.cells.count_before(), 0);
        for (std::size_t k = 0; k < closed_.cells.size(); ++k) {
            marked[closed_.cells[k].value()] = closed_.edges[k];
        }
        std::vector<std::uint32_t> first(marked.size() + 1, 0);
        changes.cells.for_each_new([&](std::size_t number, std::size_t before, unsigned) {
            first[before + 1] = static_cast<std::uint32_t>(number + 1);
        });
        cells_.add_midpoints(generation);
        cells_.set_kinds(order_families(mesh(), step_.cells, cells_, {first, marked, generation}));
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
    MarkedCells closed_;  // of the generation that was closed last
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
