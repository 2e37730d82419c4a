"""Common parts of the benchmarks with DOLFINx: a distributed lattice, DOLFINx's mesh of the same
cells, a clock."""

import gc
import itertools
import time

import dolfinx.mesh
import numpy as np
import ufl
from dolfinx import cpp
from mpi4py import MPI

import octetra

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
    """Returns a partitioner that leaves these cells on their ranks. It also returns to DOLFINx the
    ranks behind their faces, from which DOLFINx determines sharers. It is evaluated once, so that
    only create_mesh is measured."""
    rank_of = np.repeat(np.arange(world.size), world.allgather(cells.num_nodes))
    graph = cpp.mesh.build_dual_graph(world, cells, 3)
    lists = [[world.rank, *sorted({*rank_of[graph.links(c)]} - {world.rank})] for c in range(cells.num_nodes)]
    offsets = np.cumsum([0, *map(len, lists)], dtype=np.int32)
    destinations = cpp.graph.AdjacencyList_int32(np.fromiter(itertools.chain.from_iterable(lists), np.int32), offsets)
    return lambda comm, ranks, dimension, cells, ghosts: destinations


def created(mesh):
    """Returns a function with which DOLFINx creates its mesh of the same cells, which stay on their
    ranks."""
    numbers = mesh.vertex_numbers
    mine = mesh.vertex_sharing.owners == world.rank
    points = np.zeros((mesh.vertex_count, 3))
    points[numbers[mine]] = mesh.points[mine]
    world.Allreduce(MPI.IN_PLACE, points)
    points = np.array_split(points, world.size)[world.rank]
    cells = cpp.graph.AdjacencyList_int64(numbers[mesh.cells].astype(np.int64))
    element = ufl.VectorElement("Lagrange", "tetrahedron", 1)
    stay = staying(cells)
    return lambda: dolfinx.mesh.create_mesh(world, cells, points, ufl.Mesh(element), dolfinx.mesh.GhostMode.none, stay)
