/// PETSc's DMPlex beside an AdaptiveMesh: `peer_dmplex [CUBES [LEVELS]]` takes CUBES^3 cubes of six
/// cells and halves all edges LEVELS times, first by DMRefine(), then by refine(), from barrier to
/// barrier; and of the refined mesh, it makes a DMPlex in two ways: by to_plex(), and by PETSc from
/// lists of the same cells on the same ranks. Also under mpirun.
///
/// What differs: PETSc divides a cell into eight in its own way. Of tetrahedra Debian's PETSc
/// refines all or none.

#include <petscdmplex.h>

#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/mpi.hpp>
#include <octetra/petsc/to_plex.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

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

/// The lattice as PETSc makes a plex of it and shares it out.
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

/// By PETSc alone, from this rank's cells by global vertex number and a share of the points.
double seconds_of_cell_list(const Communicator& world, const AdaptiveMesh& mesh) {
    // PETSc takes vertices that are numbered rank by rank.
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
    for (const auto& [a, b, c, d] : mesh.cells()) {  // turned as PETSc has them
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

void run(const Communicator& world, std::size_t cubes, int levels) {
    const Mesh mesh = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
    const auto print = [&](const char* what, std::uint64_t cells, double took) {
        if (world.is_first()) {
            std::printf("%-40s %10llu cells %9.4f s\n", what,
                        static_cast<unsigned long long>(cells), took);
        }
    };
    DM plex = plex_of(mesh, world.is_first());
    check(DMPlexSetRefinementUniform(plex, PETSC_TRUE));
    for (int level = 0; level < levels; ++level) {
        DM finer = nullptr;
        const double took =
            seconds(world, [&] { check(DMRefine(plex, PETSC_COMM_WORLD, &finer)); });
        check(DMDestroy(&plex));
        plex = std::exchange(finer, nullptr);
        print("DMPlex refines", cells_of(world, plex), took);
    }
    check(DMDestroy(&plex));

    auto ours = AdaptiveMesh::distribute(
        world, mesh,
        distributed::partition_cells(mesh, world.size(),
                                     {.method = distributed::PartitionMethod::rcb}));
    for (int level = 0; level < levels; ++level) {
        const double took = seconds(world, [&] { (void)ours.refine(Selection{.all = true}); });
        print("octetra refines", world.sum(ours.cells().size()), took);
    }
    const double took = seconds(world, [&] { plex = petsc::to_plex(ours); });
    print("to_plex", cells_of(world, plex), took);
    check(DMDestroy(&plex));
    print("DMPlexCreateFromCellListParallelPetsc", world.sum(ours.cells().size()),
          seconds_of_cell_list(world, ours));
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
    {
        const auto world = octetra::distributed::communicator_of(PETSC_COMM_WORLD);
        const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 16;
        octetra::bench::run(world, cubes, argc > 2 ? std::atoi(argv[2]) : 2);
    }
    return PetscFinalize() == 0 ? 0 : 1;
}
