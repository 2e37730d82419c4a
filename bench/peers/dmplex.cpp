/// PETSc's DMPlex compared with AdaptiveMesh: `peer_dmplex [CUBES [LEVELS [SECONDS]]]` halves all
/// edges of CUBES^3 cubes of six cells LEVELS times, first by DMRefine(), until the next level
/// would exceed SECONDS in total, and then as often by refine(), with to_plex() after each level.
/// For one of these meshes PETSc also makes a DMPlex from lists of the same cells on the same
/// ranks. Times are from barrier to barrier; prints a line of JSON. Also under mpirun.
///
/// Differences: PETSc divides a cell into eight in another way. Debian's PETSc refines either all
/// tetrahedra or none.

#include <petscdmplex.h>

#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/mpi.hpp>
#include <octetra/petsc/to_plex.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using Json = nlohmann::ordered_json;
using distributed::AdaptiveMesh;
using distributed::Communicator;

void check(PetscErrorCode code) {
    if (code != 0) std::abort();
}

double seconds(const Communicator& world, auto&& work) {
    (void)world.max(0);
    const double start = wall_seconds();
    work();
    (void)world.max(0);
    return wall_seconds() - start;
}

/// The lattice as a plex that PETSc makes and distributes.
DM plex_of(const Mesh& mesh, bool is_first) {
    std::vector<PetscInt> cells;
    std::vector<PetscReal> points;
    for (const CellVertices& cell : mesh.cells) {
        if (!is_first) break;
        for (const VertexIndex v : cell) cells.push_back(static_cast<PetscInt>(v.value()));
    }
    for (const Point& p : mesh.points) {
        if (is_first) points.insert(points.end(), {p.x, p.y, p.z});
    }
    DM whole = nullptr;
    DM shared = nullptr;
    check(DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 3,
                                        static_cast<PetscInt>(cells.size() / 4),
                                        static_cast<PetscInt>(points.size() / 3), 4, PETSC_TRUE,
                                        cells.data(), 3, points.data(), &whole));
    check(DMPlexDistribute(whole, 0, nullptr, &shared));
    if (shared == nullptr) return whole;
    check(DMDestroy(&whole));
    return shared;
}

std::uint64_t cells_of(const Communicator& world, DM plex) {
    PetscInt begin = 0;
    PetscInt end = 0;
    check(DMPlexGetHeightStratum(plex, 0, &begin, &end));
    return world.sum(static_cast<std::uint64_t>(end - begin));
}

/// By PETSc alone, from this rank's cells by global vertex number and its share of the points.
double seconds_of_cell_list(const Communicator& world, const AdaptiveMesh& mesh) {
    // PETSc requires vertices that are numbered rank by rank.
    const auto& sharing = mesh.vertex_sharing();
    std::vector<PetscReal> points;
    std::vector<PetscInt> numbers(mesh.points().size());
    std::uint64_t own = 0;
    for (std::size_t v = 0; v < numbers.size(); ++v)
        own += sharing.is_owned(VertexIndex{v}) ? 1U : 0U;
    auto next = static_cast<PetscInt>(world.sum_before(own));
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        if (!sharing.is_owned(VertexIndex{v})) continue;
        numbers[v] = next++;
        const Point& p = mesh.points()[v];
        points.insert(points.end(), {p.x, p.y, p.z});
    }
    distributed::update_copies(world, sharing, numbers.size(), numbers);
    std::vector<PetscInt> cells;
    for (const auto& [a, b, c, d] : mesh.cells()) {  // in PETSc's orientation
        for (const VertexIndex v : {b, a, c, d}) cells.push_back(numbers[v.value()]);
    }
    DM plex = nullptr;
    const double took = seconds(world, [&] {
        check(DMPlexCreateFromCellListParallelPetsc(
            PETSC_COMM_WORLD, 3, static_cast<PetscInt>(cells.size() / 4),
            static_cast<PetscInt>(own), PETSC_DECIDE, 4, PETSC_TRUE, cells.data(), 3, points.data(),
            nullptr, nullptr, &plex));
    });
    check(DMDestroy(&plex));
    return took;
}

struct Bounds {
    std::size_t cubes = 16;
    std::size_t levels = 2;
    double seconds = 600;
};

/// Seconds of each level of DMRefine(), until all are done or the next would take too long.
Json levels_of_dmplex(const Communicator& world, const Mesh& mesh, const Bounds& bounds) {
    DM plex = plex_of(mesh, world.is_first());
    check(DMPlexSetRefinementUniform(plex, PETSC_TRUE));
    Json levels = Json::array();
    double all = 0;
    double next = 0;
    while (levels.size() < bounds.levels && all + next <= bounds.seconds) {
        DM finer = nullptr;
        const double took =
            seconds(world, [&] { check(DMRefine(plex, PETSC_COMM_WORLD, &finer)); });
        check(DMDestroy(&plex));
        plex = std::exchange(finer, nullptr);
        levels.push_back({{"cells", cells_of(world, plex)}, {"seconds", took}});
        all += took;
        next = static_cast<double>(world.max(static_cast<std::uint64_t>(8e6 * took))) * 1e-6;
        all = static_cast<double>(world.max(static_cast<std::uint64_t>(1e6 * all))) * 1e-6;
    }
    check(DMDestroy(&plex));
    return levels;
}

/// The same with refine(), and the seconds of to_plex(). For the first mesh of sufficient size also
/// PETSc's time for making a plex of it.
Json levels_of_octetra(const Communicator& world, const Mesh& mesh, std::size_t level_count,
                       Json& cell_list) {
    constexpr std::uint64_t some_size = 100'000;
    auto ours = AdaptiveMesh::distribute(
        world, mesh,
        distributed::partition_cells(mesh, world.size(),
                                     {.method = distributed::PartitionMethod::rcb}));
    Json levels = Json::array();
    for (std::size_t level = 0; level < level_count; ++level) {
        const double refining = seconds(world, [&] { (void)ours.refine(Selection{.all = true}); });
        DM plex = nullptr;
        const double handing = seconds(world, [&] { plex = petsc::to_plex(ours); });
        const std::uint64_t cells = cells_of(world, plex);
        check(DMDestroy(&plex));
        levels.push_back({{"cells", cells},
                          {"seconds", refining + handing},
                          {"refine_seconds", refining},
                          {"hand_over_seconds", handing}});
        if (cell_list.is_null() && (cells >= some_size || level + 1 == level_count)) {
            cell_list = {{"cells", cells},
                         {"seconds", seconds_of_cell_list(world, ours)},
                         {"hand_over_seconds", handing}};
        }
    }
    return levels;
}

void run(const Communicator& world, const Bounds& bounds) {
    const std::size_t n = bounds.cubes;
    const Mesh mesh = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const Json theirs = levels_of_dmplex(world, mesh, bounds);
    Json cell_list;
    const Json ours = levels_of_octetra(world, mesh, theirs.size(), cell_list);
    const Json line{
        {"ranks", world.size()}, {"dmplex", theirs}, {"octetra", ours}, {"cell_list", cell_list}};
    if (world.is_first()) std::printf("%s\n", line.dump().c_str());
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
    {
        const auto world = octetra::distributed::communicator_of(PETSC_COMM_WORLD);
        octetra::bench::Bounds bounds;
        if (argc > 1) bounds.cubes = std::strtoul(argv[1], nullptr, 10);
        if (argc > 2) bounds.levels = std::strtoul(argv[2], nullptr, 10);
        if (argc > 3) bounds.seconds = std::strtod(argv[3], nullptr);
        octetra::bench::run(world, bounds);
    }
    return PetscFinalize() == 0 ? 0 : 1;
}
