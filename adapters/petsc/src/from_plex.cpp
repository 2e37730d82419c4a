#include <octetra/petsc/from_plex.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <petscis.h>
#include <petscsf.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/distributed/mpi.hpp>

#include "check_petsc.hpp"
#include "plex_labels.hpp"

namespace octetra::petsc {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::MeshPart;

struct Range {
    PetscInt begin = 0;
    PetscInt end = 0;

    [[nodiscard]] bool contains(PetscInt p) const { return p >= begin && p < end; }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - begin); }
};

/// Reads the part of a plex on this process: its strata, and the global vertex numbers.
class PlexReader {
public:
    /// Collective.
    explicit PlexReader(DM plex, const Communicator& processes) : plex_(plex) {
        processes.transaction([&] { check_kind(); });
        check(DMGetCoordinatesLocalSetUp(plex_));
        check(DMPlexGetVertexNumbering(plex_, &numbering_));
        processes.transaction([&] { find_cells(); });
    }

    [[nodiscard]] DM plex() const { return plex_; }
    [[nodiscard]] const Range& vertices() const { return vertices_; }
    [[nodiscard]] const Range& faces() const { return faces_; }
    [[nodiscard]] const Range& edges() const { return edges_; }
    /// Returns the cells owned by this process.
    [[nodiscard]] const std::vector<PetscInt>& cells() const { return cells_; }
    [[nodiscard]] bool is_own_cell(PetscInt p) const {
        return std::ranges::binary_search(cells_, p);
    }

    /// Returns the global number of each vertex of this process, by point.
    [[nodiscard]] std::vector<std::uint64_t> vertex_numbers() const {
        const PetscInt* numbers = nullptr;
        check(ISGetIndices(numbering_, &numbers));
        std::vector<std::uint64_t> all;
        all.reserve(vertices_.size());
        for (std::size_t v = 0; v < vertices_.size(); ++v) {  // negative: another process's
            const PetscInt n = numbers[v];
            all.push_back(static_cast<std::uint64_t>(n < 0 ? -(n + 1) : n));
        }
        check(ISRestoreIndices(numbering_, &numbers));
        return all;
    }

    [[nodiscard]] std::vector<Point> points() const {
        PetscSection section = nullptr;
        Vec values = nullptr;
        check(DMGetCoordinateSection(plex_, &section));
        check(DMGetCoordinatesLocalNoncollective(plex_, &values));
        const PetscScalar* numbers = nullptr;
        check(VecGetArrayRead(values, &numbers));
        std::vector<Point> all(vertices_.size());
        for (PetscInt p = vertices_.begin; p < vertices_.end; ++p) {
            PetscInt at = 0;
            check(PetscSectionGetOffset(section, p, &at));
            const auto number = [&](PetscInt k) { return PetscRealPart(numbers[at + k]); };
            all[static_cast<std::size_t>(p - vertices_.begin)] = {number(0), number(1), number(2)};
        }
        check(VecRestoreArrayRead(values, &numbers));
        return all;
    }

    /// Returns the positions in the list of vertices of the vertices of a cell, face or edge.
    /// Throws InputError unless there are N.
    template <std::size_t N>
    [[nodiscard]] std::array<std::size_t, N> vertices_of(PetscInt p) const {
        PetscInt count = 0;
        PetscInt* closure = nullptr;
        check(DMPlexGetTransitiveClosure(plex_, p, PETSC_TRUE, &count, &closure));
        std::array<std::size_t, N> found{};
        std::size_t number = 0;
        for (PetscInt k = 0; k < count; ++k) {
            if (!vertices_.contains(closure[2 * k])) continue;
            if (number < N) {
                found[number] = static_cast<std::size_t>(closure[2 * k] - vertices_.begin);
            }
            ++number;
        }
        check(DMPlexRestoreTransitiveClosure(plex_, p, PETSC_TRUE, &count, &closure));
        if (number != N) {
            throw InputError(
                fmt::format("point {} of the plex has {} vertices, not {}", p, number, N));
        }
        return found;
    }

