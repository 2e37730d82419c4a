#include "properties/combinations.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace octetra::properties {
namespace {

using DescendingEdges = std::vector<Edge>;

/// The classes of a cell that sort its shared edges in one order: their number, and the number of
/// orders in them.
struct OrderCount {
    std::size_t classes = 0;
    std::size_t orders = 0;
};

std::map<DescendingEdges, OrderCount> by_shared_edges(const std::array<std::size_t, 4>& cell,
                                                      const OrderClasses& classes) {
    std::map<DescendingEdges, OrderCount> result;
    for (const OrderClass& one : classes.classes) {
        DescendingEdges edges;
        for (const std::size_t e : one.shared) edges.push_back(edge_of(cell, e));
        OrderCount& count = result[edges];
        ++count.classes;
        count.orders += one.size;
    }
    return result;
}

/// Returns whether a common order extends all lists. Repeatedly removes an edge that is first in
/// every list that contains it.
bool can_be_merged(std::vector<DescendingEdges> lists) {
    while (true) {
        std::erase_if(lists, [](const DescendingEdges& list) { return list.empty(); });
        if (lists.empty()) return true;
        const auto longest = std::ranges::find_if(lists, [&](const DescendingEdges& candidate) {
            return std::ranges::all_of(lists, [&](const DescendingEdges& list) {
                return std::ranges::find(list, candidate.front()) == list.end() ||
                       list.front() == candidate.front();
            });
        });
        if (longest == lists.end()) return false;
        const Edge edge = longest->front();
        for (DescendingEdges& list : lists) std::erase(list, edge);
    }
}

/// Adds the combinations in which the first cells sort their edges as in `lists`.
void add_combinations(CombinationCounts& counts,
                      const std::vector<std::map<DescendingEdges, OrderCount>>& cells,
                      std::vector<DescendingEdges>& lists, std::vector<OrderCount>& taken) {
    if (taken.size() == cells.size()) {
        if (!can_be_merged(lists)) return;
        std::size_t all = 1;
        for (const OrderCount& count : taken) all *= count.classes;
        counts[1] += all;
        for (const OrderCount& count : taken) {
            counts[2] += all / count.classes * count.orders;
        }
        return;
    }
    for (const auto& [edges, count] : cells[taken.size()]) {
        lists.push_back(edges);
        taken.push_back(count);
        add_combinations(counts, cells, lists, taken);
        lists.pop_back();
        taken.pop_back();
    }
}

}  // namespace

CombinationCounts count_combinations(const Complex& complex) {
    std::vector<std::map<DescendingEdges, OrderCount>> cells;
    const std::vector<OrderClasses> classes = classes_of_cells(complex);
    for (std::size_t cell = 0; cell < complex.size(); ++cell) {
        cells.push_back(by_shared_edges(complex[cell], classes[cell]));
    }
    CombinationCounts counts{order_count * complex.size(), 0, 0};
    std::vector<DescendingEdges> lists;
    std::vector<OrderCount> taken;
    add_combinations(counts, cells, lists, taken);
    return counts;
}

}  // namespace octetra::properties
