#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/value_kind.hpp>

namespace octetra::distributed {

/// The condition for a cell of another process to be a ghost.
enum class GhostsBy {
    face,    ///< it has a face of a cell of this process
    vertex,  ///< it has a vertex of a cell of this process
};

/// A layer of ghosts: cells of other processes around those of this one. A snapshot of the mesh at
/// the time of its creation.
struct GhostLayer {
    struct Owner {
        int rank = 0;
        CellIndex cell;  ///< its local number on that process

        friend auto operator<=>(const Owner&, const Owner&) = default;
    };
    /// Vertices by local number; the vertices of `points` follow those of this process.
    std::vector<CellVertices> cells;
    std::vector<Owner> owners;    ///< of each ghost; ascending
    std::vector<Marker> regions;  ///< of each ghost, or empty where the input has none
    std::vector<Point> points;    ///< of vertices of ghosts that this process does not have
    std::vector<GlobalVertex> vertex_numbers;  ///< the global numbers of `points`, ascending

    /// The cells that this process sends to another rank, and the number of ghosts that it receives
    /// from there. Ghosts are grouped by rank, in the order of `cells`.
    struct Exchange {
        int rank = 0;
        std::vector<CellIndex> sent;
        std::size_t received = 0;
    };
    std::vector<Exchange> exchanges;

    /// Collective. Returns the values of the ghosts, given `components` values for each of this
    /// process's cells. Throws InputError on all processes if the values of one do not fit its
    /// cells, or if two processes pass another T or another number of components.
    template <class T>
    [[nodiscard]] std::vector<T> values(const Communicator& processes, std::span<const T> own,
                                        std::size_t components = 1) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> ghosts;
        const std::size_t count = cells.size() * components;
        exchange(processes, std::as_bytes(own), detail::kind_of<T, CellIndex>(components), [&] {
            ghosts.resize(count);
            return std::as_writable_bytes(std::span(ghosts)).data();
        });
        return ghosts;
    }
    template <class T>
    [[nodiscard]] std::vector<T> values(const Communicator& processes, const std::vector<T>& own,
                                        std::size_t components = 1) const {
        return values(processes, std::span<const T>(own), components);
    }

    std::size_t own_cell_count = 0;  ///< number of cells of this process

private:
    /// allocate() returns the buffer for the values of the ghosts; it is called once.
    void exchange(const Communicator& processes, std::span<const std::byte> own,
                  const detail::ValueKind& kind, const std::function<std::byte*()>& allocate) const;
};

}  // namespace octetra::distributed
