#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// The receiving end of the mesh readers: takes a mesh in batches, so that the whole mesh need not
/// be in memory.
namespace octetra {

/// Receives a mesh file from stream_mesh(). For each kind of entity in the file, expect_...() is
/// called once with the number of entities and the data that they have; then take_...() is called
/// with exactly that many entities, in file order, in batches of 1 to max_batch_size. Points
/// precede everything else, whatever the file's order; cells, facets and edges follow in file
/// order, one kind after the other or, for `.msh` files, interleaved. Vertices are numbered from 0
/// and in range; coordinates are finite. Nothing else is checked (ReadOptions::only_syntax).
/// Features are not passed. Spans are valid during the call. If the file is invalid, no further
/// calls are made and stream_mesh() throws; exceptions of a sink propagate as well. The entities
/// received up to then are not a valid mesh.
class MeshSink {
public:
    /// The maximum number of entities in a batch. Batches of points are smaller if these have
    /// attributes.
    static constexpr std::size_t max_batch_size = 16384;

    MeshSink() = default;
    virtual ~MeshSink() = default;
    MeshSink(const MeshSink&) = delete;
    MeshSink& operator=(const MeshSink&) = delete;
    MeshSink(MeshSink&&) = delete;
    MeshSink& operator=(MeshSink&&) = delete;

    virtual void expect_points(std::uint64_t count, std::size_t attributes_per_point,
                               bool has_markers) = 0;
    /// `attributes` has attributes_per_point values for each point; `markers` has one for each
    /// point, or is empty.
    virtual void take_points(std::span<const Point> points, std::span<const double> attributes,
                             std::span<const Marker> markers) = 0;

    virtual void expect_cells(std::uint64_t count, bool has_regions) = 0;
    virtual void take_cells(std::span<const CellVertices> cells,
                            std::span<const Marker> regions) = 0;

    virtual void expect_facets(std::uint64_t count, bool has_markers) = 0;
    virtual void take_facets(std::span<const FacetVertices> facets,
                             std::span<const Marker> markers) = 0;

    virtual void expect_edges(std::uint64_t count, bool has_markers) = 0;
    virtual void take_edges(std::span<const EdgeVertices> edges,
                            std::span<const Marker> markers) = 0;

    /// Called after the whole file has been read without errors. Only now are the index base and
    /// the presence of markers known: where has_... is false, all markers passed were 0, and
    /// read_mesh() would drop them.
    virtual void finish(const MeshFacts& facts) = 0;
};

}  // namespace octetra
