#include "refine_level.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/profile.hpp>

#include "closure.hpp"
#include "edge_stars.hpp"
#include "interfaces.hpp"
#include "length_order.hpp"
#include "midpoints.hpp"
#include "patterns.hpp"
#include "synchronise.hpp"
#include "triangle.hpp"

namespace octetra::distributed {
namespace {

IndexVector<CellIndex, LengthOrder> length_orders(const DistributedMesh& mesh) {
    IndexVector<CellIndex, LengthOrder> orders;
    orders.reserve(mesh.cells.size());
    for (const CellVertices& cell : mesh.cells) orders.push_back(length_order(mesh.points, cell));
    return orders;
}

EdgeMask selected_by(Scheme scheme, LengthOrder order) {
    const PatternTable& table = PatternTable::get();
    switch (scheme) {
        case Scheme::eight: return 0b111111;
        case Scheme::four: return table.face_longest_edges(order);
        case Scheme::two: return static_cast<EdgeMask>(1U << table.longest_edge(order));
    }
    return 0;
}

void select_chosen(const DistributedMesh& mesh, const Selection& selection, Scheme scheme,
                   const EdgeStars& stars, const IndexVector<CellIndex, LengthOrder>& orders,
                   Closure& closure) {
    const Lineage& lineage = mesh.cell_lineage;
    for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
        const GlobalCell root{lineage.roots[r]};
        const Marker region = lineage.markers.empty() ? 0 : lineage.markers[r];
        for (CellIndex c{lineage.first[r]}; c < CellIndex{lineage.first[r + 1]}; ++c) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
            if (!chooses(selection, corners, region, root)) continue;
            const EdgeMask mask = selected_by(scheme, orders[c]);
            for (std::size_t e = 0; e < 6; ++e) {
                if ((mask >> e & 1U) != 0) closure.select(stars.edges_of(c)[e]);
            }
        }
    }
}

/// A cell that cannot be bisected because its midpoints are rounded: the first one in canonical
/// order, as a number that is the smaller the earlier the cell comes.
class RoundingFailure {
public:
    void note(std::uint64_t root, int sign) {
        code_ = std::min(code_, 2 * root + (sign < 0 ? 1U : 0U));
        found_root_ = true;
    }
    [[nodiscard]] bool found() const { return found_root_; }

    /// Collective. Throws on all processes if any has found one.
    void agree(const DistributedMesh& mesh, int level) const {
        // The least of all, as there is a maximum at hand.
        const std::uint64_t first = none - mesh.processes.max(none - code_);
        if (first == none) return;
        throw InputError(fmt::format(
            "cell {}, level {}: bisection would make a child that is {}, because its midpoints "
            "cannot be rounded to double precision well enough; the cell is too small for its "
            "coordinates",
            first / 2 + mesh.first_number, level, first % 2 == 1 ? "inverted" : "flat"));
    }

private:
    static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t code_ = none;
    bool found_root_ = false;
};

/// Collective. Throws on all processes if any would have more entities than 32 bits number.
void check_countable(const DistributedMesh& mesh, std::size_t count, const char* what) {
    if (mesh.processes.max(count) >= VertexIndex::limit) {
        throw InputError(fmt::format("the refined mesh would have more than {} {} on one process",
                                     VertexIndex::limit, what));
    }
}

class CellBisection {
public:
    CellBisection(DistributedMesh& mesh, const EdgeStars& stars,
                  const IndexVector<CellIndex, LengthOrder>& orders, const Closure& closure,
                  const Midpoints& midpoints, VertexIndex first_midpoint)
        : mesh_(&mesh),
          stars_(&stars),
          orders_(&orders),
          closure_(&closure),
          midpoints_(&midpoints),
          first_midpoint_(first_midpoint) {}

    /// Collective. Replaces the cells by their children.
    void run(int level) {
        std::size_t child_count = 0;
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            child_count += pattern_of(c).child_count;
        }
        check_countable(*mesh_, child_count, "cells");
        children_.resize(child_count);

        Lineage& lineage = mesh_->cell_lineage;
        for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
            const CellIndex end{lineage.first[r + 1]};
            CellIndex c{lineage.first[r]};
            lineage.first[r] = next_.value();
            for (; c < end; ++c) bisect(c, lineage.roots[r]);
        }
        lineage.first.back() = next_.value();
        failure_.agree(*mesh_, level);
        mesh_->cells = std::move(children_);
    }

