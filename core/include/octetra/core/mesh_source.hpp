#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/field.hpp>
#include <octetra/core/index.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>

/// Where the writers of files get a mesh from: slice by slice, so that it need not be in any one
/// memory as a whole, and nothing here need know how processes talk to each other.
namespace octetra {

/// Slices of equal length of the canonical order of a kind of entity, one for each process of a
/// group, by rank. At the end of the order slices are shorter, or empty.
struct Window {
    std::uint64_t begin = 0;         ///< number of the first entity
    std::uint64_t slice_length = 0;  ///< entities of a slice
    std::uint64_t count = 0;         ///< entities of the kind in all
    /// From where a slice begins to where the next one does; 0: slices follow each other.
    std::uint64_t distance = 0;

    [[nodiscard]] std::uint64_t begin_of(int rank) const {
        const std::uint64_t step = distance > 0 ? distance : slice_length;
        return std::min(count, begin + step * static_cast<std::uint64_t>(rank));
    }
    [[nodiscard]] std::uint64_t end_of(int rank) const {
        return std::min(count, begin_of(rank) + slice_length);
    }
    [[nodiscard]] std::uint64_t length_of(int rank) const { return end_of(rank) - begin_of(rank); }
};

/// The slice of one process alone out of a list that it has all of, `per_entity` elements for each
/// entity.
template <class T>
[[nodiscard]] std::span<const T> slice(const std::vector<T>& list, const Window& window,
                                       std::size_t per_entity = 1) {
    const std::uint64_t begin = window.begin_of(0);
    return std::span(list).subspan(begin * per_entity, (window.end_of(0) - begin) * per_entity);
}

/// Everything in the first process's slice.
[[nodiscard]] inline Window whole_window(std::uint64_t count) { return {0, count, count}; }

/// The vertices of an entity by their numbers in the whole mesh, which may be more than 32 bits
/// number: that limits what one process holds only.
template <std::size_t N>
using VertexNumbers = std::array<std::uint64_t, N>;

/// The same for a whole mesh in one memory, of fewer than VertexIndex::limit vertices.
template <std::size_t N>
[[nodiscard]] std::array<VertexIndex, N> indices_of(const VertexNumbers<N>& numbers) {
    std::array<VertexIndex, N> indices;
    for (std::size_t k = 0; k < N; ++k) indices[k] = VertexIndex{numbers[k]};
    return indices;
}

/// What is the same on all processes.
struct MeshFacts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< tagged ones
    std::size_t attributes_per_point = 0;
    std::uint32_t index_base = 0;
    /// Vertices from here on are midpoints; the number of vertices where that is not known.
    std::uint64_t first_midpoint = 0;
    bool has_point_markers = false;
    bool has_regions = false;
    bool has_facet_markers = false;
    bool has_edge_markers = false;
    bool has_parents = false;
    bool has_vertex_numbers = false;
    FeatureCounts features;  ///< of the entities that have each
    SharedGroupNames group_names;
};

/// A mesh in its canonical order, in slices. All functions but facts(), group() and fields() are
/// collective and return this process's slice of a window; it is valid until the same function is
/// called again. Vertices are numbered as in the whole mesh. What facts() does not tell of is not
/// asked for, and need not be overridden.
class MeshSource {
public:
    MeshSource() = default;
    virtual ~MeshSource() = default;
    MeshSource(const MeshSource&) = delete;
    MeshSource& operator=(const MeshSource&) = delete;
    MeshSource(MeshSource&&) = delete;
    MeshSource& operator=(MeshSource&&) = delete;

    [[nodiscard]] virtual const MeshFacts& facts() const = 0;
    [[nodiscard]] virtual const ProcessGroup& group() const { return ProcessGroup::alone(); }

    [[nodiscard]] virtual std::span<const Point> points(const Window& window) = 0;
    [[nodiscard]] virtual std::span<const VertexNumbers<4>> cells(const Window& window) = 0;

    [[nodiscard]] virtual std::span<const Marker> point_markers(const Window&) { return {}; }
    /// attributes_per_point for each vertex of the slice.
    [[nodiscard]] virtual std::span<const double> point_attributes(const Window&) { return {}; }
    /// For vertices that have a number elsewhere: this is it.
    [[nodiscard]] virtual std::span<const std::uint64_t> vertex_numbers(const Window&) {
        return {};
    }
    /// Of a window of midpoints, number 0 being vertex first_midpoint: the ends of the edges that
    /// they halve, smaller first.
    [[nodiscard]] virtual std::span<const VertexNumbers<2>> midpoint_ends(const Window&) {
        return {};
    }

    [[nodiscard]] virtual std::span<const Marker> regions(const Window&) { return {}; }
    /// The cells of the input that the cells lie in.
    [[nodiscard]] virtual std::span<const std::uint64_t> parents(const Window&) { return {}; }

    [[nodiscard]] virtual std::span<const VertexNumbers<3>> facets(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const Marker> facet_markers(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const VertexNumbers<2>> edges(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const Marker> edge_markers(const Window&) { return {}; }

    /// How many decimal digits the vertices of this process's slice have in all, numbered from
    /// `index_base` on.
    [[nodiscard]] virtual std::uint64_t cell_digits(const Window& window, std::uint64_t index_base);
    [[nodiscard]] virtual std::uint64_t facet_digits(const Window& window,
                                                     std::uint64_t index_base);
    [[nodiscard]] virtual std::uint64_t edge_digits(const Window& window, std::uint64_t index_base);

    /// Of a window of the entities that have the feature, MeshFacts::features of them: their
    /// numbers, ascending.
    [[nodiscard]] virtual std::span<const std::uint64_t> features(Feature, const Window&) {
        return {};
    }

    /// The fields that go with the mesh, and their values on a window of vertices or cells: as many
    /// bytes for each as FieldFacts tell.
    [[nodiscard]] virtual std::span<const FieldFacts> fields() const { return {}; }
    [[nodiscard]] virtual std::span<const std::byte> field_values(std::size_t /*field*/,
                                                                  const Window& /*window*/) {
        return {};
    }
};

/// A mesh that this process has all of. Refers to the mesh, and to the maps if there are any.
class WholeMesh final : public MeshSource {
public:
    explicit WholeMesh(const Mesh& mesh, const RefinementMaps* maps = nullptr);

    [[nodiscard]] const MeshFacts& facts() const override { return facts_; }
    [[nodiscard]] std::span<const Point> points(const Window& window) override;
    [[nodiscard]] std::span<const Marker> point_markers(const Window& window) override;
    [[nodiscard]] std::span<const double> point_attributes(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<2>> midpoint_ends(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<4>> cells(const Window& window) override;
    [[nodiscard]] std::span<const Marker> regions(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> parents(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<3>> facets(const Window& window) override;
    [[nodiscard]] std::span<const Marker> facet_markers(const Window& window) override;
    [[nodiscard]] std::span<const VertexNumbers<2>> edges(const Window& window) override;
    [[nodiscard]] std::span<const Marker> edge_markers(const Window& window) override;
    [[nodiscard]] std::span<const std::uint64_t> features(Feature feature,
                                                          const Window& window) override;

private:
    const Mesh* mesh_;
    const RefinementMaps* maps_;
    MeshFacts facts_;

    // What was asked for last.
    std::vector<VertexNumbers<2>> midpoint_ends_;
    std::vector<VertexNumbers<4>> cells_;
    std::vector<std::uint64_t> parents_;
    std::vector<VertexNumbers<3>> facets_;
    std::vector<VertexNumbers<2>> edges_;
};

}  // namespace octetra
