#include "rivals/terminal_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "rivals/refinement_state.hpp"
#include "rivals/vertex_levels.hpp"

namespace octetra::rivals {
namespace {

/// For each midpoint in the order of results its present index.
std::vector<std::size_t> order_of_midpoints(const std::vector<EdgeVertices>& midpoint_to_edge,
                                            std::size_t input_points,
                                            IndexVector<VertexIndex, VertexIndex>& number) {
    const auto levels = vertex_levels(midpoint_to_edge, input_points);
    std::vector<std::size_t> order(midpoint_to_edge.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto level = [&](std::size_t i) { return levels[VertexIndex{input_points + i}]; };
    std::ranges::stable_sort(order, {}, level);
    for (auto begin = order.begin(); begin != order.end();) {
        const auto end = std::find_if(begin, order.end(),
                                      [&](std::size_t i) { return level(i) != level(*begin); });
        const auto ends = [&](std::size_t i) {
            const auto& [a, b] = midpoint_to_edge[i];
            return ascending({number[a], number[b]});
        };
        std::ranges::sort(begin, end, {}, ends);
        for (; begin != end; ++begin) {
            number[VertexIndex{input_points + *begin}] =
                VertexIndex{input_points + static_cast<std::size_t>(begin - order.begin())};
        }
    }
    return order;
}

}  // namespace

struct TerminalEdgeBisection::State {
    explicit State(const Mesh& mesh)
        : cutting(CellGraph(mesh)), regions(mesh.regions), index_base(mesh.index_base) {}

    RefinementState cutting;
    IndexVector<CellIndex, Marker> regions;
    std::uint32_t index_base;
    std::vector<WantedEdges::Edge> terminal;  // of one round
};

TerminalEdgeBisection::TerminalEdgeBisection(const Mesh& mesh)
    : state_(std::make_unique<State>(mesh)) {}

TerminalEdgeBisection::~TerminalEdgeBisection() = default;

Rounds TerminalEdgeBisection::refine(const Goal& goal, std::size_t max_cells) {
    RefinementState& cutting = state_->cutting;
    auto& terminal = state_->terminal;
    cutting.begin(goal, max_cells);
    const std::size_t before = cell_count();
    Rounds rounds;
    while (cutting.wanted().count() > 0) {
        cutting.wanted().take_terminal(terminal);
        if (terminal.empty()) throw std::logic_error("edges are wanted, and none is terminal");
        for (const WantedEdges::Edge& edge : terminal) cutting.bisect(edge);
        rounds.edges_bisected.push_back(terminal.size());
    }
    rounds.cells_cut = cell_count() - before;
    return rounds;
}

std::size_t TerminalEdgeBisection::cell_count() const {
    return state_->cutting.graph().cells.size();
}

TerminalEdgeMesh TerminalEdgeBisection::result() const {
    const CellGraph& graph = state_->cutting.graph();
    const auto& regions = state_->regions;
    const auto& midpoint_to_edge = state_->cutting.midpoint_to_edge();
    const std::size_t input_points = state_->cutting.input_points();
    IndexVector<VertexIndex, VertexIndex> number;
    for (VertexIndex v{0}; v < graph.points.end_index(); ++v) number.push_back(v);
    const auto order = order_of_midpoints(midpoint_to_edge, input_points, number);

    TerminalEdgeMesh out;
    out.mesh.points.assign(graph.points.begin(),
                           graph.points.begin() + static_cast<std::ptrdiff_t>(input_points));
    out.maps.first_midpoint = VertexIndex{input_points};
    for (const std::size_t i : order) {
        const auto& [a, b] = midpoint_to_edge[i];
        out.mesh.points.push_back(graph.points[VertexIndex{input_points + i}]);
        out.maps.midpoint_to_edge.push_back(ascending({number[a], number[b]}));
    }
    out.mesh.index_base = state_->index_base;
    out.mesh.cells.reserve(graph.cells.size());
    out.maps.cell_to_parent.reserve(graph.cells.size());
    CellIndex c = graph.cells.empty() ? CellIndex::none() : CellIndex{0};
    for (; !c.is_none(); c = graph.next[c]) {
        const auto& [p, q, r, s] = graph.cells[c].vertices;
        const CellIndex root = graph.cells[c].root;
        out.mesh.cells.push_back({number[p], number[q], number[r], number[s]});
        out.maps.cell_to_parent.push_back(root);
        if (!regions.empty()) out.mesh.regions.push_back(regions[root]);
    }
    return out;
}

}  // namespace octetra::rivals
