#include "dense_level.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <octetra/distributed/profile.hpp>

#include "huge_pages.hpp"
#include "interfaces.hpp"
#include "midpoints.hpp"
#include "rounding_margin.hpp"
#include "triangle.hpp"

namespace octetra::distributed {
namespace {

constexpr std::size_t most_children = 8;

class CellBisection {
public:
    CellBisection(DistributedMesh& mesh, const EdgeStars& stars, CellOrders& orders,
                  const IndexVector<CellIndex, EdgeMask>& selected,
                  const IndexVector<EdgeIndex, VertexIndex>& midpoints)
        : mesh_(&mesh),
          stars_(&stars),
          orders_(&orders),
          selected_(&selected),
          midpoints_(&midpoints) {}

    /// Replaces the cells by their children, so many in all.
    [[nodiscard]] RoundingFailure run(std::size_t child_count) {
        reserve_in_huge_pages(children_, child_count);
        Lineage& lineage = mesh_->cell_lineage;
        for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
            const CellIndex end{lineage.first[r + 1]};
            CellIndex c{lineage.first[r]};
            lineage.first[r] = static_cast<std::uint32_t>(children_.size() + written_);
            for (; c < end; ++c) {
                if (c == block_end_) begin_block();
                bisect(c, lineage.roots[r]);
            }
        }
        append_written();
        lineage.first.back() = children_.end_index().value();
        mesh_->cells = std::move(children_);
        return failure_;
    }

private:
    static constexpr std::size_t block_size = 64;

    /// Of the next 64 cells all patterns, and then all rounding margins: a processor works on
    /// several cells at once as long as it does the same with them.
    void begin_block() {
        append_written();
        std::array<CellIndex, block_size> touched;
        std::size_t touched_count = 0;
        const std::size_t end = std::min(mesh_->cells.size(), block_end_.value() + block_size);
        for (; block_end_ < CellIndex{end}; ++block_end_) {
            touched[touched_count] = block_end_;
            touched_count += (*selected_)[block_end_] != 0 ? 1U : 0U;
        }
        const auto all_touched = std::span(touched).first(touched_count);
        for (const CellIndex c : all_touched) {
            patterns_[place_of(c)] = &table_->pattern(orders_->of(c), (*selected_)[c]);
        }
        for (const CellIndex c : all_touched) {
            is_safe_[place_of(c)] = has_rounding_margin(mesh_->points, mesh_->cells[c]);
        }
    }
    static std::size_t place_of(CellIndex cell) { return cell.value() % block_size; }

    void append_written() {
        children_.insert(children_.end(), block_.begin(),
                         block_.begin() + static_cast<std::ptrdiff_t>(written_));
        written_ = 0;
    }

    void bisect(CellIndex c, std::uint64_t root) {
        const CellVertices& cell = mesh_->cells[c];
        if ((*selected_)[c] == 0) {
            block_[written_++] = cell;
            return;
        }
        const Pattern& pattern = *patterns_[place_of(c)];
        std::array<VertexIndex, 10> vertices;  // by place
        std::ranges::copy(cell, vertices.begin());
        const auto& edges = stars_->edges_of(c);
        for (std::size_t e = 0; e < 6; ++e) vertices[4 + e] = (*midpoints_)[edges[e]];
        // Always eight, as to write what is not needed takes less time than to foresee their
        // number.
        CellVertices* const children = block_.data() + written_;
        for (std::size_t k = 0; k < most_children; ++k) {
            children[k] = child_of(vertices, pattern.children[k]);
        }
        const std::size_t count = pattern.child_count;
        if (!is_safe_[place_of(c)]) check({children, count}, root);
        written_ += count;
    }

    void check(std::span<const CellVertices> children, std::uint64_t root) {
        for (const CellVertices& child : children) {
            if (failure_.found()) return;
            const int sign = sign_of(child, mesh_->points);
            if (sign <= 0) failure_.note(root, sign);
        }
    }

