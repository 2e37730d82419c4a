#include "rivals/border.hpp"

#include <algorithm>
#include <utility>

namespace octetra::rivals {

Border::Border(std::vector<int> neighbours, const std::vector<InitialEdge>& edges,
               const std::vector<InitialFace>& faces)
    : neighbours_(std::move(neighbours)),
      edges_of_neighbour_(neighbours_.size()),
      face_count_of_neighbour_(neighbours_.size(), 0) {
    for (const InitialEdge& edge : edges) {
        std::vector<Sharer> sharers;
        for (const std::uint32_t n : edge.neighbours) sharers.push_back({.neighbour = n});
        const SharedEdgeIndex e = add(edge.ends, std::move(sharers));
        for (const std::uint32_t n : edge.neighbours) number(e, n);
    }
    for (const auto& [vertices, n] : faces) {
        faces_[sorted(vertices[0], vertices[1], vertices[2])] = {n, face_count_of_neighbour_[n]++};
    }
}

Border::FaceVertices Border::sorted(VertexIndex a, VertexIndex b, VertexIndex c) {
    FaceVertices face{a, b, c};
    std::ranges::sort(face);
    return face;
}

SharedEdgeIndex Border::add(const EdgeVertices& ends, std::vector<Sharer> sharers) {
    const auto e = static_cast<SharedEdgeIndex>(edges_.size());
    edges_.push_back({.ends = ends, .sharers = std::move(sharers)});
    edge_of_ends_[edge_key(ends)] = e;
    return e;
}

void Border::bisect(SharedEdgeIndex e, VertexIndex midpoint, CellGraph& graph, const Star& star) {
    const auto [first, second] = edges_[e].ends;
    SplitEdge split{.sharers = edges_[e].sharers, .halves = {}, .faces = {}};
    split.halves = {add({first, midpoint}, split.sharers), add({midpoint, second}, split.sharers)};
    for (const StarCell& at : star.cells) {
        for (const std::uint8_t beside : {at.next, at.previous}) {
            const VertexIndex c = graph.cells[at.cell].vertices[beside];
            const auto face = faces_.find(sorted(first, second, c));
            if (face == faces_.end()) continue;
            const Sharer parent = face->second;
            faces_.erase(face);
            const EdgeVertices across{midpoint, c};
            graph.add_row(across, at.cell);
            split.faces.push_back({parent,
                                   add(across, {{.neighbour = parent.neighbour}}),
                                   {sorted(first, midpoint, c), sorted(midpoint, second, c)}});
        }
    }
    edge_of_ends_.erase(edge_key(edges_[e].ends));
    splits_.push_back(std::move(split));
}

/// Numbers new edges and faces for each neighbour in the order of the previous numbers of their
/// parents.
void Border::number_new() {
    std::vector<std::vector<std::pair<std::uint32_t, SplitEdge*>>> of_neighbour(neighbours_.size());
    for (SplitEdge& split : splits_) {
        for (const auto& [n, number] : split.sharers) of_neighbour[n].emplace_back(number, &split);
    }
    for (std::uint32_t n = 0; n < of_neighbour.size(); ++n) {
        std::ranges::sort(of_neighbour[n]);
        for (const auto& [_, split] : of_neighbour[n]) {
            for (const SharedEdgeIndex half : split->halves) number(half, n);
            number_faces(*split, n);
        }
    }
    splits_.clear();
}

void Border::number(SharedEdgeIndex e, std::uint32_t neighbour) {
    auto& sharers = edges_[e].sharers;
    auto& edges = edges_of_neighbour_[neighbour];
    std::ranges::find(sharers, neighbour, &Sharer::neighbour)->number =
        static_cast<std::uint32_t>(edges.size());
    edges.push_back(e);
}

void Border::number_faces(SplitEdge& split, std::uint32_t neighbour) {
    std::ranges::sort(split.faces, {}, [](const SplitFace& face) { return face.parent.number; });
    for (const SplitFace& face : split.faces) {
        if (face.parent.neighbour != neighbour) continue;
        number(face.across, neighbour);
        for (const FaceVertices& half : face.halves) {
            faces_[half] = {neighbour, face_count_of_neighbour_[neighbour]++};
        }
    }
}

}  // namespace octetra::rivals
