"""What handing a mesh to DOLFINx takes beside its create_mesh on the same cells, and adaptive refinement by Octetra
beside DOLFINx's own: hand_over.py [CUBES [STEPS]], under mpirun for several ranks.

The first table: least of five runs, in seconds, of a lattice of 6 * CUBES^3 cells, with a tenth of them bisected.
The second: cells around a line, nearer with each of STEPS steps; marking is not counted. Seconds are from
barrier to barrier. Python finds octetra by PYTHONPATH.
"""

import gc
import itertools
import sys
import time

import dolfinx.fem.petsc
import dolfinx.mesh
import numpy as np
import ufl
from dolfinx import cpp
from mpi4py import MPI

import octetra
import octetra.dolfinx

world = MPI.COMM_WORLD
GHOSTS = dolfinx.mesh.GhostMode


def say(text):
    if world.rank == 0:
        print(text, flush=True)


def seconds(work):
    gc.collect()
    world.Barrier()
    start = time.perf_counter()
    made = work()
    world.Barrier()
    return time.perf_counter() - start, made


def staying(cells):
    """A partitioner that leaves these cells on their ranks, and tells DOLFINx of the ranks behind their faces, as it
    must: by those it finds what ranks share. Found once, so that only create_mesh is measured."""
    rank_of = np.repeat(np.arange(world.size), world.allgather(cells.num_nodes))
    graph = cpp.mesh.build_dual_graph(world, cells, 3)
    lists = [[world.rank, *sorted({*rank_of[graph.links(c)]} - {world.rank})] for c in range(cells.num_nodes)]
    offsets = np.cumsum([0, *map(len, lists)], dtype=np.int32)
    destinations = cpp.graph.AdjacencyList_int32(np.fromiter(itertools.chain.from_iterable(lists), np.int32), offsets)
    return lambda comm, ranks, dimension, cells, ghosts: destinations


def lattice(cubes):
    """The mesh of Octetra: cubes in layers by rank, each of six cells."""
    layers = np.array_split(np.arange(cubes), world.size)[world.rank]
    x, y, z = (a.ravel() for a in np.meshgrid(np.arange(cubes), np.arange(cubes), layers, indexing="ij"))
    side = cubes + 1
    number = np.array([1, side, side * side])
    ways = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]])
    steps = np.pad(number[ways].cumsum(axis=1), ((0, 0), (1, 0)))
    steps[3:, [2, 3]] = steps[3:, [3, 2]]  # of the other orientation
    cells = ((x + y * side + z * side * side)[:, None, None] + steps).reshape(-1, 4)
    numbers = np.unique(cells)
    points = np.stack([numbers % side, numbers // side % side, numbers // side**2], axis=1) / cubes
    return octetra.from_arrays(points, cells, vertex_numbers=numbers, comm=world)


def created(mesh):
    """What to call for DOLFINx to create its mesh of the same cells, which stay on their ranks."""
    numbers = mesh.vertex_numbers
    mine = mesh.vertex_sharing.owners == world.rank
    points = np.zeros((mesh.vertex_count, 3))
    points[numbers[mine]] = mesh.points[mine]
    world.Allreduce(MPI.IN_PLACE, points)
    points = np.array_split(points, world.size)[world.rank]
    cells = cpp.graph.AdjacencyList_int64(numbers[mesh.cells].astype(np.int64))
    element = ufl.VectorElement("Lagrange", "tetrahedron", 1)
    stay = staying(cells)
    return lambda: dolfinx.mesh.create_mesh(world, cells, points, ufl.Mesh(element), GHOSTS.none, stay)


def entities(mesh):
    mesh.topology.create_entities(1)
    mesh.topology.create_entities(2)


def matrix(mesh):
    """What solving needs of the mesh: numbers of unknowns, and the matrix of the Laplace operator."""
    space = dolfinx.fem.FunctionSpace(mesh, ("Lagrange", 1))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    dolfinx.fem.petsc.assemble_matrix(dolfinx.fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)).assemble()


def tube(points, cells, width):
    """Around a line through the lattice."""
    middles = points[cells].mean(axis=1)
    return np.linalg.norm(middles[:, :2] - [0.4, 0.5], axis=1) < width


def hand_over(cubes):
    mesh = lattice(cubes)
    mesh.refine(np.abs(mesh.points[mesh.cells, 0].mean(axis=1) - 0.5) < 0.05)
    create = created(mesh)
    ways = {"create_mesh, no ghosts": create,
            "to_mesh, no ghosts": lambda: octetra.dolfinx.to_mesh(mesh, ghosts=None, tags=False).mesh,
            "to_mesh, ghosts by face": lambda: octetra.dolfinx.to_mesh(mesh, tags=False).mesh,
            "from_mesh": None}
    made = create()
    ways["from_mesh"] = lambda: octetra.dolfinx.from_mesh(made)
    taken = {way: [] for way in ways}
    after, solving = {way: [] for way in ways}, {way: [] for way in ways}
    for _ in range(5):
        for way, work in ways.items():
            spent, result = seconds(work)
            taken[way].append(spent)
            if way != "from_mesh":
                after[way].append(seconds(lambda: entities(result))[0])
                solving[way].append(seconds(lambda: matrix(result))[0])
            del result
    say(f"{mesh.count_cells():,} cells, {world.size} ranks\n"
        "| | s | of create_mesh | then edges and facets, s | then a matrix, s |\n|---|---|---|---|---|")
    least = min(taken["create_mesh, no ghosts"])
    for way in ways:
        then = " | ".join(f"{min(of[way]):.3f}" if of[way] else "" for of in (after, solving))
        say(f"| {way} | {min(taken[way]):.4f} | {min(taken[way]) / least:.4f} | {then} |")


def refine_there(domain, marks):
    domain.topology.create_entities(1)
    edges = dolfinx.mesh.compute_incident_entities(domain, np.flatnonzero(marks).astype(np.int32), 3, 1)
    return dolfinx.mesh.refine(domain, edges, redistribute=world.size > 1)


def refine_here(mesh, marks):
    if world.size > 1:
        mesh.refine_evenly(marks)
    else:
        mesh.refine(marks)


def adaptive(steps):
    mesh = lattice(8)
    domain = created(mesh)()
    say("| step | cells, Octetra | refine, s | to_mesh, s | cells, DOLFINx | refine, s | ratio |\n"
        "|---|---|---|---|---|---|---|")
    sums = np.zeros(3)
    for step in range(1, steps + 1):
        width = 0.3 * 0.5**step
        marks = tube(mesh.points, mesh.cells, width)
        refined, _ = seconds(lambda: refine_here(mesh, marks))
        handed, _ = seconds(lambda: octetra.dolfinx.to_mesh(mesh))
        own = domain.topology.index_map(3).size_local
        marks = tube(domain.geometry.x, domain.geometry.dofmap.array.reshape(-1, 4)[:own], width)
        theirs, domain = seconds(lambda: refine_there(domain, marks))
        sums += refined, handed, theirs
        say(f"| {step} | {mesh.count_cells():,} | {refined:.4f} | {handed:.4f} "
            f"| {domain.topology.index_map(3).size_global:,} | {theirs:.3f} | {theirs / (refined + handed):.1f} |")
    say(f"| all | | {sums[0]:.3f} | {sums[1]:.3f} | | {sums[2]:.2f} | {sums[2] / (sums[0] + sums[1]):.1f} |")


hand_over(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
adaptive(int(sys.argv[2]) if len(sys.argv) > 2 else 7)
