#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// Where the readers of files put a mesh: stretch by stretch, so that it need not be in memory as a
/// whole.
namespace octetra {

/// Hears a mesh file from stream_mesh(). Of each kind that the file has it is told once how many
/// are to come and with what, and then they come: exactly as many, in the order of the file, in
/// stretches of 1 to longest_stretch. Points come before all else, whatever the file's order;
/// cells, facets and edges follow as the file has them, one kind after the other or, in `.msh`
/// files, by turns. Vertices are numbered from 0, and in range; coordinates are finite. Nothing
/// else is checked (ReadOptions::only_syntax). Of features a sink hears nothing. Spans are valid
/// during the call. Where the file turns out bad, nothing further comes and stream_mesh() throws,
/// as it does what a sink throws: what was heard then is not a mesh.
class MeshSink {
public:
    /// Of points, fewer come at once the more attributes they have.
    static constexpr std::size_t longest_stretch = 16384;

    MeshSink() = default;
    virtual ~MeshSink() = default;
    MeshSink(const MeshSink&) = delete;
    MeshSink& operator=(const MeshSink&) = delete;
    MeshSink(MeshSink&&) = delete;
    MeshSink& operator=(MeshSink&&) = delete;

    virtual void expect_points(std::uint64_t count, std::size_t attributes_per_point,
                               bool has_markers) = 0;
    /// attributes_per_point attributes and, if there are markers, one of these for each point.
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

    /// The file is read to its end and is good. Only now it is known what the file calls the first
    /// entity, and whether markers mean something: where has_... is false, those that came are all
    /// 0 and read_mesh() would drop them.
    virtual void finish(const MeshFacts& facts) = 0;
};

}  // namespace octetra
