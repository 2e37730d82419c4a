"""Common parts of the benchmarks with DOLFINx 0.5 and 0.9 to 0.11: a distributed lattice, DOLFINx's
mesh of the same cells, a clock."""

import gc
import itertools
import time

import dolfinx.mesh
import numpy as np
import ufl
from dolfinx import cpp
from mpi4py import MPI

import octetra
from octetra.dolfinx._versions import IS_COMPILED_FOR as IS_0_5
from octetra.dolfinx._versions import VERSION

world = MPI.COMM_WORLD


def say(text):
    if world.rank == 0:
        print(text, flush=True)


def seconds(work):
    """Returns the seconds from barrier to barrier, and the result."""
    gc.collect()
    world.Barrier()
    start = time.perf_counter()
    made = work()
    world.Barrier()
    return time.perf_counter() - start, made


def lattice(cubes):
    """The mesh of Octetra: layers of cubes for each rank, with six cells in each cube."""
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


def staying(cells):
    """Returns a partitioner that leaves these cells on their ranks. It is evaluated once, so that
    only create_mesh is measured."""
    if IS_0_5:
        lists = with_ranks_behind_faces(cells)
    else:
        lists = np.full((len(cells), 1), world.rank)
    offsets = np.cumsum([0, *map(len, lists)], dtype=np.int32)
    destinations = cpp.graph.AdjacencyList_int32(np.fromiter(itertools.chain.from_iterable(lists), np.int32), offsets)
    return lambda *_: destinations


def with_ranks_behind_faces(cells):
    """Returns for each cell this rank and those behind its faces, from which DOLFINx 0.5 determines
    sharers. Later versions would make ghosts there."""
    rank_of = np.repeat(np.arange(world.size), world.allgather(len(cells)))
    graph = cpp.mesh.build_dual_graph(world, cpp.graph.AdjacencyList_int64(cells), 3)
    return [[world.rank, *sorted({*rank_of[graph.links(c)]} - {world.rank})] for c in range(len(cells))]


def created(mesh):
    """Returns a function with which DOLFINx creates its mesh of the same cells, which stay on their
    ranks."""
    numbers = mesh.vertex_numbers
    mine = mesh.vertex_sharing.owners == world.rank
    points = np.zeros((mesh.vertex_count, 3))
    points[numbers[mine]] = mesh.points[mine]
    world.Allreduce(MPI.IN_PLACE, points)
    points = np.array_split(points, world.size)[world.rank]
    cells = numbers[mesh.cells].astype(np.int64)
    stay = staying(cells)
    create = dolfinx.mesh.create_mesh
    if IS_0_5:
        lists, domain = cpp.graph.AdjacencyList_int64(cells), ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
        return lambda: create(world, lists, points, domain, dolfinx.mesh.GhostMode.none, stay)
    import basix.ufl

    domain = ufl.Mesh(basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,)))
    geometry = (points, domain) if VERSION < (0, 10) else (domain, points)
    return lambda: create(world, cells, *geometry, partitioner=stay)
