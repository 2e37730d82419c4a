#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "rivals/cell_graph.hpp"

/// What a rank shares with others, kept up to date as they bisect the same edges as it does.
namespace octetra::rivals {

using SharedEdgeIndex = std::uint32_t;
inline constexpr SharedEdgeIndex not_shared = std::numeric_limits<SharedEdgeIndex>::max();

/// Another rank that has an edge or a face.
struct Sharer {
    std::uint32_t neighbour = 0;  ///< a place in Border::neighbours()
    std::uint32_t number = 0;     ///< by which the two ranks know it
};

struct SharedEdge {
    EdgeVertices ends;  ///< in an order that all ranks have in common
    std::vector<Sharer> sharers;
    bool is_wanted = false;
    std::uint32_t ready_ranks = 0;  ///< of those that have it, this one included
};

/// The edges and faces that cells of several ranks have. An edge may be of any number of ranks, a
/// face is of two. Halves of an edge are of the ranks that have it; an edge from its midpoint
/// across a face is of the two that have the face. So what becomes of the border each rank knows
/// without being told, and two ranks give new edges and faces the same numbers.
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
    /// Edges and faces stand in an order that all ranks have in common; the graph knows the rows of
    /// the edges.
    Border(std::vector<int> neighbours, const std::vector<InitialEdge>& edges,
           const std::vector<InitialFace>& faces);

    [[nodiscard]] const std::vector<int>& neighbours() const { return neighbours_; }
    [[nodiscard]] SharedEdge& edge(SharedEdgeIndex e) { return edges_[e]; }
    /// not_shared, if it is this rank's alone.
    [[nodiscard]] SharedEdgeIndex find(const EdgeVertices& edge) const {
        const auto found = edge_of_ends_.find(edge_key(edge));
        return found == edge_of_ends_.end() ? not_shared : found->second;
    }
    [[nodiscard]] SharedEdgeIndex edge_of(const Sharer& sharer) const {
        return edges_of_neighbour_[sharer.neighbour][sharer.number];
    }

    /// A star was bisected whose edge is shared; all its ranks do so between the same two calls of
    /// number_new().
    void bisect(SharedEdgeIndex e, VertexIndex midpoint, CellGraph& graph, const Star& star);
    /// Numbers what has come to be.
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
