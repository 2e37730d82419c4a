/// UGGrid compared with AdaptiveMesh: `peer_uggrid [CUBES [RADIUS]]` refines in CUBES^3 cubes of
/// six cells those whose centroid is within RADIUS of the middle, and coarsens all cells within
/// twice this radius, alternating between the two programs, from barrier to barrier; five times,
/// each with a new mesh. Prints medians. Also under mpirun.
///
/// Differences: UGGrid refines red-green, so that it bisects other cells around the marked ones,
/// and coarsens marked cells that no neighbour needs; both return to the input here. It stores all
/// levels of the mesh, and cells as objects.

#include <dune/common/parallel/mpihelper.hh>
#include <dune/grid/common/gridfactory.hh>
#include <dune/grid/uggrid.hh>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

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

struct Cycle {
    long before = 0;
    long finer = 0;
    long coarser = 0;
    double refining = 0;  // seconds
    double coarsening = 0;
};

Cycle cycle_of_uggrid(const Mesh& mesh, bool is_first, double radius) {
    Cycle cycle;
    const auto grid = grid_of(mesh, is_first);
    const auto barrier = [&] { grid->comm().barrier(); };
    cycle.before = cells_of(*grid);
    cycle.refining = seconds(barrier, [&] { adapt(*grid, 1, radius); });
    cycle.finer = cells_of(*grid);
    cycle.coarsening = seconds(barrier, [&] { adapt(*grid, -1, 2 * radius); });
    cycle.coarser = cells_of(*grid);
    return cycle;
}

Cycle cycle_of_octetra(const Mesh& mesh, const distributed::Communicator& world, double radius) {
    Cycle cycle;
    auto ours = distributed::AdaptiveMesh::distribute(
        world, mesh,
        distributed::partition_cells(mesh, world.size(),
                                     {.method = distributed::PartitionMethod::block}));
    const auto barrier = [&] { (void)world.max(0); };
    const auto cells = [&] { return static_cast<long>(world.sum(ours.cells().size())); };
    cycle.before = cells();
    const Selection ball{.spheres = {{{0.5, 0.5, 0.5}, radius}}};
    const Selection larger{.spheres = {{{0.5, 0.5, 0.5}, 2 * radius}}};
    cycle.refining = seconds(barrier, [&] { (void)ours.refine(ball); });
    cycle.finer = cells();
    cycle.coarsening = seconds(barrier, [&] { (void)ours.coarsen(larger); });
    cycle.coarser = cells();
    return cycle;
}

double median(const std::vector<Cycle>& cycles, auto&& seconds_of) {
    std::vector<double> all;
    for (const Cycle& cycle : cycles) all.push_back(seconds_of(cycle));
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
    return all[all.size() / 2];
}

/// Returns the median of refining and coarsening together.
double print(const char* who, const std::vector<Cycle>& cycles) {
    const Cycle& first = cycles.front();
    std::printf("%-8s %9ld cells to %9ld in %9.5f s, back to %9ld in %9.5f s\n", who, first.before,
                first.finer, median(cycles, [](const Cycle& c) { return c.refining; }),
                first.coarser, median(cycles, [](const Cycle& c) { return c.coarsening; }));
    return median(cycles, [](const Cycle& c) { return c.refining + c.coarsening; });
}

void run(const distributed::Communicator& world, std::size_t cubes, double radius) {
    const Mesh mesh = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
    std::vector<Cycle> theirs;
    std::vector<Cycle> ours;
    for (int repeat = 0; repeat < 5; ++repeat) {
        theirs.push_back(cycle_of_uggrid(mesh, world.is_first(), radius));
        ours.push_back(cycle_of_octetra(mesh, world, radius));
    }
    if (!world.is_first()) return;
    const double their_cycle = print("UGGrid", theirs);
    const double our_cycle = print("octetra", ours);
    std::printf("a cycle of UGGrid takes %.0f times as long\n", their_cycle / our_cycle);
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    Dune::MPIHelper::instance(argc, argv);
    const auto world = octetra::distributed::communicator_of(MPI_COMM_WORLD);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 16;
    octetra::bench::run(world, cubes, argc > 2 ? std::strtod(argv[2], nullptr) : 0.2);
}