    DistributedMesh* mesh_;
    const EdgeStars* stars_;
    CellOrders* orders_;
    const IndexVector<CellIndex, EdgeMask>* selected_;
    const IndexVector<EdgeIndex, VertexIndex>* midpoints_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<CellIndex, CellVertices> children_;
    RoundingFailure failure_;

    CellIndex block_end_{0};  ///< blocks begin at multiples of their size
    std::array<const Pattern*, block_size> patterns_{};
    std::array<bool, block_size> is_safe_{};
    /// Children yet to be appended: to copy at once what was just written takes longer.
    std::array<CellVertices, block_size * most_children> block_;
    std::size_t written_ = 0;
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

}  // namespace

DenseLevel::DenseLevel(DistributedMesh& mesh, const ChosenCells& chosen)
    : mesh_(&mesh),
      edges_(in_phase(mesh.processes, "number edges", [&] { return NearEdges(mesh, chosen); })),
      orders_(mesh),
      closure_(edges_, orders_, mesh.interfaces) {}

void DenseLevel::select(const ChosenCells& chosen, Scheme scheme) {
    if (chosen.all && scheme == Scheme::eight) {
        closure_.select_all();
    } else if (chosen.all) {
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) select(c, scheme);
    } else {
        for (const CellIndex c : chosen.cells) select(c, scheme);
    }
}

void DenseLevel::select(CellIndex cell, Scheme scheme) {
    const EdgeMask mask = selected_by(scheme, orders_.of(cell));
    const auto edges = stars_->edges_of(cell);
    for (std::size_t e = 0; e < 6; ++e) {
        if ((mask >> e & 1U) != 0) closure_.select(edges[e]);
    }
}

void DenseLevel::bisect_edges() {
    midpoints_ = distributed::bisect_edges(*mesh_, *stars_, closure_);
}

std::size_t DenseLevel::cell_count_afterwards() {
    const std::size_t cell_count = mesh_->cells.size();
    if (closure_.all_selected()) {
        selected_.assign(cell_count, all_edges);
        return most_children * cell_count;
    }
    selected_.assign(cell_count, 0);
    std::size_t count = cell_count - stars_->cell_count();  // none of the others' edges is selected
    for (std::size_t k = 0; k < stars_->cell_count(); ++k) {
        const CellIndex c = stars_->cell_at(k);
        const EdgeMask selected = closure_.selected_of(c);
        selected_[c] = selected;
        // These need no order.
        if (selected == 0) {
            ++count;
        } else if (selected == all_edges) {
            count += most_children;
        } else {
            count += PatternTable::get().pattern(orders_.of(c), selected).child_count;
        }
    }
    return count;
}

RoundingFailure DenseLevel::bisect_cells(std::size_t cell_count) {
    return CellBisection(*mesh_, *stars_, orders_, selected_, midpoints_).run(cell_count);
}

void DenseLevel::bisect_listed() {
    DistributedMesh& mesh = *mesh_;
    replace_by_pieces(mesh.facets, mesh.facet_lineage, [&](const FacetVertices& facet, auto& all) {
        const BisectedTriangle bisected =
            bisect_triangle(facet, midpoints_of(facet, *stars_, midpoints_), mesh.points);
        std::copy_n(bisected.pieces.begin(), bisected.piece_count, std::back_inserter(all));
    });
    replace_by_pieces(mesh.edges, mesh.edge_lineage, [&](const EdgeVertices& edge, auto& all) {
        // Which half comes first is a matter of the end points' positions in the list.
        const VertexIndex midpoint = midpoints_[stars_->find(edge[0], edge[1])];
        if (midpoint.is_none()) {
            all.append(edge);
        } else {
            all.append({edge[0], midpoint});
            all.append({midpoint, edge[1]});
        }
    });
}

void DenseLevel::bisect_interfaces() {
    distributed::bisect_interfaces(mesh_->interfaces, mesh_->points, *stars_, midpoints_);
}

}  // namespace octetra::distributed
