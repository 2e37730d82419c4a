#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

#include "lookup/buckets.hpp"
#include "lookup/edge_table.hpp"
#include "parts/exchange.hpp"
#include "refinement/bisected_edges.hpp"
#include "request/replays.hpp"
#include "request/requested_refinement.hpp"

namespace octetra::verify {
namespace {

/// Processes exchange the marked edges of cells in the views of several processes.
class LongestEdgeReplay {
public:
    explicit LongestEdgeReplay(const RequestedRefinement& asked)
        : asked_(asked), points_(asked.fine().mesh.points), cells_(asked.coarse_cells()) {}

    std::string run() {
        int level = 0;
        while (level < asked_.request().levels && !failed_) {
            ++level;
            if (!refine_once()) break;
        }
        if (failed_) return {};
        compare_with_fine();
        return fmt::format("the closure of the selection, {}", asked_.levels());
    }

private:
    // Edges of the current cells are numbered; those of a cell are in the order of cell_edges.
    void number_edges() {
        edge_ends_.clear();
        cell_to_edges_.assign(cells_.size(), {});
        edge_begin_.clear();
        edge_to_cells_.clear();
        const Buckets<2> edges(points_.size(), [&](auto&& visit) {
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                const CellVertices& v = cells_[c].vertices;
                for (std::size_t k = 0; k < 6; ++k) {
                    const auto [i, j] = cell_edges[k];
                    visit(EdgeVertices{v[i], v[j]}, 8 * c + k);
                }
            }
        });
        edges.for_each_group([&](const EdgeVertices& ends, auto entries) {
            edge_begin_.push_back(edge_to_cells_.size());
            for (const auto& entry : entries) {
                const auto cell = static_cast<std::uint32_t>(entry.tag / 8);
                cell_to_edges_[cell][entry.tag % 8] = static_cast<std::uint32_t>(edge_ends_.size());
                edge_to_cells_.push_back(cell);
            }
            edge_ends_.push_back(ends);
        });
        edge_begin_.push_back(edge_to_cells_.size());
        marked_.assign(edge_ends_.size(), 0);
    }

    using EdgeNumber = std::uint32_t;

    [[nodiscard]] bool is_longer(EdgeNumber e, EdgeNumber f) const {
        return longer({points_[edge_ends_[e][0]], points_[edge_ends_[e][1]]},
                      {points_[edge_ends_[f][0]], points_[edge_ends_[f][1]]});
    }

    template <std::size_t N>
    [[nodiscard]] EdgeNumber longest(const std::array<EdgeNumber, N>& edges) const {
        return *std::max_element(edges.begin(), edges.end(),
                                 [&](EdgeNumber e, EdgeNumber f) { return is_longer(f, e); });
    }

    [[nodiscard]] std::array<std::array<EdgeNumber, 3>, 4> faces_of(std::size_t c) const {
        const auto& e = cell_to_edges_[c];  // 01 02 03 12 13 23
        return {{{e[3], e[4], e[5]}, {e[1], e[2], e[5]}, {e[0], e[2], e[4]}, {e[0], e[1], e[3]}}};
    }

    void mark(EdgeNumber e) {
        if (marked_[e] != 0) return;
        marked_[e] = 1;
        queue_.push_back(e);
    }

    void mark_edges() {
        const std::vector<std::uint8_t> marks = asked_.marks_of(cells_);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (marks[c] == 0) continue;
            switch (asked_.request().scheme) {
                case Scheme::eight:
                    for (const EdgeNumber e : cell_to_edges_[c]) mark(e);
                    break;
                case Scheme::four:
                    for (const auto& face : faces_of(c)) mark(longest(face));
                    break;
                case Scheme::two: mark(longest(cell_to_edges_[c])); break;
            }
        }
    }

    void close() {
        do {
            close_here();
        } while (any(asked_.group(), take_marked_elsewhere()));
    }

    void close_here() {
        while (!queue_.empty()) {
            const EdgeNumber e = queue_.back();
            queue_.pop_back();
            if (asked_.group().size() > 1) unsent_.push_back(edge_ends_[e]);
            for (std::size_t i = edge_begin_[e]; i < edge_begin_[e + 1]; ++i) {
                for (const auto& face : faces_of(edge_to_cells_[i])) {
                    if (std::find(face.begin(), face.end(), e) != face.end()) mark(longest(face));
                }
            }
        }
    }

