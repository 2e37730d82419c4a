"""A front that moves through a mesh: a sphere whose centre moves along the bottom of the unit cube.

In every cycle the mesh is coarsened behind the front, refined ahead of it, and rebalanced, and the front
deposits heat at its position. The heat of a cell is divided among its pieces, and summed when pieces are
merged, so the total heat equals the heat deposited.

    python3 -m octetra generate kuhn 8 -o cube.mesh
    mpirun -n 4 python3 -m mpi4py moving_front.py cube.mesh 50 front

writes front.vtkhdf, with all meshes; front.mesh, the last mesh; and front.png, the bottom of some meshes.
The picture requires matplotlib (Debian: python3-matplotlib); several ranks require mpi4py.
examples/moving_front.cpp is the same program in C++.
"""

import contextlib
import sys
import time

import numpy as np

import octetra

RADIUS = 0.2
THICKNESS = 0.01  # thickness of the front
FINEST = 0.01  # maximum width of cells in the front


def distances(mesh, x):
    """Returns the distance of the centroid of each cell from the front, whose centre is at x, 0.5, 0."""
    middles = mesh.points[mesh.cells].mean(axis=1)
    from_centre = middles - [x, 0.5, 0]
    return np.abs(np.sqrt((from_centre**2).sum(axis=1)) - RADIUS)


def behind(mesh, x):
    """Marks cells behind the front; the margin prevents coarsened cells from being refined again immediately."""
    return distances(mesh, x) > THICKNESS + 4 * np.cbrt(octetra.quality.volume(mesh))


def ahead(mesh, x):
    widths = np.cbrt(octetra.quality.volume(mesh))
    return (distances(mesh, x) < THICKNESS + widths) & (widths > FINEST)


@contextlib.contextmanager
def timed(seconds, what):
    start = time.perf_counter()
    yield
    seconds[what] += time.perf_counter() - start


def follow(mesh, heat, x, seconds):
    """Adapts the mesh to the position of the front; returns the heat of its cells."""
    for marked, step, what in ((behind, mesh.coarsen, "coarsen"), (ahead, mesh.refine, "refine")):
        changes = True
        while changes:
            marks = marked(mesh, x)
            with timed(seconds, what):
                adaptation = step(marks)
            with timed(seconds, "transfer"):
                heat = adaptation.transfer_cells(heat, how="divided")
            changes = adaptation.changed
    with timed(seconds, "rebalance"):
        move = mesh.rebalance()
    with timed(seconds, "transfer"):
        return move.cells(heat)


def over_all_ranks(numbers, operation):
    """Returns the "SUM" or "MAX" of each number over the ranks."""
    try:
        from mpi4py import MPI
    except ImportError:  # a single rank
        return np.array(numbers)
    all_numbers = np.array(numbers, float)
    MPI.COMM_WORLD.Allreduce(MPI.IN_PLACE, all_numbers, getattr(MPI, operation))
    return all_numbers


def bottom_of(mesh, density):
    """Returns, on the first rank, the corners, (n, 3, 2), of the faces at z = 0, and the density of their cells."""
    cells, _ = mesh.boundary()
    corners = mesh.points[mesh.boundary_faces()]
    low = np.all(corners[:, :, 2] == 0, axis=1)
    mine = corners[low, :, :2], density[cells[low]]
    if mesh.rank_count == 1:
        return mine
    from mpi4py import MPI
    parts = MPI.COMM_WORLD.gather(mine)
    return tuple(np.concatenate(part) for part in zip(*parts)) if parts else None


def draw(path, frames):
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    figure = Figure(figsize=(3 * len(frames), 2.2), layout="constrained")
    for axes, (cycle, (triangles, density)) in zip(figure.subplots(1, len(frames)), frames.items()):
        axes.add_collection(PolyCollection(triangles, array=density, cmap="YlOrRd", clim=(0, 6),
                                           edgecolor="dimgrey", linewidth=0.1))
        axes.set(xlim=(0, 1), ylim=(0.2, 0.8), aspect="equal", xticks=[], yticks=[],
                 title=f"cycle {cycle}")
    figure.savefig(path, dpi=110)


def main(path, cycles, name):
    mesh = octetra.read(path)
    heat = np.zeros(len(mesh.cells))
    left = greatest = 0.0
    frames = {}
    drawn = {1, (cycles + 1) // 2, cycles}
    if mesh.rank == 0:
        print("cycle     cells most/mean   coarsen   refine rebalance transfer    write    drift")
    with octetra.MeshSeries(name + ".vtkhdf") as series:
        for cycle in range(1, cycles + 1):
            x = 0.2 + 0.6 * cycle / cycles
            seconds = dict.fromkeys(("coarsen", "refine", "rebalance", "transfer", "write"), 0.0)
            heat = follow(mesh, heat, x, seconds)

            volumes = octetra.quality.volume(mesh)
            more = volumes * np.exp(-(distances(mesh, x) / THICKNESS)**2)
            heat += more
            left += more.sum()
            density = heat / volumes
            with timed(seconds, "write"):
                mesh.append_to(series, cycle, cell_fields={"density": density})
            if cycle in drawn:
                frames[cycle] = bottom_of(mesh, density)

            cells, there_is, was_left = over_all_ranks([len(mesh.cells), heat.sum(), left], "SUM")
            most, *longest = over_all_ranks([len(mesh.cells), *seconds.values()], "MAX")
            drift = abs(there_is - was_left) / was_left
            greatest = max(greatest, drift)
            if mesh.rank == 0:
                print(f"{cycle:5} {int(cells):9} {most / (cells / mesh.rank_count):9.2f} "
                      "{:9.3f} {:8.3f} {:9.3f} {:8.3f} {:8.3f}".format(*longest), f"{drift:8.0e}")
    mesh.write(name + ".mesh")
    if not greatest < 1e-12:
        sys.exit("heat is not conserved")
    if mesh.rank == 0:
        print("heat is conserved up to rounding")
        draw(name + ".png", frames)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
