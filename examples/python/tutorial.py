"""From a mesh to pictures: read, mark by a function of coordinates, refine, plot angles, save.

    python3 tutorial.py gear.mesh              on one rank
    mpirun -n 4 python3 -m mpi4py tutorial.py gear.mesh  on four ranks, with the same output

Pictures require matplotlib (Debian: python3-matplotlib); several ranks require mpi4py.
"""

import sys

import numpy as np

import octetra


def front(points):
    """Returns the distance of points, (n, 3), from a sphere around one tooth of the gear."""
    return np.abs(np.linalg.norm(points - [1.0, 0.0, 0.15], axis=1) - 0.3)


def refine_to_the_front(mesh, steps):
    """Refines the cells whose distance from the front is less than their width."""
    for step in range(1, steps + 1):
        middles = mesh.points[mesh.cells].mean(axis=1)
        widths = np.cbrt(octetra.quality.volume(mesh))
        adaptation = mesh.refine(front(middles) < widths)
        cells = mesh.count_cells()  # collective
        if mesh.rank == 0:
            print(f"step {step}: {cells:,} cells, {mesh.vertex_count:,} vertices")
        if not adaptation.changed:
            break


def angle_counts(mesh, bins):
    """Returns the number of dihedral angles of the whole mesh in each bin of 0 .. 180 degrees."""
    counts, _ = np.histogram(octetra.quality.dihedral_angles(mesh), bins, range=(0, 180))
    return on_all_ranks(counts)


def on_all_ranks(counts):
    try:
        from mpi4py import MPI
    except ImportError:  # a single rank
        return counts
    return MPI.COMM_WORLD.allreduce(counts)


def draw_histogram(path, before, after):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 3.5), layout="constrained")
    axes = figure.add_subplot(xlabel="dihedral angle, degrees", ylabel="share of the angles")
    middles = (np.arange(len(before)) + 0.5) * 180 / len(before)
    width = 180 / len(before)
    axes.bar(middles, before / before.sum(), width, label="as read", color="lightgrey")
    axes.step(middles, after / after.sum(), where="mid", label="refined", color="tab:blue")
    axes.legend()
    figure.savefig(path, dpi=120)


def draw_surface(path, mesh):
    """Draws the boundary of this rank's part: the whole boundary on a single rank."""
    from matplotlib.figure import Figure
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    triangles = mesh.points[mesh.boundary_faces()]
    figure = Figure(figsize=(7, 6))
    axes = figure.add_subplot(projection="3d")
    axes.add_collection3d(Poly3DCollection(triangles, facecolor="aliceblue", edgecolor="steelblue",
                                           linewidth=0.2))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low)
    axes.view_init(elev=50, azim=-20)
    axes.set_axis_off()
    figure.savefig(path, dpi=150, bbox_inches="tight")


def main(path):
    mesh = octetra.read(path)
    before = angle_counts(mesh, 36)
    refine_to_the_front(mesh, 4)
    after = angle_counts(mesh, 36)
    distance = front(mesh.points)  # a field on vertices
    mesh.write("tutorial.vtu", vertex_fields={"distance": distance})  # for ParaView
    mesh.save("tutorial.octetra", vertex_fields={"distance": distance})
    if not mesh.verify(path):
        sys.exit("not a refinement of the mesh as read")
    if mesh.rank == 0:
        draw_histogram("angles.png", before, after)
        if mesh.rank_count == 1:
            draw_surface("surface.png", mesh)
        print("wrote tutorial.vtu, tutorial.octetra and pictures")


if __name__ == "__main__":
    main(sys.argv[1])
