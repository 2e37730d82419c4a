#include "regular/pending_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "level/planned_level.hpp"

namespace octetra::distributed {
namespace {

/// Returns the lists with each cell once, ascending.
MarkedCells merged(MarkedCells marked) {
    marked.count = marked.cells.size();
    if (std::ranges::is_sorted(marked.cells, std::ranges::less_equal{})) return marked;
    std::vector<std::pair<CellIndex, EdgeMask>> entries;
    entries.reserve(marked.cells.size());
    for (std::size_t k = 0; k < marked.cells.size(); ++k) {
        entries.emplace_back(marked.cells[k], marked.edges[k]);
    }
    std::ranges::sort(entries);
    MarkedCells result;
    for (const auto& [cell, edges] : entries) {
        if (result.cells.empty() || result.cells.back() != cell) {
            result.cells.push_back(cell);
            result.edges.push_back(0);
        }
        result.edges.back() = static_cast<EdgeMask>(result.edges.back() | edges);
    }
    result.count = result.cells.size();
    return result;
}

/// Returns the union of two lists, both ascending.
MarkedCells united(const MarkedCells& a, const MarkedCells& b) {
    MarkedCells result;
    result.cells.reserve(a.cells.size() + b.cells.size());
    result.edges.reserve(a.cells.size() + b.cells.size());
    for (std::size_t i = 0, j = 0; i < a.cells.size() || j < b.cells.size();) {
        const CellIndex of_a = i < a.cells.size() ? a.cells[i] : CellIndex::none();
        const CellIndex of_b = j < b.cells.size() ? b.cells[j] : CellIndex::none();
        unsigned edges = 0;
        if (of_a <= of_b) edges |= a.edges[i++];
        if (of_b <= of_a) edges |= b.edges[j++];
        result.cells.push_back(std::min(of_a, of_b));
        result.edges.push_back(static_cast<EdgeMask>(edges));
    }
    // Some may be listed without edges.
    result.count = static_cast<std::size_t>(
        std::ranges::count_if(result.edges, [](EdgeMask edges) { return edges != 0; }));
    return result;
}

void append(MarkedCells& list, CellIndex cell, unsigned edges) {
    if (edges == 0) return;
    list.cells.push_back(cell);
    list.edges.push_back(static_cast<EdgeMask>(edges));
    ++list.count;
}

}  // namespace

void PendingEdges::add_open(CellIndex cell, unsigned edges) { append(open_, cell, edges); }

MarkedCells PendingEdges::take_open() { return merged(std::exchange(open_, {})); }

void PendingEdges::add(const MarkedCells& closed, const TransitionCells& cells) {
    std::vector<MarkedCells> added;
    const auto list = [&](std::uint32_t generation, CellIndex cell, unsigned edges) {
        if (edges == 0) return;
        if (added.size() <= generation) added.resize(generation + std::size_t{1});
        append(added[generation], cell, edges);
    };
    for (std::size_t k = 0; k < closed.cells.size(); ++k) {
        const CellIndex c = closed.cells[k];
        const std::uint32_t own = cells.generation_of(c);
        const unsigned of_parent =
            cells.contains(c) ? closed.edges[k] & cells.edges_of_parent(c) : 0U;
        list(own - 1, c, of_parent);
        list(own, c, closed.edges[k] & ~of_parent);
    }
    if (closed_.size() < added.size()) closed_.resize(added.size());
    for (std::size_t g = 0; g < added.size(); ++g) {
        MarkedCells& known = closed_[g];
        known = known.cells.empty() ? std::move(added[g]) : united(known, added[g]);
    }
}

PendingEdges::Generations PendingEdges::generations(const Communicator& processes) const {
    constexpr std::uint64_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint64_t least = none;
    std::uint64_t greatest = 0;
    for (std::size_t g = 0; g < closed_.size(); ++g) {
        if (closed_[g].count == 0) continue;
        least = std::min<std::uint64_t>(least, g);
        greatest = g;
    }
    return {static_cast<std::uint32_t>(none - processes.max(none - least)),
            static_cast<std::uint32_t>(processes.max(greatest))};
}

MarkedCells PendingEdges::take(std::uint32_t generation) {
    if (generation >= closed_.size()) return {};
    MarkedCells listed = std::exchange(closed_[generation], {});
    if (listed.count == listed.cells.size()) return listed;
    MarkedCells taken;
    for (std::size_t k = 0; k < listed.cells.size(); ++k) {
        append(taken, listed.cells[k], listed.edges[k]);
    }
    return taken;
}

unsigned PendingEdges::take_of(CellIndex cell) {
    unsigned edges = 0;
    for (MarkedCells& closed : closed_) {
        const auto found = std::ranges::lower_bound(closed.cells, cell);
        if (found == closed.cells.end() || *found != cell) continue;
        EdgeMask& listed = closed.edges[static_cast<std::size_t>(found - closed.cells.begin())];
        if (listed != 0) --closed.count;
        edges |= std::exchange(listed, EdgeMask{0});  // the cell stays listed without edges
    }
    return edges;
}

void PendingEdges::reorder(const std::vector<CellIndex>& before) {
    for (MarkedCells& closed : closed_) {
        const std::size_t count = closed.count;
        closed = renumbered(std::move(closed), before);
        closed.count = count;
    }
}

}  // namespace octetra::distributed
