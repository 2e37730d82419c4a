#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "comm/local_failure.hpp"
#include "history/collapse.hpp"

namespace octetra::distributed {

/// The vertices that stay when a mesh becomes coarser, found step by step from the last.
class KeptVertices {
public:
    /// Those of the input.
    explicit KeptVertices(const DistributedMesh& mesh);

    void keep(const CellVertices& cell) {
        for (const VertexIndex v : cell) kept_[v] = 1;
    }
    /// With the midpoints of a step that stay, keeps those of the longest edges of faces.
    void close(const std::vector<CollapsedCell>& cut);

    /// What stays and was not told yet, for each interface: positions that both sides know.
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> take_outboxes();
    void keep_from(std::size_t interface, std::uint32_t position);

    [[nodiscard]] bool has(VertexIndex v) const { return kept_[v] != 0; }
    /// Of the edges that a step bisected, those whose midpoints stay.
    [[nodiscard]] EdgeMask kept_edges(const CollapsedCell& cell) const;

private:
    IndexVector<VertexIndex, std::uint8_t> kept_;
    struct Shared {
        std::vector<VertexIndex> vertices;  ///< both sides have them in this order
        std::vector<std::uint8_t> told;
    };
    std::vector<Shared> shared_;  ///< by interface
};

/// Collective. Closes what all processes keep of a step's midpoints. False where a process has
/// failed; `kept` may be null on that one.
[[nodiscard]] bool close_together(KeptVertices* kept, const std::vector<CollapsedCell>& cut,
                                  const DistributedMesh& mesh, LocalFailure& failure);

}  // namespace octetra::distributed
