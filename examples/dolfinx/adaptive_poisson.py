"""Adaptive finite elements in DOLFINx, refined by Octetra or by DOLFINx itself.

    mpirun -n 4 python3 -m mpi4py adaptive_poisson.py --refine octetra --steps 8
    mpirun -n 4 python3 -m mpi4py adaptive_poisson.py --refine dolfinx --steps 8

-laplace u = 0 on the L-shaped prism ((-1, 1)^2 without [0, 1) x (-1, 0]) x (0, 1), where u = r^(2/3)
sin(2 theta / 3) is prescribed on the sides, with natural boundary conditions at bottom and top, as in
examples/adaptive_poisson.cpp. The gradient of u is singular at the re-entrant edge. The loop consists of
solve, estimate, mark and refine; the two runs differ only in the class that refines.
"""

import argparse
import time

import dolfinx
import dolfinx.fem.petsc
import numpy as np
import ufl
from mpi4py import MPI
from petsc4py import PETSc

import octetra
import octetra.dolfinx

world = MPI.COMM_WORLD


# ---- calls that differ between versions of DOLFINx

VERSION = tuple(int(word) for word in dolfinx.__version__.split(".")[:2])
IS_OLD = VERSION < (0, 9)  # 0.5
if not IS_OLD:
    import basix.ufl


def function_space(domain, kind, degree):
    make = dolfinx.fem.FunctionSpace if IS_OLD else dolfinx.fem.functionspace
    return make(domain, (kind, degree))


def partitioner_with_ghosts():
    links = () if VERSION < (0, 11) else (2,)  # cells at a facet
    return dolfinx.mesh.create_cell_partitioner(dolfinx.mesh.GhostMode.shared_facet, *links)


def created(points, cells):
    """A mesh with ghosts behind faces, which jumps require."""
    if IS_OLD:
        return dolfinx.mesh.create_mesh(world, cells, points,
                                        ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1)))
    element = basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,))
    return dolfinx.mesh.create_mesh(world, cells=cells, x=points, e=element, partitioner=partitioner_with_ghosts())


def bisected(domain, marks):
    """The mesh that DOLFINx makes of the marked cells, distributed anew."""
    domain.topology.create_entities(1)
    edges = dolfinx.mesh.compute_incident_entities(
        domain if IS_OLD else domain.topology, np.flatnonzero(marks).astype(np.int32), 3, 1)
    if IS_OLD:
        return dolfinx.mesh.refine(domain, edges, redistribute=True)
    return dolfinx.mesh.refine(domain, edges, partitioner=partitioner_with_ghosts())[0]


def solution_of(a, right, fixed):
    options = {"petsc_options": {"ksp_type": "cg", "pc_type": "gamg", "ksp_rtol": 1e-10}}
    if VERSION >= (0, 10):
        options["petsc_options_prefix"] = "poisson_"
    return dolfinx.fem.petsc.LinearProblem(a, right, bcs=[fixed], **options).solve()


# ---- the problem

def solution(x):
    theta = np.arctan2(x[1], x[0])
    return np.hypot(x[0], x[1]) ** (2 / 3) * np.sin(2 * np.where(theta < 0, theta + 2 * np.pi, theta) / 3)


def gradient(x):
    theta = (ufl.atan_2 if IS_OLD else ufl.atan2)(x[1], x[0])
    theta = ufl.conditional(theta < 0, theta + 2 * np.pi, theta)
    size = 2 / 3 * (x[0] ** 2 + x[1] ** 2) ** (-1 / 6)
    return ufl.as_vector([-size * ufl.sin(theta / 3), size * ufl.cos(theta / 3), 0])


def on_sides(x):
    outside = np.isclose(np.maximum(np.abs(x[0]), np.abs(x[1])), 1)
    notch = ((np.isclose(x[0], 0) & (x[1] < 1e-9)) | (np.isclose(x[1], 0) & (x[0] > -1e-9)))
    return outside | notch


def coarse_mesh():
    """Returns 24 cubes of side 1/2, of six cells each, on the first rank, and nothing on the others."""
    if world.rank > 0:
        return np.empty((0, 3)), np.empty((0, 4), np.int64)
    corners = np.stack(np.meshgrid(*(range(n) for n in (4, 4, 2)), indexing="ij"), axis=-1).reshape(-1, 3)
    corners = corners[~((corners[:, 0] >= 2) & (corners[:, 1] < 2))]
    ways = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]])
    steps = np.eye(3, dtype=int)[ways].cumsum(axis=1)  # from one corner of a cube to the other
    cells = corners[:, None, None] + np.pad(steps, ((0, 0), (1, 0), (0, 0)))
    points, numbers = np.unique(cells.reshape(-1, 3), axis=0, return_inverse=True)
    return points / 2 - [1, 1, 0], numbers.reshape(-1, 4).astype(np.int64)


