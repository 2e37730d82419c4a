#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <octetra/core/edge_order.hpp>

#include "support/refinement.hpp"

/// Terminal-edge bisection implemented literally: paths are searched anew in every round, in a map
/// of all edges, and nothing is stored.
namespace octetra::test {

class SlowTerminalEdges {
public:
    /// Returns whether to bisect a cell with these corners, a descendant of this cell of the input;
    /// the last argument is true for the cell of the input itself.
    using IsToBeCut = std::function<bool(const Corners&, CellIndex root, bool is_input)>;

    SlowTerminalEdges(const Mesh& mesh, IsToBeCut is_to_be_cut)
        : mesh_(mesh), is_to_be_cut_(std::move(is_to_be_cut)), is_input_(mesh.cells.size(), true) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) root_.push_back(c);
    }

    /// Bisects all terminal edges at the ends of the targets' paths in rounds, until there are
    /// none. Returns the number of edges of each round.
    std::vector<std::uint64_t> in_rounds() {
        std::vector<std::uint64_t> rounds;
        for (auto edges = terminal_edges(); !edges.empty(); edges = terminal_edges()) {
            for (const EdgeVertices& edge : edges) bisect(edge);
            rounds.push_back(edges.size());
        }
        return rounds;
    }
    /// Bisects one random terminal edge at a time.
    void one_by_one(std::uint64_t seed) {
        std::mt19937_64 random(seed);
        for (auto edges = terminal_edges(); !edges.empty(); edges = terminal_edges()) {
            bisect(*std::next(edges.begin(), static_cast<std::ptrdiff_t>(random() % edges.size())));
        }
    }

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
    [[nodiscard]] EdgeVertices edge_of(const CellVertices& cell, std::size_t k) const {
        const auto& [i, j] = cell_edges[k];
        return {std::min(cell[i], cell[j]), std::max(cell[i], cell[j])};
    }
    [[nodiscard]] Segment segment(const EdgeVertices& edge) const {
        return {mesh_.points[edge[0]], mesh_.points[edge[1]]};
    }
    [[nodiscard]] EdgeVertices longest(CellIndex c) const {
        EdgeVertices best = edge_of(mesh_.cells[c], 0);
        for (std::size_t k = 1; k < 6; ++k) {
            const EdgeVertices edge = edge_of(mesh_.cells[c], k);
            if (longer(segment(edge), segment(best))) best = edge;
        }
        return best;
    }

    [[nodiscard]] std::set<EdgeVertices> terminal_edges() const {
        std::map<EdgeVertices, std::vector<CellIndex>> around;
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            for (std::size_t k = 0; k < 6; ++k) around[edge_of(mesh_.cells[c], k)].push_back(c);
        }
        std::set<EdgeVertices> seen;
        std::set<EdgeVertices> terminal;
        const std::function<void(const EdgeVertices&)> follow = [&](const EdgeVertices& edge) {
            if (!seen.insert(edge).second) return;
            bool is_terminal = true;
            for (const CellIndex c : around.at(edge)) {
                if (longest(c) == edge) continue;
                is_terminal = false;
                follow(longest(c));
            }
            if (is_terminal) terminal.insert(edge);
        };
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            if (is_to_be_cut_(corners_of(mesh_, c), root_[c], is_input_[c])) follow(longest(c));
        }
        return terminal;
    }

    void bisect(const EdgeVertices& edge) {
        const auto& [a, b] = edge;
        const VertexIndex middle = mesh_.points.append(midpoint(mesh_.points[a], mesh_.points[b]));
        for (CellIndex c{0}, end = mesh_.cells.end_index(); c < end; ++c) {
            CellVertices other = mesh_.cells[c];
            const auto at_a = std::ranges::find(other, a);
            const auto at_b = std::ranges::find(other, b);
            if (at_a == other.end() || at_b == other.end()) continue;
            *at_a = middle;
            std::ranges::replace(mesh_.cells[c], b, middle);
            mesh_.cells.push_back(other);
            root_.push_back(root_[c]);
            if (!mesh_.regions.empty()) mesh_.regions.push_back(mesh_.regions[c]);
            is_input_[c] = false;
            is_input_.push_back(false);
        }
    }

    Mesh mesh_;
    IsToBeCut is_to_be_cut_;
    IndexVector<CellIndex, CellIndex> root_;
    IndexVector<CellIndex, char> is_input_;
};

}  // namespace octetra::test
