#pragma once

#include <optional>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_numbers.hpp"
#include "numbering/canonical_runs.hpp"
#include "numbering/ordered_lists.hpp"
#include "output/feature_slices.hpp"
#include "output/field_slices.hpp"

namespace octetra::distributed {

/// A distributed mesh in canonical order, as a MeshSource.
class CanonicalSlices final : public MeshSource {
public:
    /// Collective. Refers to the mesh and, if they are known, to the numbers of its vertices.
    explicit CanonicalSlices(const DistributedMesh& mesh, const CanonicalNumbers* known = nullptr);

    /// Adds fields to the output. Refers to them.
    void add(std::span<const Field> fields, const Sharing<VertexIndex>& sharing);

    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] const ProcessGroup& group() const override { return mesh_->processes; }
    [[nodiscard]] const CanonicalNumbers& numbers() const {
        return known_numbers_ != nullptr ? *known_numbers_ : own_numbers_;
    }
    [[nodiscard]] const OrderedLists& lists() const { return lists_; }

    [[nodiscard]] std::span<const Point> points(const Window& window) override;
    [[nodiscard]] std::span<const Marker> point_markers(const Window& window) override;
    [[nodiscard]] std::span<const double> point_attributes(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<2>> midpoint_ends(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window& window) override;
    [[nodiscard]] std::uint64_t cell_digits(const Window& window,
                                            std::uint64_t index_base) override;
    [[nodiscard]] std::uint64_t facet_digits(const Window& window,
                                             std::uint64_t index_base) override;
    [[nodiscard]] std::uint64_t edge_digits(const Window& window,
                                            std::uint64_t index_base) override;
    [[nodiscard]] std::span<const Marker> regions(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> parents(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<3>> facets(const Window& window) override;
    [[nodiscard]] std::span<const Marker> facet_markers(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<2>> edges(const Window& window) override;
    [[nodiscard]] std::span<const Marker> edge_markers(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> features(Feature feature,
                                                          const Window& window) override;
    [[nodiscard]] std::span<const FieldFacts> fields() const override;
    [[nodiscard]] std::span<const std::byte> field_values(std::size_t field,
                                                          const Window& window) override;

private:
    [[nodiscard]] MeshFacts find_facts() const;
    [[nodiscard]] bool sends_short_numbers() const;
    void for_each_vertex(std::uint64_t begin, std::uint64_t end, auto&& emit) const;
    template <class Number, class I, std::size_t N>
    void entity_slice_as(const Window& window,
                         const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
                         const CanonicalRuns& runs, const auto& of_vertex,
                         std::vector<VertexNumbers<N>>& slice) const;
    template <class I, std::size_t N>
    std::span<const VertexNumbers<N>> entity_slice(
        const Window& window, const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
        const CanonicalRuns& runs, std::vector<VertexNumbers<N>>& slice) const;
    template <class I, std::size_t N>
    [[nodiscard]] std::uint64_t digits_in(
        const Window& window, std::uint64_t index_base,
        const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
        const CanonicalRuns& runs) const;
    std::span<const Marker> marker_slice(const Window& window, const AncestorMap& ancestors,
                                         const CanonicalRuns& runs,
                                         std::vector<Marker>& slice) const;

    const DistributedMesh* mesh_;
    OrderedLists lists_;
    const CanonicalNumbers* known_numbers_;
    CanonicalNumbers own_numbers_;  ///< used if none are known
    /// The same numbers in 32 bits if they fit, which halves lookups and messages. Empty on a
    /// single process.
    IndexVector<VertexIndex, std::uint32_t> short_numbers_;
    CanonicalRuns cell_runs_;
    CanonicalRuns facet_runs_;
    CanonicalRuns edge_runs_;
    FeatureSlices features_;
    MeshFacts facts_;
    std::optional<FieldSlices> fields_;

    // The slices requested last.
    std::vector<Point> points_;
    std::vector<Marker> point_markers_;
    std::vector<double> point_attributes_;
    std::vector<VertexNumbers<2>> midpoint_ends_;
    std::vector<VertexNumbers<4>> cells_;
    std::vector<Marker> regions_;
    std::vector<std::uint64_t> parents_;
    std::vector<VertexNumbers<3>> facets_;
    std::vector<Marker> facet_markers_;
    std::vector<VertexNumbers<2>> edges_;
    std::vector<Marker> edge_markers_;
};

}  // namespace octetra::distributed
