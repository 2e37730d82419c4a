#include "history/collapse.hpp"

#include <span>

namespace octetra::distributed {
namespace {

/// A corner stays at its position in every child that has it, so what is older than the step is a
/// corner of the parent.
CellVertices parent_of(std::span<const CellVertices> children, VertexIndex first_midpoint) {
    CellVertices parent;
    for (const CellVertices& child : children) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (child[k] < first_midpoint) parent[k] = child[k];
        }
    }
    return parent;
}

std::array<VertexIndex, 6> midpoints_of(std::span<const CellVertices> children,
                                        const Pattern& pattern) {
    std::array<VertexIndex, 6> midpoints;
    for (std::size_t i = 0; i < children.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Place place = pattern.children[i][k];
            if (place >= 4) midpoints[place - 4U] = children[i][k];
        }
    }
    return midpoints;
}

}  // namespace

CollapsedStep collapse(const IndexVector<CellIndex, CellVertices>& cells, const CutRuns& step,
                       VertexIndex first_midpoint, const IndexVector<VertexIndex, Point>& points) {
    CollapsedStep collapsed;
    auto next = cells.begin();
    for_each_run(step, [&](Cut cut, std::uint64_t count) {
        if (cut == 0) {
            const auto end = next + static_cast<std::ptrdiff_t>(count);
            collapsed.cells.insert(collapsed.cells.end(), next, end);
            next = end;
            return;
        }
        for (; count > 0; --count) {
            const std::span children(next, child_count_of(cut));
            next += static_cast<std::ptrdiff_t>(children.size());
            const CellVertices parent = parent_of(children, first_midpoint);
            const LengthOrder order = length_order(points, parent);
            const Pattern& pattern = PatternTable::get().pattern(order, edges_of(cut));
            collapsed.cut.push_back(
                {collapsed.cells.append(parent), cut, order, midpoints_of(children, pattern)});
        }
    });
    return collapsed;
}

}  // namespace octetra::distributed