    /// Collective. Exchanges newly marked edges; returns whether any edges received were not marked
    /// on this process.
    bool take_marked_elsewhere() {
        if (asked_.group().size() == 1) return false;
        const auto received = asked_.exchange_edges(unsent_);
        unsent_.clear();
        for (const EdgeVertices& edge : received) {
            const auto found = std::lower_bound(edge_ends_.begin(), edge_ends_.end(), edge);
            if (found == edge_ends_.end() || *found != edge) continue;
            mark(static_cast<EdgeNumber>(found - edge_ends_.begin()));
        }
        return !queue_.empty();
    }

    /// Performs a level. Returns false if nothing was marked.
    bool refine_once() {
        number_edges();
        mark_edges();
        if (!any(asked_.group(), !queue_.empty())) return false;
        close();
        midpoints_.assign(edge_ends_.size(), VertexIndex::none());
        for (EdgeNumber e = 0; e < edge_ends_.size(); ++e) {
            if (marked_[e] == 0) continue;
            midpoints_[e] = asked_.lines().midpoint(edge_ends_[e][0], edge_ends_[e][1]);
            if (!midpoints_[e].is_none()) continue;
            failed_ = true;
            asked_.report_missing(edge_ends_[e]);
        }
        failed_ = any(asked_.group(), failed_);
        if (!failed_) bisect_cells();
        return true;
    }

    void bisect_cells() {
        std::vector<DescendantCell> children;
        children.reserve(2 * cells_.size());
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            BisectedEdges bisected(points_);
            for (const EdgeNumber e : cell_to_edges_[c]) {
                if (marked_[e] != 0) bisected.add({edge_ends_[e], midpoints_[e]});
            }
            bisected.for_each_piece(cells_[c].vertices, [&](const CellVertices& piece) {
                children.push_back({piece, cells_[c].root});
            });
        }
        cells_ = std::move(children);
    }

    void compare_with_fine() {
        EdgeTable reported(16);
        CellFinder fine_cells(asked_.fine());
        for (const DescendantCell& cell : cells_) {
            if (!fine_cells.find(cell.vertices).is_none()) continue;
            bool explained = false;
            for (const auto& [i, j] : cell_edges) {
                const EdgeVertices edge{cell.vertices[i], cell.vertices[j]};
                if (!asked_.lines().is_bisected(edge)) continue;
                explained = true;
                std::uint32_t& seen = reported.at(edge[0], edge[1]);
                if (seen != EdgeTable::absent) continue;
                seen = 1;
                asked_.report_needless(edge);
            }
            const JudgedMesh& coarse = asked_.coarse();
            if (explained || !coarse.owns(coarse.mesh.cells[cell.root])) continue;
            asked_.findings().add(Code::wrong_pattern, [&]() -> Findings::Description {
                return {{entity(cell.vertices), entity(cell.root, Which::coarse)},
                        "no cell, although none of its edges is bisected",
                        "a cell, created by longest-edge bisection"};
            });
        }
    }

    const RequestedRefinement& asked_;
    const IndexVector<VertexIndex, Point>& points_;  ///< of the fine mesh

    std::vector<DescendantCell> cells_;
    std::vector<EdgeVertices> edge_ends_;
    std::vector<std::array<EdgeNumber, 6>> cell_to_edges_;
    std::vector<std::size_t> edge_begin_;  ///< for each edge, its begin in edge_to_cells_
    std::vector<std::uint32_t> edge_to_cells_;
    std::vector<char> marked_;
    std::vector<EdgeNumber> queue_;
    std::vector<EdgeVertices> unsent_;  ///< marked, but not yet sent to other processes
    std::vector<VertexIndex> midpoints_;
    bool failed_ = false;
};

}  // namespace

std::string replay_longest_edge_closure(const RequestedRefinement& asked) {
    return LongestEdgeReplay(asked).run();
}

}  // namespace octetra::verify