    /// Returns whether the face or edge belongs to a cell owned by this process.
    [[nodiscard]] bool has_own_cell(PetscInt p) const {
        PetscInt count = 0;
        PetscInt* star = nullptr;
        check(DMPlexGetTransitiveClosure(plex_, p, PETSC_FALSE, &count, &star));
        bool found = false;
        for (PetscInt k = 0; k < count; ++k) found = found || is_own_cell(star[2 * k]);
        check(DMPlexRestoreTransitiveClosure(plex_, p, PETSC_FALSE, &count, &star));
        return found;
    }

private:
    void check_kind() const {
        check_initialised();
        PetscBool is_plex = PETSC_FALSE;
        PetscInt dimension = 0;
        PetscInt space = 0;
        if (plex_ != nullptr) {
            check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(plex_), DMPLEX, &is_plex));
        }
        if (is_plex == PETSC_FALSE) throw InputError("the DM is not a DMPlex");
        check(DMGetDimension(plex_, &dimension));
        check(DMGetCoordinateDim(plex_, &space));
        if (dimension != 3 || space != 3) {
            throw InputError(
                fmt::format("the plex has cells of dimension {} in {} dimensions, not 3 "
                            "in 3",
                            dimension, space));
        }
    }

    void find_cells() {
        check(DMPlexGetDepthStratum(plex_, 0, &vertices_.begin, &vertices_.end));
        PetscInt depth = 0;
        check(DMPlexGetDepth(plex_, &depth));
        if (depth == 3) {
            check(DMPlexGetDepthStratum(plex_, 1, &edges_.begin, &edges_.end));
            check(DMPlexGetDepthStratum(plex_, 2, &faces_.begin, &faces_.end));
        }
        Range range;
        if (depth > 0) check(DMPlexGetHeightStratum(plex_, 0, &range.begin, &range.end));
        std::vector<std::uint8_t> is_others(range.size(), 0);
        PetscSF sharers = nullptr;
        check(DMGetPointSF(plex_, &sharers));
        PetscInt count = 0;
        const PetscInt* leaves = nullptr;
        check(PetscSFGetGraph(sharers, nullptr, &count, &leaves, nullptr));
        for (PetscInt k = 0; k < count; ++k) {
            const PetscInt p = leaves == nullptr ? k : leaves[k];
            if (range.contains(p)) is_others[static_cast<std::size_t>(p - range.begin)] = 1;
        }
        for (PetscInt p = range.begin; p < range.end; ++p) {
            if (is_others[static_cast<std::size_t>(p - range.begin)] != 0) continue;
            DMPolytopeType type = DM_POLYTOPE_UNKNOWN;
            check(DMPlexGetCellType(plex_, p, &type));
            if (type != DM_POLYTOPE_TETRAHEDRON) {
                throw InputError(fmt::format("point {} of the plex is not a tetrahedron", p));
            }
            cells_.push_back(p);
        }
    }

    DM plex_;
    IS numbering_ = nullptr;
    Range vertices_;
    Range faces_;
    Range edges_;
    std::vector<PetscInt> cells_;
};

/// Returns cells by global vertex numbers, positively oriented.
std::vector<std::array<std::uint64_t, 4>> cells_of(const PlexReader& plex, const MeshPart& part) {
    std::vector<std::array<std::uint64_t, 4>> cells;
    cells.reserve(plex.cells().size());
    for (const PetscInt p : plex.cells()) {
        auto places = plex.vertices_of<4>(p);
        std::swap(places[0], places[1]);  // as in to_plex()
        const auto point = [&](std::size_t k) { return part.points[places[k]]; };
        if (orientation(point(0), point(1), point(2), point(3)) < 0)
            std::swap(places[0], places[1]);
        auto& cell = cells.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) cell[k] = part.vertex_numbers[places[k]];
    }
    return cells;
}

