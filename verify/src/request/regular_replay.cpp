#include <utility>
#include <vector>

#include <fmt/format.h>

#include "parts/exchange.hpp"
#include "request/regular_cells.hpp"
#include "request/replays.hpp"

namespace octetra::verify {
namespace {

/// Processes exchange the bisected edges of regular cells in the views of several processes.
class RegularReplay {
public:
    explicit RegularReplay(const RequestedRefinement& asked)
        : asked_(asked), cells_(asked.coarse_cells(), asked.fine().mesh.points, asked.lines()) {}

    std::string run() {
        int level = 0;
        while (level < asked_.request().levels && !failed_) {
            ++level;
            if (!refine_once()) break;
        }
        if (failed_) return {};
        cells_.for_each_whole_edge([&](const EdgeVertices& edge) {
            if (asked_.lines().is_bisected(edge)) asked_.report_needless(edge);
        });
        return fmt::format("the regular closure of the selection, {}", asked_.levels());
    }

private:
    /// A marked cell, and the regular cell whose child it is.
    struct MarkedTransitionCell {
        RegularCells::CellNumber parent;
        CellVertices vertices;
    };

    /// Performs a level. Returns false if nothing was marked.
    bool refine_once() {
        std::vector<DescendantCell> present;
        cells_.for_each_cell(
            [&](const DescendantCell& cell, auto&&...) { present.push_back(cell); });
        const std::vector<std::uint8_t> marks = asked_.marks_of(present);
        std::vector<RegularCells::CellNumber> regular;
        std::vector<MarkedTransitionCell> transition;
        std::size_t next = 0;
        cells_.for_each_cell(
            [&](const DescendantCell& cell, RegularCells::CellNumber c, bool is_transition) {
                if (marks[next++] == 0) return;
                regular.push_back(c);
                if (is_transition) transition.push_back({c, cell.vertices});
            });
        // Rule (1), first for regular cells and parents, of which the children are then known.
        for (const auto c : regular) cells_.add_edges_of(c);
        if (!any(asked_.group(), cells_.is_open())) return false;
        close();
        for (const auto& [parent, vertices] : transition) {
            const auto child = cells_.child_of(parent, vertices);
            if (child != RegularCells::none) cells_.add_edges_of(child);
        }
        close();
        cells_.for_each_without_midpoint([&](const EdgeVertices& edge) {
            failed_ = true;
            asked_.report_missing(edge);
        });
        failed_ = any(asked_.group(), failed_);
        return true;
    }

    /// Collective.
    void close() {
        do {
            cells_.close();
        } while (any(asked_.group(), take_added_elsewhere()));
    }

    /// Collective. Exchanges edges that were added; returns whether the rules must be applied
    /// again.
    bool take_added_elsewhere() {
        const std::vector<EdgeVertices> added = cells_.take_added();
        if (asked_.group().size() == 1) return false;
        for (const EdgeVertices& edge : asked_.exchange_edges(added)) cells_.add(edge);
        (void)cells_.take_added();  // the sender informs every process that may have them in view
        return cells_.is_open();
    }

    const RequestedRefinement& asked_;
    RegularCells cells_;
    bool failed_ = false;
};

}  // namespace

std::string replay_regular_closure(const RequestedRefinement& asked) {
    return RegularReplay(asked).run();
}

}  // namespace octetra::verify
