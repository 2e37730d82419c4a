#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/canonical_mesh.hpp>

namespace octetra::cli {

/// The origin of each cell of this process in an earlier mesh, by that mesh's numbers.
class CellsSince {
public:
    /// Collective. The earlier mesh is the current one.
    explicit CellsSince(const distributed::AdaptiveMesh& mesh);

    /// Not collective. Updates the origins after a refinement step.
    void follow(const distributed::Adaptation& step);
    /// Collective. Updates the origins after a migration.
    void follow(const distributed::Migration& move);

    [[nodiscard]] std::uint64_t vertex_count_before() const { return vertices_; }
    [[nodiscard]] const std::vector<std::uint64_t>& parents() const { return parents_; }

private:
    std::uint64_t vertices_;
    std::vector<std::uint64_t> parents_;
};

/// A source of the maps since an earlier mesh, the parents of cells and the edges of midpoints, and
/// otherwise of the current mesh. For write_maps() and other readers of maps.
class MapsSince final : public MeshSource {
public:
    /// Collective. Refers to the mesh, which must not be modified during its lifetime.
    MapsSince(const distributed::AdaptiveMesh& mesh, const CellsSince& since);

    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] const ProcessGroup& group() const override { return *group_; }
    [[nodiscard]] std::span<const Point> points(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<2>> midpoint_ends(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> parents(const Window& window) override;

private:
    const distributed::Communicator* group_;
    distributed::CanonicalMesh mesh_;
    MeshFacts facts_;
    std::uint64_t midpoints_before_;
    /// The number of a cell of this process and that of the cell of the earlier mesh that contains
    /// it.
    struct CellAndParent {
        std::uint64_t cell;
        std::uint64_t parent;
    };
    std::vector<CellAndParent> own_;      ///< ascending
    std::vector<std::uint64_t> parents_;  ///< buffer of the slice requested last
};

}  // namespace octetra::cli
