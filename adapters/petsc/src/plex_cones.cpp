#include "plex_cones.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "check_petsc.hpp"

namespace octetra::petsc {
namespace {

using Places = std::array<std::uint8_t, 3>;

/// The faces of a cell in PETSc's order, with their vertices in PETSc's order, as local positions
/// in the cell of the mesh: the first two vertices are exchanged in PETSc.
constexpr std::array<Places, 4> plex_faces{{{1, 0, 2}, {1, 3, 0}, {1, 2, 3}, {2, 0, 3}}};
/// The face of the mesh's cell for each of these, given by the opposite vertex.
constexpr std::array<std::uint8_t, 4> opposite{3, 2, 0, 1};

/// The orders of a triangle's vertices relative to its cone, indexed by PETSc's orientation plus 3.
constexpr std::array<Places, 6> triangle_orders{
    {{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};

PetscInt orientation_of(const std::array<VertexIndex, 3>& seen) {
    Places places{};
    for (std::size_t k = 0; k < 3; ++k) {
        places[k] = static_cast<std::uint8_t>(
            std::ranges::count_if(seen, [&](VertexIndex v) { return v < seen[k]; }));
    }
    const auto found = std::ranges::find(triangle_orders, places);
    return static_cast<PetscInt>(found - triangle_orders.begin()) - 3;
}

/// Returns the index in cell_edges of the edge between two local positions.
std::uint8_t edge_between(std::uint8_t i, std::uint8_t j) {
    const auto [low, high] = std::minmax(i, j);
    const std::array<std::uint8_t, 2> ends{low, high};
    return static_cast<std::uint8_t>(std::ranges::find(cell_edges, ends) - cell_edges.begin());
}

/// Access to PETSc's arrays of all cones, in the order of points.
class Cones {
public:
    Cones(DM plex, const PlexPoints& points) : points_(points) {
        check(DMPlexGetCones(plex, &points_in_));
        check(DMPlexGetConeOrientations(plex, &orientations_));
        faces_begin_ = 4 * std::size_t(points.first_vertex);
        edges_begin_ = faces_begin_ + 3 * std::size_t(points.first_edge - points.first_face);
    }

    void set_edge(EdgeIndex e, const EdgeVertices& vertices) {
        for (std::size_t k = 0; k < 2; ++k) {
            set(edges_begin_ + 2 * std::size_t(e.value()) + k, points_.of(vertices[k]), 0);
        }
    }
    /// Sets the faces of a cell, and the edges of these.
    void set_cell(CellIndex c, const CellVertices& cell, const auto& faces, const auto& edges) {
        for (std::size_t side = 0; side < 4; ++side) {
            const Places& places = plex_faces[side];
            const distributed::FaceIndex face = faces[opposite[side]];
            set(4 * std::size_t(c.value()) + side, points_.of(face),
                orientation_of({cell[places[0]], cell[places[1]], cell[places[2]]}));
            set_face(face, cell, places, edges);
        }
    }

private:
    /// Sets the edges of a face from the lowest vertex to the next, to the highest, and back; the
    /// last edge is traversed against its direction.
    void set_face(distributed::FaceIndex f, const CellVertices& cell, Places places,
                  const auto& edges) {
        std::ranges::sort(places, {}, [&](std::uint8_t place) { return cell[place]; });
        for (std::size_t k = 0; k < 3; ++k) {
            const EdgeIndex e = edges[edge_between(places[k], places[(k + 1) % 3])];
            set(faces_begin_ + 3 * std::size_t(f.value()) + k, points_.of(e), k == 2 ? -1 : 0);
        }
    }
    void set(std::size_t place, PetscInt point, PetscInt orientation) {
        points_in_[place] = point;
        orientations_[place] = orientation;
    }

    PlexPoints points_;
    PetscInt* points_in_ = nullptr;
    PetscInt* orientations_ = nullptr;
    std::size_t faces_begin_ = 0;
    std::size_t edges_begin_ = 0;
};

}  // namespace

void set_cones(DM plex, const PlexPoints& points, const distributed::AdaptiveMesh& mesh,
               const distributed::MeshFaces& faces, const distributed::MeshEdges& edges) {
    check(DMPlexSetChart(plex, 0, points.end));
    for (PetscInt p = 0; p < points.first_vertex; ++p) check(DMPlexSetConeSize(plex, p, 4));
    for (PetscInt p = points.first_face; p < points.first_edge; ++p) {
        check(DMPlexSetConeSize(plex, p, 3));
    }
    for (PetscInt p = points.first_edge; p < points.end; ++p) check(DMPlexSetConeSize(plex, p, 2));
    check(DMSetUp(plex));
    Cones cones(plex, points);
    for (EdgeIndex e{0}; e < edges.vertices.end_index(); ++e) cones.set_edge(e, edges.vertices[e]);
    for (CellIndex c{0}; c < faces.of_cell.end_index(); ++c) {
        cones.set_cell(c, mesh.cells()[c.value()], faces.of_cell[c], edges.of_cell[c]);
    }
    check(DMPlexSymmetrize(plex));
    check(DMPlexStratify(plex));
}

}  // namespace octetra::petsc
