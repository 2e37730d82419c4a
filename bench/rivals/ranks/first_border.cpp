#include "rivals/ranks/first_border.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "rivals/ranks/exchange.hpp"

namespace octetra::rivals {
namespace {

template <std::size_t N>
using Numbers = std::array<std::uint64_t, N>;  // of vertices, ascending

/// A cell of this part that has an edge or a face, and its vertices in the order of their numbers.
template <std::size_t N>
struct Place {
    CellIndex cell;
    std::array<VertexIndex, N> vertices;
};

/// The edges and faces at the boundary of this part; for an edge all its cells that have boundary
/// faces at it.
struct PartBoundary {
    std::map<Numbers<2>, std::vector<Place<2>>> edges;
    std::map<Numbers<3>, std::vector<Place<3>>> faces;
};

template <std::size_t N>
void enter(std::map<Numbers<N>, std::vector<Place<N>>>& places, CellIndex c,
           std::array<VertexIndex, N> vertices,
           const IndexVector<VertexIndex, std::uint64_t>& vertex_numbers) {
    const auto number = [&](VertexIndex v) { return vertex_numbers[v]; };
    std::ranges::sort(vertices, {}, number);
    Numbers<N> numbers;
    std::ranges::transform(vertices, numbers.begin(), number);
    places[numbers].push_back({c, vertices});
}

PartBoundary boundary_of(const CellGraph& graph,
                         const IndexVector<VertexIndex, std::uint64_t>& vertex_numbers) {
    PartBoundary boundary;
    for (CellIndex c{0}; c < graph.cells.end_index(); ++c) {
        const LinkedCell& cell = graph.cells[c];
        for (std::size_t f = 0; f < 4; ++f) {
            if (!cell.neighbours[f].is_none()) continue;
            const auto& [i, j, k] = cell_faces[f];
            const VertexIndex p = cell.vertices[i];
            const VertexIndex q = cell.vertices[j];
            const VertexIndex r = cell.vertices[k];
            enter<3>(boundary.faces, c, {p, q, r}, vertex_numbers);
            enter<2>(boundary.edges, c, {p, q}, vertex_numbers);
            enter<2>(boundary.edges, c, {p, r}, vertex_numbers);
            enter<2>(boundary.edges, c, {q, r}, vertex_numbers);
        }
    }
    return boundary;
}

/// Collective. For each entry, in order, the other ranks that have an entry with the same numbers.
template <std::size_t N>
std::vector<std::vector<int>> others_of(const ProcessGroup& ranks,
                                        const std::map<Numbers<N>, std::vector<Place<N>>>& places,
                                        std::size_t most_ranks) {
    const auto size = static_cast<std::size_t>(ranks.size());
    std::vector<std::vector<Numbers<N>>> asked(size);
    for (const auto& [numbers, _] : places) asked[numbers[0] % size].push_back(numbers);
    const auto questions = all_to_all(ranks, asked);

    std::map<Numbers<N>, std::vector<int>> ranks_of;
    for (std::size_t r = 0; r < size; ++r) {
        for (const auto& numbers : questions[r]) ranks_of[numbers].push_back(static_cast<int>(r));
    }
    on_each(ranks, [&] {
        for (const auto& [numbers, list] : ranks_of) {
            if (list.size() > most_ranks) throw InputError("three cells have a face in common");
        }
    });
    std::vector<std::vector<int>> answers(size);  // their number, and the ranks
    for (std::size_t r = 0; r < size; ++r) {
        for (const auto& numbers : questions[r]) {
            const std::vector<int>& list = ranks_of.at(numbers);
            answers[r].push_back(static_cast<int>(list.size()));
            answers[r].insert(answers[r].end(), list.begin(), list.end());
        }
    }
    const auto heard = all_to_all(ranks, answers);

    std::vector<std::vector<int>> others;
    std::vector<std::size_t> at(size, 0);
    for (const auto& [numbers, _] : places) {
        const std::size_t r = numbers[0] % size;
        std::vector<int>& list = others.emplace_back();
        for (int left = heard[r][at[r]++]; left > 0; --left) list.push_back(heard[r][at[r]++]);
        std::erase(list, ranks.rank());
    }
    return others;
}

}  // namespace

Border first_border(const ProcessGroup& ranks, CellGraph& graph,
                    const IndexVector<VertexIndex, std::uint64_t>& vertex_numbers) {
    const PartBoundary boundary = boundary_of(graph, vertex_numbers);
    const auto ranks_of_edges =
        others_of<2>(ranks, boundary.edges, static_cast<std::size_t>(ranks.size()));
    const auto ranks_of_faces = others_of<3>(ranks, boundary.faces, 2);
    std::set<int> all;
    for (const auto& list : ranks_of_edges) all.insert(list.begin(), list.end());
    std::map<int, std::uint32_t> neighbour_of_rank;
    for (const int rank : all) {
        neighbour_of_rank.emplace(rank, static_cast<std::uint32_t>(neighbour_of_rank.size()));
    }

    std::vector<Border::InitialEdge> edges;
    auto others = ranks_of_edges.begin();
    for (const auto& [numbers, places] : boundary.edges) {
        const std::vector<int>& list = *others++;
        if (list.empty()) continue;
        const EdgeVertices& ends = places.front().vertices;
        for (const auto& place : places) graph.add_row(ends, place.cell);
        auto& neighbours = edges.emplace_back(Border::InitialEdge{ends, {}}).neighbours;
        for (const int rank : list) neighbours.push_back(neighbour_of_rank.at(rank));
    }
    std::vector<Border::InitialFace> faces;
    others = ranks_of_faces.begin();
    for (const auto& [numbers, places] : boundary.faces) {
        for (const int rank : *others++) {
            faces.push_back({places.front().vertices, neighbour_of_rank.at(rank)});
        }
    }
    return {{all.begin(), all.end()}, edges, faces};
}

}  // namespace octetra::rivals
