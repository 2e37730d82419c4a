#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "rivals/cell_graph.hpp"

/// The entities that a rank shares with others, updated as all sharers bisect the same edges.
namespace octetra::rivals {

using SharedEdgeIndex = std::uint32_t;
inline constexpr SharedEdgeIndex not_shared = std::numeric_limits<SharedEdgeIndex>::max();

/// Another rank that has an edge or a face.
struct Sharer {
    std::uint32_t neighbour = 0;  ///< an index in Border::neighbours()
    std::uint32_t number = 0;     ///< the number of the entity between the two ranks
};

struct SharedEdge {
    EdgeVertices ends;  ///< in the same order on all ranks
    std::vector<Sharer> sharers;
    bool is_wanted = false;
    std::uint32_t ready_ranks = 0;  ///< ranks that are ready, including this one
};

/// The edges and faces whose cells are on several ranks. An edge may have any number of sharers, a
/// face has two. Halves of an edge have the sharers of the edge; an edge from its midpoint across a
/// face has the two sharers of the face. Therefore each rank can update its border without
/// communication, and two ranks assign the same numbers to new edges and faces.
class Border {
public:
    struct InitialEdge {
        EdgeVertices ends;
        std::vector<std::uint32_t> neighbours;
    };
    struct InitialFace {
        std::array<VertexIndex, 3> vertices;
        std::uint32_t neighbour = 0;
    };
    /// Edges and faces are in the same order on all ranks; the graph has the rows of the edges.
    Border(std::vector<int> neighbours, const std::vector<InitialEdge>& edges,
           const std::vector<InitialFace>& faces);

    [[nodiscard]] const std::vector<int>& neighbours() const { return neighbours_; }
    [[nodiscard]] SharedEdge& edge(SharedEdgeIndex e) { return edges_[e]; }
    /// Returns not_shared if only this rank has the edge.
    [[nodiscard]] SharedEdgeIndex find(const EdgeVertices& edge) const {
        const auto found = edge_of_ends_.find(edge_key(edge));
        return found == edge_of_ends_.end() ? not_shared : found->second;
    }
    [[nodiscard]] SharedEdgeIndex edge_of(const Sharer& sharer) const {
        return edges_of_neighbour_[sharer.neighbour][sharer.number];
    }

    /// Updates the border after the star of a shared edge was bisected; all sharers bisect it
    /// between the same two calls of number_new().
    void bisect(SharedEdgeIndex e, VertexIndex midpoint, CellGraph& graph, const Star& star);
    /// Numbers new edges and faces.
    void number_new();

private:
    using FaceVertices = std::array<VertexIndex, 3>;
    struct SplitFace {
        Sharer parent;
        SharedEdgeIndex across;
        std::array<FaceVertices, 2> halves;
    };
    struct SplitEdge {
        std::vector<Sharer> sharers;
        std::array<SharedEdgeIndex, 2> halves;
        std::vector<SplitFace> faces;
    };

    [[nodiscard]] static FaceVertices sorted(VertexIndex a, VertexIndex b, VertexIndex c);
    SharedEdgeIndex add(const EdgeVertices& ends, std::vector<Sharer> sharers);
    void number(SharedEdgeIndex e, std::uint32_t neighbour);
    void number_faces(SplitEdge& split, std::uint32_t neighbour);

    std::vector<int> neighbours_;
    std::vector<SharedEdge> edges_;
    std::unordered_map<std::uint64_t, SharedEdgeIndex> edge_of_ends_;
    std::map<FaceVertices, Sharer> faces_;
    std::vector<std::vector<SharedEdgeIndex>> edges_of_neighbour_;  // by number
    std::vector<std::uint32_t> face_count_of_neighbour_;
    std::vector<SplitEdge> splits_;
};

}  // namespace octetra::rivals
