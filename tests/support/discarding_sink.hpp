#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <octetra/core/files/mesh_sink.hpp>

namespace octetra::test {

/// Discards a mesh.
class DiscardingSink final : public MeshSink {
public:
    void expect_points(std::uint64_t, std::size_t, bool) override {}
    void take_points(std::span<const Point>, std::span<const double>,
                     std::span<const Marker>) override {}
    void expect_cells(std::uint64_t, bool) override {}
    void take_cells(std::span<const CellVertices>, std::span<const Marker>) override {}
    void expect_facets(std::uint64_t, bool) override {}
    void take_facets(std::span<const FacetVertices>, std::span<const Marker>) override {}
    void expect_edges(std::uint64_t, bool) override {}
    void take_edges(std::span<const EdgeVertices>, std::span<const Marker>) override {}
    void finish(const MeshFacts&) override {}
};

}  // namespace octetra::test
