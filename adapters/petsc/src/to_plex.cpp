#include <octetra/petsc/to_plex.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <petscsf.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>

#include "check_petsc.hpp"
#include "plex_cones.hpp"
#include "plex_labels.hpp"

namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::MeshEdges;
using distributed::MeshFaces;
using distributed::Sharing;

/// Owns a plex under construction, and destroys it unless it is completed.
class NewPlex {
public:
    explicit NewPlex(MPI_Comm comm) {
        check(DMPlexCreate(comm, &plex_));
        check(DMSetDimension(plex_, 3));
        // Prevents DMSetFromOptions() from distributing the plex again.
        check(DMPlexDistributeSetDefault(plex_, PETSC_FALSE));
    }
    ~NewPlex() {
        if (plex_ != nullptr) (void)DMDestroy(&plex_);
    }
    NewPlex(const NewPlex&) = delete;
    NewPlex& operator=(const NewPlex&) = delete;
    NewPlex(NewPlex&&) = delete;
    NewPlex& operator=(NewPlex&&) = delete;

    [[nodiscard]] DM get() const { return plex_; }
    [[nodiscard]] DM release() { return std::exchange(plex_, nullptr); }

private:
    DM plex_ = nullptr;
};

PlexPoints points_for(const AdaptiveMesh& mesh, const MeshFaces& faces, const MeshEdges& edges) {
    const std::uint64_t count = std::uint64_t{mesh.cells().size()} + mesh.points().size() +
                                faces.vertices.size() + edges.vertices.size();
    if (count > static_cast<std::uint64_t>(std::numeric_limits<PetscInt>::max())) {
        throw InputError(fmt::format("rank {}: {} points are too many for PETSc's integers",
                                     mesh.processes().rank(), count));
    }
    PlexPoints points;
    points.first_vertex = static_cast<PetscInt>(mesh.cells().size());
    points.first_face = points.first_vertex + static_cast<PetscInt>(mesh.points().size());
    points.first_edge = points.first_face + static_cast<PetscInt>(faces.vertices.size());
    points.end = points.first_edge + static_cast<PetscInt>(edges.vertices.size());
    return points;
}

/// Not collective.
void set_coordinates(DM plex, const PlexPoints& points, std::span<const Point> coordinates) {
    check(DMSetCoordinateDim(plex, 3));
    PetscSection section = nullptr;
    check(DMGetCoordinateSection(plex, &section));
    check(PetscSectionSetNumFields(section, 1));
    check(PetscSectionSetFieldComponents(section, 0, 3));
    check(PetscSectionSetChart(section, points.first_vertex, points.first_face));
    for (PetscInt p = points.first_vertex; p < points.first_face; ++p) {
        check(PetscSectionSetDof(section, p, 3));
        check(PetscSectionSetFieldDof(section, p, 0, 3));
    }
    check(PetscSectionSetUp(section));
    Vec values = nullptr;
    check(VecCreateSeq(PETSC_COMM_SELF, 3 * static_cast<PetscInt>(coordinates.size()), &values));
    const auto fill = [&] {
        check(VecSetBlockSize(values, 3));
        check(PetscObjectSetName(reinterpret_cast<PetscObject>(values), "coordinates"));
        PetscScalar* numbers = nullptr;
        check(VecGetArrayWrite(values, &numbers));
        for (const Point& p : coordinates) {
            for (const double x : {p.x, p.y, p.z}) *numbers++ = x;
        }
        numbers -= 3 * coordinates.size();
        check(VecRestoreArrayWrite(values, &numbers));
        check(DMSetCoordinatesLocal(plex, values));
    };
    try {
        fill();
    } catch (...) {
        (void)VecDestroy(&values);
        throw;
    }
    check(VecDestroy(&values));
}

/// The shared points owned by other processes, and their owners' points.
struct Leaves {
    std::vector<PetscInt> here;
    std::vector<PetscSFNode> there;
};

/// Collective. Adds the leaves of one kind of entity, whose first point is `first`; owners send
/// their points.
template <class I>
void add_leaves(const Communicator& processes, const Sharing<I>& sharing, std::size_t count,
                PetscInt first, Leaves& leaves) {
    std::vector<PetscInt> points;
    processes.transaction([&] {
        points.resize(count);
        for (std::size_t i = 0; i < count; ++i) points[i] = first + static_cast<PetscInt>(i);
    });
    distributed::update_copies(processes, sharing, count, points);
    processes.transaction([&] {
        for (const I i : sharing.shared()) {
            const int owner = sharing.owner(i);
            if (owner == processes.rank()) continue;
            leaves.here.push_back(first + static_cast<PetscInt>(i.value()));
            leaves.there.push_back({owner, points[i.value()]});
        }
    });
}