private:
    [[nodiscard]] const Pattern& pattern_of(CellIndex cell) const {
        return table_->pattern((*orders_)[cell], closure_->selected_of(cell));
    }

    void bisect(CellIndex c, std::uint64_t root) {
        const Pattern& pattern = pattern_of(c);
        const CellVertices& cell = mesh_->cells[c];
        std::array<VertexIndex, 10> vertices;  // by place
        bool rounded = false;
        std::ranges::copy(cell, vertices.begin());
        for (std::size_t e = 0; e < 6; ++e) {
            const VertexIndex m = midpoints_->of_edge[stars_->edges_of(c)[e]];
            vertices[4 + e] = m;
            rounded = rounded ||
                      (!m.is_none() && midpoints_->rounded[m.value() - first_midpoint_.value()]);
        }
        for (std::size_t k = 0; k < pattern.child_count; ++k) {
            CellVertices child;
            for (std::size_t i = 0; i < 4; ++i) child[i] = vertices[pattern.children[k][i]];
            if (rounded) check(child, root);
            children_[next_] = child;
            ++next_;
        }
    }

    void check(const CellVertices& child, std::uint64_t root) {
        if (failure_.found()) return;
        const auto& p = mesh_->points;
        const bool finite =
            std::ranges::all_of(child, [&](VertexIndex v) { return is_finite(p[v]); });
        const int sign =
            finite ? orientation(p[child[0]], p[child[1]], p[child[2]], p[child[3]]) : 0;
        if (sign <= 0) failure_.note(root, sign);
    }

    DistributedMesh* mesh_;
    const EdgeStars* stars_;
    const IndexVector<CellIndex, LengthOrder>* orders_;
    const Closure* closure_;
    const Midpoints* midpoints_;
    VertexIndex first_midpoint_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<CellIndex, CellVertices> children_;
    CellIndex next_{0};
    RoundingFailure failure_;
};

/// Replaces the entities of a list by their pieces: append_pieces(entity, pieces) for each, in
/// order.
template <class I, class Vertices>
void replace_by_pieces(IndexVector<I, Vertices>& list, Lineage& lineage, auto&& append_pieces) {
    IndexVector<I, Vertices> pieces;
    for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
        const I end{lineage.first[r + 1]};
        I i{lineage.first[r]};
        lineage.first[r] = pieces.end_index().value();
        for (; i < end; ++i) append_pieces(list[i], pieces);
    }
    lineage.first.back() = pieces.end_index().value();
    list = std::move(pieces);
}

void bisect_listed(DistributedMesh& mesh, const EdgeStars& stars, const Midpoints& midpoints) {
    replace_by_pieces(mesh.facets, mesh.facet_lineage, [&](const FacetVertices& facet, auto& all) {
        const BisectedTriangle bisected =
            bisect_triangle(facet, mesh.points, stars, midpoints.of_edge);
        std::copy_n(bisected.pieces.begin(), bisected.piece_count, std::back_inserter(all));
    });
    replace_by_pieces(mesh.edges, mesh.edge_lineage, [&](const EdgeVertices& edge, auto& all) {
        // Which half comes first is a matter of the end points' positions in the list.
        const VertexIndex midpoint = midpoints.of_edge[stars.find(edge[0], edge[1])];
        if (midpoint.is_none()) {
            all.append(edge);
        } else {
            all.append({edge[0], midpoint});
            all.append({midpoint, edge[1]});
        }
    });
}

}  // namespace

LevelOutcome refine_level(DistributedMesh& mesh, const Selection& selection,
                          const RefineOptions& options, int level) {
    const Communicator& processes = mesh.processes;
    const auto stars = in_phase(processes, "number edges",
                                [&] { return EdgeStars(mesh.points.size(), mesh.cells); });
    const auto orders = in_phase(processes, "order edges", [&] { return length_orders(mesh); });
    auto closure = in_phase(processes, "select", [&] {
        Closure chosen(stars, orders, mesh.interfaces);
        select_chosen(mesh, selection, options.scheme, stars, orders, chosen);
        return chosen;
    });
    const auto counts = in_phase(processes, "synchronise", [&] {
        return options.synchronisation == Synchronisation::neighbour
                   ? synchronise_by_neighbours(closure, mesh)
                   : synchronise_by_gateway(closure, mesh);
    });

    if (processes.max(closure.selected_count()) == 0) return {.counts = counts};

    check_countable(mesh, mesh.points.size() + closure.selected_count(), "vertices");
    const VertexIndex first_midpoint = mesh.points.end_index();
    const auto midpoints =
        in_phase(processes, "bisect edges", [&] { return bisect_edges(mesh, stars, closure); });
    {
        const Phase phase(processes, "bisect tetrahedra");
        CellBisection(mesh, stars, orders, closure, midpoints, first_midpoint).run(level);
        bisect_listed(mesh, stars, midpoints);
    }
    const Phase phase(processes, "interfaces");
    mesh.interfaces = refined_interfaces(mesh.interfaces, mesh.points, stars, midpoints.of_edge);
    return {.counts = counts, .changed = true};
}

}  // namespace octetra::distributed
