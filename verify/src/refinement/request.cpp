#include <algorithm>
#include <span>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

#include "parts/views.hpp"
#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

/// A cell between the coarse mesh and the fine one, with vertices of the fine mesh.
struct Cell {
    CellVertices vertices;
    CellIndex root;  ///< its cell of the coarse mesh
};

/// Repeats the request, level by level, with the vertices of the fine mesh, which must contain
/// every midpoint that is needed. The result must be the fine cells. Processes exchange the marked
/// edges of cells in the views of several processes.
class Replay {
public:
    Replay(const Request& request, const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
           const Descent& descent, Findings& findings)
        : request_(request),
          coarse_(coarse.mesh),
          judged_coarse_(coarse),
          fine_(fine),
          lines_(lines),
          views_(coarse.views),
          findings_(findings) {
        for (CellIndex c{0}; c < coarse_.cells.end_index(); ++c) {
            CellVertices corners = coarse_.cells[c];
            for (VertexIndex& v : corners) v = descent.coarse_to_fine[v];
            cells_.push_back({corners, c});
        }
    }

    std::string run() {
        int level = 0;
        while (level < request_.levels && !failed_) {
            ++level;
            if (!refine_once()) break;
        }
        if (failed_) return {};
        compare_with_fine();
        return fmt::format("the closure of the selection, {} level{}", request_.levels,
                           request_.levels == 1 ? "" : "s");
    }

private:
    // Edges of the current cells are numbered; those of a cell are in the order of cell_edges.
    void number_edges() {
        edge_ends_.clear();
        cell_to_edges_.assign(cells_.size(), {});
        edge_begin_.clear();
        edge_to_cells_.clear();
        const Buckets<2> edges(fine_.mesh.points.size(), [&](auto&& visit) {
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
        const auto& p = fine_.mesh.points;
        return longer({p[edge_ends_[e][0]], p[edge_ends_[e][1]]},
                      {p[edge_ends_[f][0]], p[edge_ends_[f][1]]});
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
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) {
                corners[k] = fine_.mesh.points[cells_[c].vertices[k]];
            }
            const CellIndex root = cells_[c].root;
            const Marker region = coarse_.regions.empty() ? 0 : coarse_.regions[root];
            const GlobalCell number{findings_.numbers(Which::coarse).of(root).value()};
            if (!marks(request_.selection, corners, region, number)) continue;
            switch (request_.scheme) {
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
        } while (any(findings_.group(), take_marked_elsewhere()));
    }

    void close_here() {
        while (!queue_.empty()) {
            const EdgeNumber e = queue_.back();
            queue_.pop_back();
            if (findings_.group().size() > 1) unsent_.push_back(e);
            for (std::size_t i = edge_begin_[e]; i < edge_begin_[e + 1]; ++i) {
                for (const auto& face : faces_of(edge_to_cells_[i])) {
                    if (std::find(face.begin(), face.end(), e) != face.end()) mark(longest(face));
                }
            }
        }
    }

    /// Collective. Sends newly marked edges to the processes that may have them in view; returns
    /// whether any edges received were not marked on this process.
    bool take_marked_elsewhere() {
        const ProcessGroup& group = findings_.group();
        if (group.size() == 1) return false;
        const Numbers& numbers = findings_.numbers(Which::fine);
        std::vector<std::vector<EdgeVertices>> to_each(static_cast<std::size_t>(group.size()));
        for (const EdgeNumber e : unsent_) {
            const auto& [a, b] = edge_ends_[e];
            const Bounds box = bounds_of(std::array{fine_.mesh.points[a], fine_.mesh.points[b]});
            views_.for_each_meeting(box, [&, ends = edge_ends_[e]](std::size_t r) {
                to_each[r].push_back({numbers.of(ends[0]), numbers.of(ends[1])});
            });
        }
        unsent_.clear();
        to_each[static_cast<std::size_t>(group.rank())].clear();
        for (const auto& received : exchange(group, std::move(to_each))) {
            for (const EdgeVertices& edge : received) mark_if_seen(edge);
        }
        return !queue_.empty();
    }

    /// Marks an edge, given by its numbers in the whole mesh, if it is in view.
    void mark_if_seen(const EdgeVertices& edge) {
        const NumberList& vertices = findings_.numbers(Which::fine).vertices;
        const EdgeVertices ends{vertices.find(edge[0].value()), vertices.find(edge[1].value())};
        const auto found = std::lower_bound(edge_ends_.begin(), edge_ends_.end(), ends);
        if (found == edge_ends_.end() || *found != ends) return;
        mark(static_cast<EdgeNumber>(found - edge_ends_.begin()));
    }

    /// Performs a level. Returns false if nothing was marked.
    bool refine_once() {
        number_edges();
        mark_edges();
        if (!any(findings_.group(), !queue_.empty())) return false;
        close();
        midpoints_.assign(edge_ends_.size(), VertexIndex::none());
        for (EdgeNumber e = 0; e < edge_ends_.size(); ++e) {
            if (marked_[e] == 0) continue;
            midpoints_[e] = lines_.midpoint(edge_ends_[e][0], edge_ends_[e][1]);
            if (midpoints_[e].is_none()) report_missing(edge_ends_[e]);
        }
        failed_ = any(findings_.group(), failed_);
        if (!failed_) bisect_cells();
        return true;
    }

    void bisect_cells() {
        std::vector<Cell> children;
        children.reserve(2 * cells_.size());
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            std::array<EdgeNumber, 6> edges;
            std::size_t count = 0;
            // The marked edges by descending length. (Insertion sort: the order is strict, and
            // there are at most six.)
            for (const EdgeNumber e : cell_to_edges_[c]) {
                if (marked_[e] == 0) continue;
                edges[count] = e;
                for (std::size_t k = count++; k > 0 && is_longer(edges[k], edges[k - 1]); --k) {
                    std::swap(edges[k], edges[k - 1]);
                }
            }
            bisect(cells_[c], {edges.data(), count}, children);
        }
        cells_ = std::move(children);
    }