/// Collects the labelled sides of owned cells, by global vertex numbers.
template <std::size_t N>
void take_sides(const PlexReader& plex, const std::string& label, const Range& range,
                const MeshPart& part, std::vector<std::array<std::uint64_t, N>>& sides,
                std::vector<Marker>& markers) {
    if (label.empty()) return;
    for (const MarkedPoint& one : points_of_label(plex.plex(), label, range.begin, range.end)) {
        if (!plex.has_own_cell(one.point)) continue;
        const auto places = plex.vertices_of<N>(one.point);
        auto& side = sides.emplace_back();
        for (std::size_t k = 0; k < N; ++k) side[k] = part.vertex_numbers[places[k]];
        markers.push_back(one.marker);
    }
}

/// Returns the region tag of each cell, 0 if the label has no value.
std::vector<Marker> regions_of(const PlexReader& plex, const std::string& label) {
    std::vector<Marker> regions(plex.cells().size(), 0);
    if (plex.cells().empty()) return regions;
    for (const MarkedPoint& one :
         points_of_label(plex.plex(), label, plex.cells().front(), plex.cells().back() + 1)) {
        const auto found = std::ranges::lower_bound(plex.cells(), one.point);
        if (*found != one.point) continue;
        regions[static_cast<std::size_t>(found - plex.cells().begin())] = one.marker;
    }
    return regions;
}

/// Returns the plex point of each vertex by merging the two sorted lists of numbers.
std::vector<PetscInt> points_of_vertices(const AdaptiveMesh& mesh, const PlexReader& plex,
                                         std::span<const std::uint64_t> numbers) {
    std::vector<std::pair<std::uint64_t, PetscInt>> known;
    known.reserve(numbers.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        known.emplace_back(numbers[v], plex.vertices().begin + static_cast<PetscInt>(v));
    }
    std::ranges::sort(known);
    std::vector<PetscInt> points;
    points.reserve(mesh.vertex_numbers().size());
    auto at = known.begin();
    for (const distributed::GlobalVertex number : mesh.vertex_numbers()) {
        while (at != known.end() && at->first < static_cast<std::uint64_t>(number)) ++at;
        const bool is_known = at != known.end() && at->first == static_cast<std::uint64_t>(number);
        points.push_back(is_known ? at->second : -1);
    }
    return points;
}

MPI_Comm communicator_of_plex(DM plex) {
    check_initialised();
    if (plex == nullptr) throw InputError("there is no DM");
    return PetscObjectComm(reinterpret_cast<PetscObject>(plex));
}

}  // namespace

MeshFromPlex from_plex(DM plex, const PlexLabels& labels) {
    const Communicator processes = distributed::communicator_of(communicator_of_plex(plex));
    const SilentErrors silent;
    const PlexReader reader(plex, processes);
    MeshPart part;
    processes.transaction([&] {
        part.vertex_numbers = reader.vertex_numbers();
        part.points = reader.points();
        part.cells = cells_of(reader, part);
        if (!labels.cells.empty()) part.regions = regions_of(reader, labels.cells);
        take_sides(reader, labels.faces, reader.faces(), part, part.facets, part.facet_markers);
        take_sides(reader, labels.edges, reader.edges(), part, part.edges, part.edge_markers);
    });
    // Without any nonzero tag on any process, the mesh has no region tags.
    const bool has_tags =
        processes.max(std::ranges::any_of(part.regions, [](Marker tag) { return tag != 0; })) != 0;
    if (!has_tags) part.regions.clear();
    std::vector<std::uint64_t> numbers;
    std::vector<PetscInt> cell_points;
    processes.transaction([&] {
        numbers = part.vertex_numbers;
        cell_points = reader.cells();
    });
    MeshFromPlex made{
        AdaptiveMesh::from_parts(processes, std::move(part)), std::move(cell_points), {}};
    processes.transaction(
        [&] { made.vertex_points = points_of_vertices(made.mesh, reader, numbers); });
    return made;
}

}  // namespace octetra::petsc
