#include "request/requested_refinement.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>

#include "parts/exchange.hpp"

namespace octetra::verify {

std::vector<DescendantCell> RequestedRefinement::coarse_cells() const {
    std::vector<DescendantCell> cells;
    const auto& coarse_cells = coarse_.mesh.cells;
    cells.reserve(coarse_cells.size());
    for (CellIndex c{0}; c < coarse_cells.end_index(); ++c) {
        CellVertices corners = coarse_cells[c];
        for (VertexIndex& v : corners) v = descent_.coarse_to_fine[v];
        cells.push_back({corners, c});
    }
    return cells;
}

std::vector<std::uint8_t> RequestedRefinement::marks_of(
    std::span<const DescendantCell> cells) const {
    const auto cell_to_test = [&](std::size_t i) {
        CellToTest cell;
        for (std::size_t k = 0; k < 4; ++k) {
            cell.corners[k] = fine_.mesh.points[cells[i].vertices[k]];
        }
        const CellIndex root = cells[i].root;
        cell.region = coarse_.mesh.regions.empty() ? 0 : coarse_.mesh.regions[root];
        cell.root = GlobalCell{findings_.numbers(Which::coarse).of(root).value()};
        return cell;
    };
    SelectedCells selected = select_cells(request_.selection, cells.size(), cell_to_test, {});
    if (any(group(), !selected.undefined.empty())) {
        throw InputError("an expression of the selection has no value in a cell");
    }
    return std::move(selected.marks);
}

std::vector<EdgeVertices> RequestedRefinement::exchange_edges(
    const std::vector<EdgeVertices>& edges) const {
    const auto& points = fine_.mesh.points;
    const Numbers& numbers = findings_.numbers(Which::fine);
    std::vector<std::vector<EdgeVertices>> to_each(static_cast<std::size_t>(group().size()));
    for (const EdgeVertices& edge : edges) {
        const Bounds box = bounds_of(std::array{points[edge[0]], points[edge[1]]});
        views_.for_each_meeting(box, [&](std::size_t r) {
            to_each[r].push_back({numbers.of(edge[0]), numbers.of(edge[1])});
        });
    }
    to_each[static_cast<std::size_t>(group().rank())].clear();
    std::vector<EdgeVertices> in_view;
    for (const auto& received : exchange(group(), std::move(to_each))) {
        for (const auto& [a, b] : received) {
            const EdgeVertices ends{numbers.vertices.find(a.value()),
                                    numbers.vertices.find(b.value())};
            // none() is greater than any number.
            if (ends[0] < points.end_index() && ends[1] < points.end_index()) {
                in_view.push_back(ends);
            }
        }
    }
    return in_view;
}

void RequestedRefinement::report_missing(const EdgeVertices& edge) const {
    if (!fine_.owns(edge)) return;
    findings_.add(Code::missing_bisection, [&]() -> Findings::Description {
        return {{entity(edge)}, "not bisected", "bisected: marked by closure"};
    });
}

void RequestedRefinement::report_needless(const EdgeVertices& edge) const {
    if (!fine_.owns(edge)) return;
    findings_.add(Code::needless_bisection, [&]() -> Findings::Description {
        return {{entity(edge)}, "bisected", "not bisected: not marked by closure"};
    });
}

std::string RequestedRefinement::levels() const {
    return fmt::format("{} level{}", request_.levels, request_.levels == 1 ? "" : "s");
}

}  // namespace octetra::verify
