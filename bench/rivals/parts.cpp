#include "rivals/parts.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "rivals/cutting.hpp"

namespace octetra::rivals {
namespace {

using Edge = WantedEdges::Edge;

class Parts {
public:
    Parts(const Mesh& mesh, const Goal& goal, const std::vector<int>& part_of_cell)
        : cutting_(mesh, part_of_cell) {
        cutting_.begin(goal, CellIndex::limit);
    }

    PartsCounts count() {
        work();
        while (speak()) work();
        if (cutting_.wanted().count() > 0) throw std::logic_error("parts wait for one another");
        counts_.cells = cutting_.graph().cells.size();
        return counts_;
    }

private:
    struct Ask {
        int part = 0;
        CellIndex cell;
    };

    /// What was told, and then all that parts can do by themselves.
    void work() {
        for (const Ask& ask : std::exchange(asks_, {})) {
            cutting_.wanted().want_in(ask.part, ask.cell);
        }
        for (const Edge& edge : std::exchange(agreed_, {})) {
            cutting_.bisect(edge);
            ++counts_.shared_edges_bisected;
        }
        std::vector<Edge> terminal;
        for (;;) {
            cutting_.wanted().take_terminal(terminal);
            if (terminal.empty()) return;
            for (const Edge& edge : terminal) cutting_.bisect(edge);
        }
    }

    /// Has any part anything to say?
    bool speak() {
        std::map<std::pair<int, int>, std::uint64_t> edges_told;  // from a part to another
        std::vector<Edge> edges;
        cutting_.wanted().take_asked(edges);
        for (const Edge& edge : edges) {
            for (const int part : others(edge)) {
                ++edges_told[{edge.part, part}];
                asks_.push_back({part, edge.cell});
                ++counts_.asked;
            }
        }
        cutting_.wanted().take_ready(edges);
        for (const Edge& edge : edges) {
            const std::set<int> told = others(edge);
            for (const int part : told) ++edges_told[{edge.part, part}];
            counts_.ready += told.size();
            if (++ready_parts_[edge.ends] == told.size() + 1) {
                agreed_.push_back(edge);
                ready_parts_.erase(edge.ends);
            }
        }
        for (const auto& [parts, count] : edges_told) counts_.bytes += 4 * count;
        counts_.messages += edges_told.size();
        if (!edges_told.empty()) ++counts_.rounds;
        return !edges_told.empty();
    }

    /// The parts that have the edge, too.
    std::set<int> others(const Edge& edge) {
        cutting_.graph().find_star(edge.cell, star_);
        std::set<int> parts;
        for (const StarCell& at : star_.cells) parts.insert(cutting_.wanted().part(at.cell));
        parts.erase(edge.part);
        return parts;
    }

    Cutting cutting_;
    std::vector<Ask> asks_;
    std::vector<Edge> agreed_;
    std::map<EdgeVertices, std::size_t> ready_parts_;
    PartsCounts counts_;
    Star star_;
};

}  // namespace

PartsCounts count_on_parts(const Mesh& mesh, const Goal& goal,
                           const std::vector<int>& part_of_cell) {
    return Parts(mesh, goal, part_of_cell).count();
}

}  // namespace octetra::rivals