# ---- solve, estimate, mark

def solve(domain):
    space = function_space(domain, "Lagrange", 1)
    known = dolfinx.fem.Function(space)
    known.interpolate(solution)
    fixed = dolfinx.fem.dirichletbc(known, dolfinx.fem.locate_dofs_geometrical(space, on_sides))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    zero = dolfinx.fem.Constant(domain, 0.0)
    uh = solution_of(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, zero * v * ufl.dx, fixed)
    uh.x.scatter_forward()
    return uh


def estimate(uh):
    """Returns the squared indicators of the cells of this rank, from jumps of the normal derivative."""
    domain = uh.function_space.mesh
    constants = function_space(domain, "DG", 0)
    w = ufl.TestFunction(constants)
    area, n = ufl.FacetArea(domain), ufl.FacetNormal(domain)
    z = ufl.SpatialCoordinate(domain)[2]
    flow = ufl.conditional(ufl.Or(z < 1e-9, z > 1 - 1e-9), ufl.dot(ufl.grad(uh), n), 0)
    # area^(3/2) * jump^2 for each facet, half of it for each of its cells
    form = (ufl.avg(area) ** 0.5 * ufl.jump(ufl.grad(uh), n) ** 2 * ufl.avg(w) * ufl.dS
            + area ** 0.5 * flow ** 2 * w * ufl.ds(metadata={"quadrature_degree": 0}))
    eta = dolfinx.fem.petsc.assemble_vector(dolfinx.fem.form(form))
    eta.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    unknowns = constants.dofmap.list.array if IS_OLD else constants.dofmap.list[:, 0]
    return eta.array[unknowns[:domain.topology.index_map(3).size_local]]


def mark(eta):
    """Doerfler marking: the cells with the largest eta that have half of its sum, determined by a threshold."""
    low, high = 0.0, world.allreduce(eta.max(initial=0), MPI.MAX)
    half = world.allreduce(eta.sum()) / 2
    for _ in range(40):
        middle = (low + high) / 2
        enough = world.allreduce(eta[eta >= middle].sum()) >= half
        low, high = (middle, high) if enough else (low, middle)
    return eta >= low


def energy_error(uh):
    x = ufl.SpatialCoordinate(uh.function_space.mesh)
    difference = gradient(x) - ufl.grad(uh)
    form = ufl.inner(difference, difference) * ufl.dx(metadata={"quadrature_degree": 2})
    return np.sqrt(world.allreduce(dolfinx.fem.assemble_scalar(dolfinx.fem.form(form))))


# ---- refine

class RefinedByDolfinx:
    def __init__(self, domain):
        self.domain = domain

    def refine(self, marks):
        self.domain = bisected(self.domain, marks)


class RefinedByOctetra:
    def __init__(self, domain):
        self.mesh, _ = octetra.dolfinx.from_mesh(domain)
        self.domain = octetra.dolfinx.to_mesh(self.mesh).mesh  # cell i is cell i of self.mesh

    def refine(self, marks):
        self.mesh.refine_evenly(marks)
        self.domain = octetra.dolfinx.to_mesh(self.mesh).mesh


# ---- the loop

def say(text):
    if world.rank == 0:
        print(text, flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--refine", choices=("octetra", "dolfinx"), default="octetra")
    parser.add_argument("--steps", type=int, default=6)
    options = parser.parse_args()
    points, cells = coarse_mesh()
    domain = created(points, cells)
    kind = RefinedByOctetra if options.refine == "octetra" else RefinedByDolfinx
    refined = kind(domain)
    say(f"{'cells':>10} {'unknowns':>10} {'H1 error':>10} {'estimator':>10} {'rate':>7} {'most/mean':>9} "
        f"{'mesh, s':>8} {'all, s':>8}")
    mesh_seconds, begin, last = 0.0, time.perf_counter(), None
    for step in range(options.steps + 1):
        uh = solve(refined.domain)
        eta = estimate(uh)
        counts = world.allgather(len(eta))
        unknowns = uh.function_space.dofmap.index_map.size_global
        error, sum_of_eta = energy_error(uh), world.allreduce(eta.sum())
        rate = np.log(error / last[0]) / np.log(unknowns / last[1]) if last else 0
        last = error, unknowns
        say(f"{sum(counts):10} {unknowns:10} {error:10.6f} {np.sqrt(sum_of_eta):10.6f} {rate:7.3f} "
            f"{max(counts) * world.size / sum(counts):9.2f} {mesh_seconds:8.3f} "
            f"{time.perf_counter() - begin:8.2f}")
        if step < options.steps:
            marks = mark(eta)
            world.Barrier()
            start = time.perf_counter()
            refined.refine(marks)
            world.Barrier()
            mesh_seconds += time.perf_counter() - start


if __name__ == "__main__":
    main()
