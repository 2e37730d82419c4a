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

/// Which cells of other processes a process gets to see.
enum class GhostsBy {
    face,    ///< those with a face of its cells
    vertex,  ///< those with a vertex of its cells
};

/// A layer of cells that other processes have, around those of this one. A picture of the mesh as
/// it was when it was made.
struct GhostLayer {
    struct Owner {
        int rank = 0;
        CellIndex cell;  ///< its number on that process

        friend auto operator<=>(const Owner&, const Owner&) = default;
    };
    /// Vertices by local number; those of `points` follow behind this process's own.
    std::vector<CellVertices> cells;
    std::vector<Owner> owners;                 ///< of each of these cells; ascending
    std::vector<Marker> regions;               ///< of each, or empty where the input has none
    std::vector<Point> points;                 ///< of vertices that this process does not have
    std::vector<GlobalVertex> vertex_numbers;  ///< theirs, ascending

    /// What this process sends to others, and gets from them: ghosts come by rank, as they stand.
    struct Exchange {
        int rank = 0;
        std::vector<CellIndex> sent;
        std::size_t received = 0;
    };
    std::vector<Exchange> exchanges;

    /// Collective. The values of the ghost cells, of `components` values for each of this process's
    /// cells. Throws InputError on all processes where the values of one do not fit its cells, or
    /// where two processes pass another T or another number of components.
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

    std::size_t own_cell_count = 0;

private:
    /// allocate() makes room for the values of the ghosts; it is called once.
    void exchange(const Communicator& processes, std::span<const std::byte> own,
                  const detail::ValueKind& kind, const std::function<std::byte*()>& allocate) const;
};

}  // namespace octetra::distributed