    void bisect(const Cell& cell, std::span<const EdgeNumber> longest_first,
                std::vector<Cell>& children) const {
        for (const EdgeNumber e : longest_first) {
            const auto position = [&](VertexIndex v) {
                return static_cast<std::size_t>(
                    std::find(cell.vertices.begin(), cell.vertices.end(), v) -
                    cell.vertices.begin());
            };
            const std::size_t i = position(edge_ends_[e][0]);
            const std::size_t j = position(edge_ends_[e][1]);
            if (i == 4 || j == 4) continue;
            for (const std::size_t leaving : {i, j}) {
                Cell half = cell;
                half.vertices[leaving] = midpoints_[e];
                bisect(half, longest_first, children);
            }
            return;
        }
        children.push_back(cell);
    }

    void report_missing(const EdgeVertices& edge) {
        failed_ = true;
        if (!fine_.owns(edge)) return;
        findings_.add(Code::missing_bisection, [&]() -> Findings::Description {
            return {{entity(edge)}, "not bisected", "bisected: marked by closure"};
        });
    }

    void compare_with_fine() {
        EdgeTable reported(16);
        CellFinder fine_cells(fine_);
        for (const Cell& cell : cells_) {
            if (!fine_cells.find(cell.vertices).is_none()) continue;
            bool explained = false;
            for (const auto& [i, j] : cell_edges) {
                const EdgeVertices edge{cell.vertices[i], cell.vertices[j]};
                if (lines_.is_whole(edge[0], edge[1])) continue;
                if (lines_.midpoint(edge[0], edge[1]).is_none()) continue;  // not an edge
                explained = true;
                std::uint32_t& seen = reported.at(edge[0], edge[1]);
                if (seen != EdgeTable::absent) continue;
                seen = 1;
                if (!fine_.owns(edge)) continue;
                findings_.add(Code::needless_bisection, [&]() -> Findings::Description {
                    return {{entity(edge)}, "bisected", "not bisected: not marked by closure"};
                });
            }
            if (explained || !judged_coarse_.owns(coarse_.cells[cell.root])) continue;
            findings_.add(Code::wrong_pattern, [&]() -> Findings::Description {
                return {{entity(cell.vertices), entity(cell.root, Which::coarse)},
                        "no cell, although none of its edges is bisected",
                        "a cell, created by longest-edge bisection"};
            });
        }
    }

    const Request& request_;
    const Mesh& coarse_;
    const JudgedMesh& judged_coarse_;
    const JudgedMesh& fine_;
    Lines& lines_;
    Views views_;
    Findings& findings_;

    std::vector<Cell> cells_;
    std::vector<EdgeVertices> edge_ends_;
    std::vector<std::array<EdgeNumber, 6>> cell_to_edges_;
    std::vector<std::size_t> edge_begin_;  ///< for each edge, its begin in edge_to_cells_
    std::vector<std::uint32_t> edge_to_cells_;
    std::vector<char> marked_;
    std::vector<EdgeNumber> queue_;
    std::vector<EdgeNumber> unsent_;  ///< marked, but not yet sent to other processes
    std::vector<VertexIndex> midpoints_;
    bool failed_ = false;
};

}  // namespace

std::string check_request(const Request& request, const JudgedMesh& coarse, const JudgedMesh& fine,
                          Lines& lines, const Descent& descent, Findings& findings) {
    return Replay(request, coarse, fine, lines, descent, findings).run();
}

}  // namespace octetra::verify
