#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The roots that one process sends to another, with their vertices, facets and edges. Vertices are
/// indices into the message; numbers are global numbers of the input, ascending.
struct RootMessage {
    struct Root {
        std::uint64_t number = 0;
        std::array<std::uint32_t, 4> corners{};
        Marker region = 0;
        std::uint32_t cut_bytes = 0;
    };
    template <std::size_t N>
    struct Tagged {
        std::uint64_t number = 0;
        std::array<std::uint32_t, N> vertices{};
        Marker marker = 0;
    };

    std::vector<Root> roots;
    std::vector<std::uint8_t> cuts;  ///< see RootBytes
    std::vector<GlobalVertex> vertices;
    std::vector<Point> points;
    std::vector<Marker> point_markers;  ///< may be empty
    std::vector<double> point_attributes;
    std::vector<Tagged<3>> facets;
    std::vector<Tagged<2>> edges;

    /// Returns no bytes if the message is empty.
    [[nodiscard]] std::vector<std::byte> packed() const;
    [[nodiscard]] static RootMessage unpacked(std::span<const std::byte> bytes);
};

}  // namespace octetra::distributed
