#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/canonical_mesh.hpp>

namespace octetra::cli {

/// What each cell of this process was in the mesh as it once was, by that mesh's numbers.
class CellsSince {
public:
    /// Collective. Of the mesh as it is now.
    explicit CellsSince(const distributed::AdaptiveMesh& mesh);

    /// Not collective. Follows a step of refinement.
    void follow(const distributed::Adaptation& step);
    /// Collective. Follows cells that went to other processes.
    void follow(const distributed::Migration& move);

    [[nodiscard]] std::uint64_t vertex_count_before() const { return vertices_; }
    [[nodiscard]] const std::vector<std::uint64_t>& parents() const { return parents_; }

private:
    std::uint64_t vertices_;
    std::vector<std::uint64_t> parents_;
};

/// The parents of cells and the edges of midpoints since then; else the mesh as it is. For
/// write_maps(), and who else reads maps.
class MapsSince final : public MeshSource {
public:
    /// Collective. Refers to the mesh, which must not be refined meanwhile.
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
    /// A cell of this process by its number now, with that of the one that it lay in.
    struct CellAndParent {
        std::uint64_t cell;
        std::uint64_t parent;
    };
    std::vector<CellAndParent> own_;      ///< ascending
    std::vector<std::uint64_t> parents_;  ///< that were asked for last
};

}  // namespace octetra::cli
