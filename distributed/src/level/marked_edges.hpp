#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octetra::distributed {

/// The marked edges of this process during closure. Edges are marked by this process or on behalf
/// of another rank; drain() follows the propagation paths within this part.
class MarkedEdges {
public:
    MarkedEdges() = default;
    virtual ~MarkedEdges() = default;
    MarkedEdges(const MarkedEdges&) = delete;
    MarkedEdges& operator=(const MarkedEdges&) = delete;
    MarkedEdges(MarkedEdges&&) = delete;
    MarkedEdges& operator=(MarkedEdges&&) = delete;

    /// Marks the edge at this position of an interface's list, as requested by the other rank.
    virtual void mark_from(std::size_t interface, std::uint32_t position) = 0;

    /// Marks edges by the closure rule until every cell of this process is closed.
    virtual void drain() = 0;

    [[nodiscard]] virtual std::size_t marked_count() const = 0;

    /// Returns, for each interface, the positions in its list of the edges that were marked since
    /// the last call and that the other rank has not marked itself.
    [[nodiscard]] virtual std::vector<std::vector<std::uint32_t>> take_outboxes() = 0;
};

}  // namespace octetra::distributed
