/// UGGrid beside an AdaptiveMesh: `peer_uggrid [CUBES [RADIUS]]` takes CUBES^3 cubes of six cells,
/// refines the cells whose centroid is within RADIUS of the middle, and lets all within twice of it
/// go, first with the one and then with the other, from barrier to barrier. Also under mpirun.
///
/// What differs: UGGrid refines red-green, so that it bisects other cells around the marked ones,
/// and coarsens what a call marks and no neighbour needs; both go back to the input here. It keeps
/// all levels of the mesh, and its cells as objects.

#include <dune/common/parallel/mpihelper.hh>
#include <dune/grid/common/gridfactory.hh>
#include <dune/grid/uggrid.hh>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/mpi.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using Grid = Dune::UGGrid<3>;

std::unique_ptr<Grid> grid_of(const Mesh& mesh, bool is_first) {
    Dune::GridFactory<Grid> factory;
    if (is_first) {
        for (const Point& p : mesh.points) factory.insertVertex({p.x, p.y, p.z});
        for (const CellVertices& cell : mesh.cells) {
            factory.insertElement(
                Dune::GeometryTypes::tetrahedron,
                {cell[0].value(), cell[1].value(), cell[2].value(), cell[3].value()});
        }
    }
    auto grid = factory.createGrid();
    grid->loadBalance();
    return grid;
}

long cells_of(const Grid& grid) {
    long count = 0;
    for (const auto& cell : elements(grid.leafGridView(), Dune::Partitions::interior)) {
        (void)cell;
        ++count;
    }
    return grid.comm().sum(count);
}

void adapt(Grid& grid, int how, double radius) {
    for (const auto& cell : elements(grid.leafGridView(), Dune::Partitions::interior)) {
        auto from_middle = cell.geometry().center();
        from_middle -= Dune::FieldVector<double, 3>(0.5);
        if (from_middle.two_norm() <= radius) grid.mark(how, cell);
    }
    grid.preAdapt();
    grid.adapt();
    grid.postAdapt();
}

template <class Barrier>
double seconds(Barrier&& barrier, auto&& work) {
    barrier();
    const double start = wall_seconds();
    work();
    barrier();
    return wall_seconds() - start;
}

void print(const char* who, bool is_first, long before, long finer, double refining, long coarser,
           double coarsening) {
    if (!is_first) return;
    std::printf("%-8s %9ld cells to %9ld in %9.5f s, back to %9ld in %9.5f s\n", who, before, finer,
                refining, coarser, coarsening);
}

void run(const distributed::Communicator& world, std::size_t cubes, double radius) {
    const Mesh mesh = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
    {
        const auto grid = grid_of(mesh, world.is_first());
        const auto barrier = [&] { grid->comm().barrier(); };
        const long before = cells_of(*grid);
        const double refining = seconds(barrier, [&] { adapt(*grid, 1, radius); });
        const long finer = cells_of(*grid);
        const double coarsening = seconds(barrier, [&] { adapt(*grid, -1, 2 * radius); });
        print("UGGrid", world.is_first(), before, finer, refining, cells_of(*grid), coarsening);
    }
    auto ours = distributed::AdaptiveMesh::distribute(
        world, mesh,
        distributed::partition_cells(mesh, world.size(),
                                     {.method = distributed::PartitionMethod::block}));
    const auto barrier = [&] { (void)world.max(0); };
    const auto cells = [&] { return static_cast<long>(world.sum(ours.cells().size())); };
    const long before = cells();
    const Selection ball{.spheres = {{{0.5, 0.5, 0.5}, radius}}};
    const Selection larger{.spheres = {{{0.5, 0.5, 0.5}, 2 * radius}}};
    const double refining = seconds(barrier, [&] { (void)ours.refine(ball); });
    const long finer = cells();
    const double coarsening = seconds(barrier, [&] { (void)ours.coarsen(larger); });
    print("octetra", world.is_first(), before, finer, refining, cells(), coarsening);
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    Dune::MPIHelper::instance(argc, argv);
    const auto world = octetra::distributed::communicator_of(MPI_COMM_WORLD);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 16;
    octetra::bench::run(world, cubes, argc > 2 ? std::strtod(argv[2], nullptr) : 0.15);
}
