#include "rivals/terminal_edges.hpp"

#include <algorithm>
#include <stdexcept>

#include "rivals/cutting.hpp"

namespace octetra::rivals {

struct TerminalEdgeBisection::State {
    explicit State(const Mesh& mesh)
        : cutting(mesh, {}), regions(mesh.regions), index_base(mesh.index_base) {}

    Cutting cutting;
    IndexVector<CellIndex, Marker> regions;
    std::uint32_t index_base;
    std::vector<WantedEdges::Edge> terminal;  // of a round
};

TerminalEdgeBisection::TerminalEdgeBisection(const Mesh& mesh)
    : state_(std::make_unique<State>(mesh)) {}

TerminalEdgeBisection::~TerminalEdgeBisection() = default;

Rounds TerminalEdgeBisection::refine(const Goal& goal, std::size_t max_cells) {
    Cutting& cutting = state_->cutting;
    auto& terminal = state_->terminal;
    cutting.begin(goal, max_cells);
    const std::size_t before = cell_count();
    Rounds rounds;
    while (cutting.wanted().count() > 0) {
        cutting.wanted().take_terminal(terminal);
        if (terminal.empty()) throw std::logic_error("edges are wanted, and none is terminal");
        std::ranges::sort(terminal, {}, &WantedEdges::Edge::ends);
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
    TerminalEdgeMesh out;
    out.mesh.points = graph.points;
    out.mesh.index_base = state_->index_base;
    out.mesh.cells.reserve(graph.cells.size());
    out.maps.cell_to_parent.reserve(graph.cells.size());
    CellIndex c = graph.cells.empty() ? CellIndex::none() : CellIndex{0};
    for (; !c.is_none(); c = graph.next[c]) {
        const LinkedCell& cell = graph.cells[c];
        out.mesh.cells.push_back(cell.vertices);
        out.maps.cell_to_parent.push_back(cell.root);
        if (!regions.empty()) out.mesh.regions.push_back(regions[cell.root]);
    }
    out.maps.first_midpoint = VertexIndex{state_->cutting.input_points()};
    out.maps.midpoint_to_edge = state_->cutting.midpoint_to_edge();
    return out;
}

}  // namespace octetra::rivals
