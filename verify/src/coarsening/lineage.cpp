#include "coarsening/lineage.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>

namespace octetra::verify {
namespace {

/// An edge of a cell that a step bisects.
struct Bisected {
    EdgeVertices edge;
    VertexIndex midpoint;
};

[[noreturn]] void refuse(int step, const std::string& why) {
    throw InputError(fmt::format("step {} does not fit the mesh before it: {}", step, why));
}

Segment segment(const Lineage& lineage, const EdgeVertices& edge) {
    return {lineage.points[edge[0]], lineage.points[edge[1]]};
}

EdgeVertices edge_at(const CellVertices& cell, std::size_t k) {
    const auto [i, j] = cell_edges[k];
    return {cell[i], cell[j]};
}

/// Bisects the piece at its longest listed edge, then each half recursively. The first half keeps
/// the end with the lower position.
void bisect(const CellVertices& piece, const std::vector<Bisected>& longest_first,
            std::vector<CellVertices>& pieces) {
    const auto position = [&](VertexIndex v) {
        return static_cast<std::size_t>(std::find(piece.begin(), piece.end(), v) - piece.begin());
    };
    for (const auto& [edge, midpoint] : longest_first) {
        const auto [i, j] = std::minmax({position(edge[0]), position(edge[1])});
        if (j == piece.size()) continue;
        for (const std::size_t leaving : {j, i}) {
            CellVertices half = piece;
            half[leaving] = midpoint;
            bisect(half, longest_first, pieces);
        }
        return;
    }
    pieces.push_back(piece);
}

/// Collects the edges of a cell that the step bisects and whose midpoints are in the set, longest
/// first.
void find_bisected(const Lineage& lineage, const CellVertices& cell, int step,
                   const VertexSet& vertices, std::vector<Bisected>& found) {
    found.clear();
    for (std::size_t k = 0; k < cell_edges.size(); ++k) {
        const EdgeVertices edge = edge_at(cell, k);
        const std::uint32_t number = lineage.midpoints.find(edge[0], edge[1]);
        if (number == EdgeTable::absent) continue;
        const VertexIndex m{number};
        if (lineage.step[m] == step && vertices[m] != 0) found.push_back({edge, m});
    }
    std::sort(found.begin(), found.end(), [&](const Bisected& e, const Bisected& f) {
        return longer(segment(lineage, e.edge), segment(lineage, f.edge));
    });
}

Generations cells_of(const Mesh& input) {
    Generations cells;
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
        cells.present.push_back({input.cells[c], c, no_parent});
    }
    return cells;
}

void take_step(const Lineage& lineage, int step, const VertexSet& vertices, Generations& cells) {
    std::vector<PresentCell> next;
    next.reserve(cells.present.size());
    std::vector<Bisected> bisected;
    std::vector<CellVertices> pieces;
    for (const PresentCell& cell : cells.present) {
        find_bisected(lineage, cell.vertices, step, vertices, bisected);
        if (bisected.empty()) {
            next.push_back(cell);
            continue;
        }
        pieces.clear();
        bisect(cell.vertices, bisected, pieces);
        const auto parent = static_cast<std::uint32_t>(cells.cut.size());
        cells.cut.push_back({cell.vertices, step, cell.parent});
        for (const CellVertices& piece : pieces) next.push_back({piece, cell.root, parent});
    }
    cells.present = std::move(next);
}

/// Returns whether the step bisects edge k of a cell with this cut.
bool has(std::uint8_t cut, std::size_t k) { return (unsigned{cut} >> k & 1U) != 0; }

/// Assigns numbers to the midpoints of a step.
void add_midpoints(Lineage& lineage, const std::vector<std::uint8_t>& cuts, int step) {
    std::vector<EdgeVertices> edges;
    for (std::size_t c = 0; c < cuts.size(); ++c) {
        for (std::size_t k = 0; k < cell_edges.size(); ++k) {
            if (!has(cuts[c], k)) continue;
            const EdgeVertices edge = edge_at(lineage.cells.present[c].vertices, k);
            edges.push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    if (edges.size() > VertexIndex::limit - lineage.points.size()) {
        throw InputError("the mesh before has more vertices than one process can number");
    }
    for (const EdgeVertices& edge : edges) {
        const auto [a, b] = edge;
        const VertexIndex m = lineage.points.append(midpoint(lineage.points[a], lineage.points[b]));
        lineage.step.push_back(step);
        lineage.halves.push_back(edge);
        lineage.midpoints.at(a, b) = m.value();
    }
}

/// Throws InputError unless cells agree on the edges that they share, and the set is closed.
void check_cuts(const Lineage& lineage, const std::vector<std::uint8_t>& cuts, int step) {
    for (std::size_t c = 0; c < cuts.size(); ++c) {
        const CellVertices& cell = lineage.cells.present[c].vertices;
        const auto is_cut = [&](const EdgeVertices& edge) {
            return lineage.midpoints.find(edge[0], edge[1]) != EdgeTable::absent;
        };
        for (std::size_t k = 0; k < cell_edges.size(); ++k) {
            if (is_cut(edge_at(cell, k)) != has(cuts[c], k)) {
                refuse(step,
                       fmt::format("cell {}, from 0, and a neighbour disagree on an edge", c));
            }
        }
        if (cuts[c] == 0) continue;
        for (const auto& [i, j, k] : cell_faces) {
            std::array<EdgeVertices, 3> edges{
                {{cell[i], cell[j]}, {cell[i], cell[k]}, {cell[j], cell[k]}}};
            std::sort(edges.begin(), edges.end(), [&](const auto& e, const auto& f) {
                return longer(segment(lineage, e), segment(lineage, f));
            });
            if (!is_cut(edges[0]) && (is_cut(edges[1]) || is_cut(edges[2]))) {
                refuse(
                    step,
                    fmt::format(
                        "on a face of cell {}, from 0, it bisects an edge but not the longest", c));
            }
        }
    }
}

}  // namespace

Lineage lineage_of(const Mesh& input, const StepCuts& steps) {
    Lineage lineage;
    lineage.points = input.points;
    lineage.step.assign(input.points.size(), 0);
    lineage.halves.assign(input.points.size(), {VertexIndex::none(), VertexIndex::none()});
    lineage.cells = cells_of(input);
    for (const std::vector<std::uint8_t>& cuts : steps) {
        const int step = ++lineage.steps;
        if (cuts.size() != lineage.cells.present.size()) {
            refuse(step, fmt::format("it has data of {} cells, but there are {}", cuts.size(),
                                     lineage.cells.present.size()));
        }
        add_midpoints(lineage, cuts, step);
        check_cuts(lineage, cuts, step);
        take_step(lineage, step, VertexSet(lineage.points.size(), 1), lineage.cells);
    }
    return lineage;
}

Generations cells_with(const Lineage& lineage, const Mesh& input, const VertexSet& vertices) {
    Generations cells = cells_of(input);
    for (int step = 1; step <= lineage.steps; ++step) take_step(lineage, step, vertices, cells);
    return cells;
}

}  // namespace octetra::verify
