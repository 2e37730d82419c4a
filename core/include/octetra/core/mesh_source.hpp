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

/// The interface through which writers obtain a mesh slice by slice, so that it need not be in the
/// memory of a single process, and writers are independent of the communication between processes.
namespace octetra {

/// One slice for each process of a group, by rank, of the canonical order of a kind of entity. All
/// slices have the same length, except that they are shorter or empty at the end of the order.
struct Window {
    std::uint64_t begin = 0;         ///< number of the first entity
    std::uint64_t slice_length = 0;  ///< entities in a slice
    std::uint64_t count = 0;         ///< total number of entities of the kind
    /// Distance between the starts of consecutive slices; 0 means that slices are contiguous.
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

/// Returns the slice of the only process of a group from a complete list with `per_entity` elements
/// for each entity.
template <class T>
[[nodiscard]] std::span<const T> slice(const std::vector<T>& list, const Window& window,
                                       std::size_t per_entity = 1) {
    const std::uint64_t begin = window.begin_of(0);
    return std::span(list).subspan(begin * per_entity, (window.end_of(0) - begin) * per_entity);
}

/// Returns a window whose first slice contains everything.
[[nodiscard]] inline Window whole_window(std::uint64_t count) { return {0, count, count}; }

/// Global vertex numbers of an entity. They may exceed 32 bits, which limit only the entities of
/// one process.
template <std::size_t N>
using VertexNumbers = std::array<std::uint64_t, N>;

/// Converts to local indices, for a whole mesh in one process with fewer than VertexIndex::limit
/// vertices.
template <std::size_t N>
[[nodiscard]] std::array<VertexIndex, N> indices_of(const VertexNumbers<N>& numbers) {
    std::array<VertexIndex, N> indices;
    for (std::size_t k = 0; k < N; ++k) indices[k] = VertexIndex{numbers[k]};
    return indices;
}

/// Properties of a mesh that are identical on all processes.
struct MeshFacts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< tagged ones
    std::size_t attributes_per_point = 0;
    std::uint32_t index_base = 0;
    /// Index of the first midpoint; equal to the number of vertices if not known.
    std::uint64_t first_midpoint = 0;
    bool has_point_markers = false;
    bool has_regions = false;
    bool has_facet_markers = false;
    bool has_edge_markers = false;
    bool has_parents = false;
    bool has_vertex_numbers = false;
    FeatureCounts features;  ///< number of entities with each feature
    SharedGroupNames group_names;
};

/// A mesh in its canonical order, read in slices. All functions except facts(), group() and
/// fields() are collective and return this process's slice of a window, valid until the next call
/// of the same function. Vertices have global numbers. Data that facts() does not announce is never
/// requested, and the functions for it need not be overridden.
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
    /// Returns attributes_per_point values for each vertex of the slice.
    [[nodiscard]] virtual std::span<const double> point_attributes(const Window&) { return {}; }
    /// Returns the numbers of the vertices in another numbering, if MeshFacts::has_vertex_numbers.
    [[nodiscard]] virtual std::span<const std::uint64_t> vertex_numbers(const Window&) {
        return {};
    }
    /// For a window of midpoints, in which number 0 is vertex first_midpoint: returns the ends of
    /// the edges that they bisect, smaller end first.
    [[nodiscard]] virtual std::span<const VertexNumbers<2>> midpoint_ends(const Window&) {
        return {};
    }

    [[nodiscard]] virtual std::span<const Marker> regions(const Window&) { return {}; }
    /// Returns, for each cell, the cell of the input that contains it.
    [[nodiscard]] virtual std::span<const std::uint64_t> parents(const Window&) { return {}; }

    [[nodiscard]] virtual std::span<const VertexNumbers<3>> facets(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const Marker> facet_markers(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const VertexNumbers<2>> edges(const Window&) { return {}; }
    [[nodiscard]] virtual std::span<const Marker> edge_markers(const Window&) { return {}; }

    /// Returns the total number of decimal digits of the vertex numbers in this process's slice,
    /// numbered from `index_base`.
    [[nodiscard]] virtual std::uint64_t cell_digits(const Window& window, std::uint64_t index_base);
    [[nodiscard]] virtual std::uint64_t facet_digits(const Window& window,
                                                     std::uint64_t index_base);
    [[nodiscard]] virtual std::uint64_t edge_digits(const Window& window, std::uint64_t index_base);

    /// For a window of the entities that have the feature (MeshFacts::features gives their number):
    /// returns their numbers, ascending.
    [[nodiscard]] virtual std::span<const std::uint64_t> features(Feature, const Window&) {
        return {};
    }

    /// The fields of the mesh, and their values on a window of vertices or cells, of the type and
    /// number of components that FieldFacts states.
    [[nodiscard]] virtual std::span<const FieldFacts> fields() const { return {}; }
    [[nodiscard]] virtual std::span<const std::byte> field_values(std::size_t /*field*/,
                                                                  const Window& /*window*/) {
        return {};
    }
};

/// A mesh held entirely by this process. Refers to the mesh and to the maps, if given.
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

    // Buffers of the slices requested last.
    std::vector<VertexNumbers<2>> midpoint_ends_;
    std::vector<VertexNumbers<4>> cells_;
    std::vector<std::uint64_t> parents_;
    std::vector<VertexNumbers<3>> facets_;
    std::vector<VertexNumbers<2>> edges_;
};

}  // namespace octetra
