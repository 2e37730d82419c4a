#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octetra::distributed {

/// The marked edges of this process, on their way to closure. Edges are marked by the process
/// itself or on another's word; drain() follows the propagation paths as far as they go here.
class Closure {
public:
    Closure() = default;
    virtual ~Closure() = default;
    Closure(const Closure&) = delete;
    Closure& operator=(const Closure&) = delete;
    Closure(Closure&&) = delete;
    Closure& operator=(Closure&&) = delete;

    /// Marks the edge at this position of an interface's list, on the other side's word.
    virtual void mark_from(std::size_t interface, std::uint32_t position) = 0;

    /// Marks what the rule asks for, until every cell of this process is closed.
    virtual void drain() = 0;

    [[nodiscard]] virtual std::size_t marked_count() const = 0;

    /// Positions in each interface's list of the edges that were marked since they were last
    /// taken and that the other side has not told of.
    [[nodiscard]] virtual std::vector<std::vector<std::uint32_t>> take_outboxes() = 0;
};

}  // namespace octetra::distributed