/// Collective.
void set_sharing(DM plex, const PlexPoints& points, const AdaptiveMesh& mesh,
                 const MeshFaces& faces, const MeshEdges& edges) {
    const Communicator& processes = mesh.processes();
    if (processes.size() == 1) return;
    Leaves leaves;
    add_leaves(processes, mesh.vertex_sharing(), mesh.points().size(), points.first_vertex, leaves);
    add_leaves(processes, faces.sharing, faces.vertices.size(), points.first_face, leaves);
    add_leaves(processes, edges.sharing, edges.vertices.size(), points.first_edge, leaves);
    PetscSF sharers = nullptr;
    check(DMGetPointSF(plex, &sharers));
    check(PetscSFSetGraph(sharers, points.end, static_cast<PetscInt>(leaves.here.size()),
                          leaves.here.data(), PETSC_COPY_VALUES, leaves.there.data(),
                          PETSC_COPY_VALUES));
    check(PetscSFSetUp(sharers));
}

/// Collective. Labels the listed sides on all processes that have them. Vertices of sides and of
/// the list are local; sides ascend.
template <class I, std::size_t N, std::size_t PerCell>
void label_sides(DM plex, const Communicator& processes,
                 const distributed::Sides<I, N, PerCell>& sides, PetscInt first,
                 std::span<const std::array<VertexIndex, N>> listed, auto&& markers_of_listed,
                 const std::string& name) {
    if (name.empty() || processes.sum(listed.size()) == 0) return;
    constexpr auto none = std::numeric_limits<std::int64_t>::min();
    std::vector<std::int64_t> of_side;
    processes.transaction([&] {
        const std::vector<Marker> markers = markers_of_listed();
        of_side.assign(sides.vertices.size(), none);
        for (std::size_t i = 0; i < listed.size(); ++i) {
            auto corners = listed[i];
            std::ranges::sort(corners);
            const auto found = std::ranges::lower_bound(sides.vertices, corners);
            of_side[static_cast<std::size_t>(found - sides.vertices.begin())] =
                markers.empty() ? 0 : markers[i];
        }
    });
    distributed::combine_everywhere(processes, sides.sharing, of_side.size(), of_side,
                                    [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
    processes.transaction([&] {
        std::vector<MarkedPoint> marked;
        for (std::size_t i = 0; i < of_side.size(); ++i) {
            if (of_side[i] == none) continue;
            marked.push_back({first + static_cast<PetscInt>(i), static_cast<Marker>(of_side[i])});
        }
        set_label(plex, name, marked);
    });
}

/// Collective.
void label_cells(DM plex, const AdaptiveMesh& mesh, const std::string& name) {
    std::vector<Marker> regions;
    mesh.processes().transaction([&] { regions = mesh.regions(); });
    if (name.empty() || mesh.processes().sum(regions.size()) == 0) return;
    mesh.processes().transaction([&] {
        std::vector<MarkedPoint> marked;
        marked.reserve(regions.size());
        for (std::size_t c = 0; c < regions.size(); ++c) {
            marked.push_back({PlexPoints::of(CellIndex{c}), regions[c]});
        }
        set_label(plex, name, marked);
    });
}

/// Collective.
void label_boundary(DM plex, const AdaptiveMesh& mesh, const MeshFaces& faces, PetscInt first,
                    const std::string& name) {
    if (name.empty()) return;
    mesh.processes().transaction([&] {
        std::vector<MarkedPoint> marked;
        for (const distributed::BoundaryFace& one : mesh.boundary()) {
            const auto number = faces.of_cell[one.cell][one.face].value();
            marked.push_back({first + static_cast<PetscInt>(number), 1});
        }
        std::ranges::sort(marked, {}, &MarkedPoint::point);
        set_label(plex, name, marked);
    });
}

}  // namespace

PlexPoints points_of(DM plex) {
    const SilentErrors silent;
    PlexPoints points;
    check(DMPlexGetDepthStratum(plex, 0, &points.first_vertex, &points.first_face));
    check(DMPlexGetDepthStratum(plex, 1, &points.first_edge, &points.end));
    return points;
}

DM to_plex(const AdaptiveMesh& mesh, MPI_Comm comm, const PlexLabels& labels) {
    const Communicator& processes = mesh.processes();
    processes.transaction([&] { check_group(processes, comm); });
    const SilentErrors silent;
    const MeshFaces faces = mesh.number_faces();
    const MeshEdges edges = mesh.number_edges();
    PlexPoints points;
    processes.transaction([&] { points = points_for(mesh, faces, edges); });
    NewPlex plex(comm);
    processes.transaction([&] {
        set_cones(plex.get(), points, mesh, faces, edges);
        set_coordinates(plex.get(), points, mesh.points());
    });
    set_sharing(plex.get(), points, mesh, faces, edges);
    label_cells(plex.get(), mesh, labels.cells);
    label_sides(
        plex.get(), processes, faces, points.first_face, mesh.facets(),
        [&] { return mesh.facet_markers(); }, labels.faces);
    label_sides(
        plex.get(), processes, edges, points.first_edge, mesh.edges(),
        [&] { return mesh.edge_markers(); }, labels.edges);
    label_boundary(plex.get(), mesh, faces, points.first_face, labels.boundary);
    return plex.release();
}

}  // namespace octetra::petsc
