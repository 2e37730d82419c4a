#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "assemble/cut_bytes.hpp"
#include "assemble/root_message.hpp"

namespace octetra::distributed {

/// The part of the input that a process has, and the destination rank of each entity, which may be
/// this rank.
struct Departures {
    DistributedMesh input;
    CutRoots cuts;  ///< patterns of the roots in all steps
    std::vector<int> rank_of_root;
    std::vector<int> rank_of_facet;  ///< that of the first cell that has the facet
    std::vector<int> rank_of_edge;   ///< likewise
};

/// Determines the destinations of tagged facets and edges. Those of no cell stay on this rank. Not
/// collective.
[[nodiscard]] Departures departures_of(DistributedMesh input, CutRoots cuts,
                                       std::vector<int> rank_of_root);

/// Makes the messages of a process, one at a time. Not collective.
class MessageMaker {
public:
    /// The departures must outlive this object.
    explicit MessageMaker(const Departures& departures);

    /// Returns the roots whose destination is this rank, with the vertices and tagged entities at
    /// them, and further vertices that are at none of them.
    [[nodiscard]] RootMessage message_to(int rank,
                                         std::span<const VertexIndex> further_vertices = {});

private:
    using Indices = std::vector<std::uint32_t>;

    void put_vertices(int rank, std::span<const VertexIndex> further, RootMessage& message);
    void put_roots(const Indices& roots, RootMessage& message) const;

    const DistributedMesh* input_;
    const std::vector<std::uint8_t>* cuts_;
    std::vector<std::size_t> cut_begin_;  ///< offset for each root, and the end
    std::vector<std::uint32_t> index_;    ///< index of each vertex in the current message
    std::vector<int> last_message_;       ///< the last message that contains the vertex
    std::vector<Indices> roots_;          ///< for each rank
    std::vector<Indices> facets_;
    std::vector<Indices> edges_;
};

/// Returns a packed RootMessage to each process; empty for this one, and for those that receive no
/// root. Not collective.
[[nodiscard]] std::vector<std::vector<std::byte>> packed_messages(const Departures& departures);

}  // namespace octetra::distributed
