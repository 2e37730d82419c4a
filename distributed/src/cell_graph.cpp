#include "cell_graph.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "edge_stars.hpp"
#include "length_order.hpp"

namespace octetra::distributed {
namespace {

struct Link {
    std::int32_t cell;
    std::int32_t neighbour;
    std::int32_t weight;
};

void join(std::vector<Link>& links, CellIndex a, CellIndex b, std::int32_t weight) {
    const auto number = [](CellIndex c) { return static_cast<std::int32_t>(c.value()); };
    links.push_back({number(a), number(b), weight});
    links.push_back({number(b), number(a), weight});
}

/// Puts the links in order; several between the same cells add up.
CellGraph graph_of(std::vector<Link> links, std::size_t cell_count) {
    std::ranges::sort(links, [](const Link& a, const Link& b) {
        return std::array{a.cell, a.neighbour} < std::array{b.cell, b.neighbour};
    });
    CellGraph graph;
    graph.begin.assign(cell_count + 1, 0);
    for (std::size_t i = 0; i < links.size(); ++i) {
        const Link& link = links[i];
        const bool repeated =
            i > 0 && links[i - 1].cell == link.cell && links[i - 1].neighbour == link.neighbour;
        if (repeated) {
            graph.weights.back() += link.weight;
            continue;
        }
        graph.neighbours.push_back(link.neighbour);
        graph.weights.push_back(link.weight);
        ++graph.begin[static_cast<std::size_t>(link.cell) + 1];
    }
    std::partial_sum(graph.begin.begin(), graph.begin.end(), graph.begin.begin());
    return graph;
}

void join_through_faces(const Mesh& mesh, std::vector<Link>& links) {
    struct Face {
        FacetVertices vertices;
        CellIndex cell;
    };
    std::vector<Face> faces;
    faces.reserve(4 * mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const auto& [i, j, k] : cell_faces) {
            FacetVertices face{mesh.cells[c][i], mesh.cells[c][j], mesh.cells[c][k]};
            std::ranges::sort(face);
            faces.push_back({face, c});
        }
    }
    std::ranges::sort(faces, {}, &Face::vertices);
    for (std::size_t f = 1; f < faces.size(); ++f) {
        if (faces[f - 1].vertices == faces[f].vertices) {
            join(links, faces[f - 1].cell, faces[f].cell, 1);
        }
    }
}

void join_through_longest_edges(const Mesh& mesh, std::int32_t weight, std::vector<Link>& links) {
    const EdgeStars stars(mesh.points.size(), mesh.cells);
    // All cells at an edge that is some cell's longest are joined to that cell.
    std::vector<std::uint32_t> begin(std::size_t{stars.end_index().value()} + 1, 0);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const EdgeIndex e : stars.edges_of(c)) ++begin[e.value()];
    }
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0U);
    std::vector<CellIndex> cells(begin.back());
    auto next = begin;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const EdgeIndex e : stars.edges_of(c)) cells[next[e.value()]++] = c;
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const LengthOrder order = length_order(mesh.points, mesh.cells[c]);
        const EdgeIndex longest = stars.edges_of(c)[PatternTable::get().longest_edge(order)];
        for (auto k = begin[longest.value()]; k < begin[longest.value() + 1U]; ++k) {
            if (cells[k] != c) join(links, c, cells[k], weight);
        }
    }
}

}  // namespace

CellGraph face_dual_graph(const Mesh& mesh) {
    std::vector<Link> links;
    join_through_faces(mesh, links);
    return graph_of(std::move(links), mesh.cells.size());
}

CellGraph longest_edge_graph(const Mesh& mesh) {
    std::vector<Link> links;
    join_through_longest_edges(mesh, 1, links);
    return graph_of(std::move(links), mesh.cells.size());
}

CellGraph lepp_graph(const Mesh& mesh) {
    constexpr std::int32_t longest_edge_weight = 4;  // against 1 for a face
    std::vector<Link> links;
    join_through_faces(mesh, links);
    join_through_longest_edges(mesh, longest_edge_weight, links);
    return graph_of(std::move(links), mesh.cells.size());
}

}  // namespace octetra::distributed
