#pragma once

#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"
#include "numbering/ordered_lists.hpp"

namespace octetra::distributed {

/// The part of this process as a MeshSource, in its own order and with local indices. Tagged facets
/// and edges are only counted.
class OwnPiece final : public MeshSource {
public:
    /// Collective. `whole` are the facts of the whole mesh. Refers to the mesh, its lists and the
    /// numbers.
    OwnPiece(const DistributedMesh& mesh, const OrderedLists& lists,
             const CanonicalNumbers& numbers, const MeshFacts& whole);

    /// Collective. Adds fields to the output; copies of shared vertices get the owners' values.
    void add(std::span<const Field> fields, const Sharing<VertexIndex>& sharing);

    // Not collective:
    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] std::span<const Point> points(const Window& window) override;
    [[nodiscard]] std::span<const Marker> point_markers(const Window& window) override;
    [[nodiscard]] std::span<const double> point_attributes(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> vertex_numbers(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window& window) override;
    [[nodiscard]] std::span<const Marker> regions(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> parents(const Window& window) override;
    [[nodiscard]] std::span<const FieldFacts> fields() const override { return field_facts_; }
    [[nodiscard]] std::span<const std::byte> field_values(std::size_t field,
                                                          const Window& window) override;

private:
    void add(const Field& field, const Sharing<VertexIndex>& sharing);

    const DistributedMesh* mesh_;
    const OrderedLists* lists_;
    const CanonicalNumbers* numbers_;
    MeshFacts facts_;
    std::vector<Marker> point_markers_;  ///< of all vertices of the piece
    std::vector<std::uint64_t> vertex_numbers_;
    std::vector<VertexNumbers<4>> cells_;
    std::vector<Marker> regions_;
    std::vector<std::uint64_t> parents_;
    std::vector<FieldFacts> field_facts_;
    std::vector<std::vector<std::byte>> field_values_;  ///< in the order of the piece
};

}  // namespace octetra::distributed
