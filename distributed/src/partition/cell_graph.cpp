#include "partition/cell_graph.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "partition/cell_groups.hpp"
#include "partition/longest_edges.hpp"
#include "partition/neighbours.hpp"

namespace octetra::distributed {
namespace {

/// The contributions to the weight of a link: of each face, and of each cell whose longest edge is
/// in the face.
struct LinkWeights {
    std::int32_t face;
    std::int32_t path;
};

/// The cells of each node, ascending, node by node.
class CellsOfNodes {
public:
    explicit CellsOfNodes(const std::vector<std::int32_t>& cell_to_node)
        : cells_(cell_to_node.size()) {
        const auto last = std::ranges::max_element(cell_to_node);
        const auto count = last == cell_to_node.end() ? 0 : static_cast<std::size_t>(*last) + 1;
        begin_.assign(count + 1, 0);
        for (const std::int32_t node : cell_to_node) ++begin_[static_cast<std::size_t>(node)];
        std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
        // Filled in reverse, which leaves each offset at the begin of its range.
        for (std::size_t c = cells_.size(); c-- > 0;) {
            cells_[--begin_[static_cast<std::size_t>(cell_to_node[c])]] = CellIndex{c};
        }
    }

    [[nodiscard]] std::size_t count() const { return begin_.size() - 1; }
    [[nodiscard]] std::span<const CellIndex> operator[](std::size_t node) const {
        return {cells_.data() + begin_[node], cells_.data() + begin_[node + 1]};
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<CellIndex> cells_;
};

struct Link {
    std::int32_t node;
    std::int32_t weight;
};

/// Accumulates the links of one node.
class Row {
public:
    explicit Row(std::size_t nodes) : link_of_node_(nodes, none) {}

    void add(const Link& link) {
        std::uint32_t& index = link_of_node_[static_cast<std::size_t>(link.node)];
        if (index == none) {
            index = static_cast<std::uint32_t>(links_.size());
            links_.push_back({link.node, 0});
        }
        links_[index].weight += link.weight;
    }
    [[nodiscard]] const std::vector<Link>& links() const { return links_; }
    void clear() {
        for (const Link& link : links_) link_of_node_[static_cast<std::size_t>(link.node)] = none;
        links_.clear();
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> link_of_node_;
    std::vector<Link> links_;
};

CellGraph graph_of(const Neighbours& neighbours, std::vector<std::int32_t> cell_to_node,
                   const CellWeights& cell_weights, const LinkWeights& weights) {
    const CellsOfNodes nodes(cell_to_node);
    CellGraph graph;
    graph.begin.reserve(nodes.count() + 1);
    graph.begin.push_back(0);
    graph.node_weights.reserve(nodes.count());
    Row row(nodes.count());
    for (std::size_t node = 0; node < nodes.count(); ++node) {
        for (const CellIndex c : nodes[node]) {
            for (const Neighbour neighbour : neighbours[c]) {
                if (neighbour.cell == Neighbour::none) break;
                const std::int32_t other = cell_to_node[neighbour.cell];
                if (static_cast<std::size_t>(other) == node) continue;
                const auto paths = static_cast<std::int32_t>(neighbour.paths);
                row.add({other, weights.face + paths * weights.path});
            }
        }
        for (const Link& link : row.links()) {
            graph.neighbours.push_back(link.node);
            graph.weights.push_back(link.weight);
        }
        row.clear();
        graph.begin.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
        graph.node_weights.push_back(static_cast<std::int32_t>(cell_weights.of_all(nodes[node])));
    }
    graph.cell_to_node = std::move(cell_to_node);
    return graph;
}

bool has(const FacetVertices& face, const EdgeVertices& edge) {
    return std::ranges::count(face, edge[0]) + std::ranges::count(face, edge[1]) == 2;
}

}  // namespace

void check_graph_size(std::uint64_t cells) {
    // A cell has at most four links, and each is counted at both of its ends.
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max() / 4;
    if (cells <= most) return;
    throw InputError(
        fmt::format("{} cells are too many for METIS, which partitions at most {}; use --partition "
                    "block, or a part file with --partition file:PATH",
                    cells, most));
}

CellGraph face_dual_graph(const Mesh& mesh, const CellWeights& weights) {
    check_graph_size(mesh.cells.size());
    const auto neighbours =
        neighbours_of_cells(mesh, [](const FacetVertices&, CellIndex, CellIndex) { return 0U; });
    std::vector<std::int32_t> cell_to_node(mesh.cells.size());
    std::iota(cell_to_node.begin(), cell_to_node.end(), 0);
    return graph_of(neighbours, std::move(cell_to_node), weights, {.face = 1, .path = 0});
}

CellGraph lepp_graph(const Mesh& mesh, const CellWeights& weights, std::int64_t most) {
    check_graph_size(mesh.cells.size());
    std::vector<std::int32_t> cell_to_node;
    Neighbours neighbours;
    {
        const LongestEdges edges(mesh);
        cell_to_node = groups_of_longest_edges(edges, weights, most);
        neighbours =
            neighbours_of_cells(mesh, [&](const FacetVertices& face, CellIndex a, CellIndex b) {
                return static_cast<unsigned>(has(face, edges.longest_of(a))) +
                       static_cast<unsigned>(has(face, edges.longest_of(b)));
            });
    }  // frees the edges before the graph is built
    join_single_cells(neighbours, weights, most, cell_to_node);
    // The ratio was determined by measurement: see bench/README.md.
    return graph_of(neighbours, std::move(cell_to_node), weights, {.face = 1, .path = 1});
}

}  // namespace octetra::distributed
