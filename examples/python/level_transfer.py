"""Transfer of quadratic elements and of edge elements (Nedelec's, of lowest order) between the levels of a mesh, without
messages: the barycentric coordinates of a child's corners in its parent determine everything.

    octetra generate gear -o gear.1.ele
    mpirun -n 2 python3 -m mpi4py level_transfer.py gear.1.ele
"""

import sys

import numpy as np

import octetra

EDGES = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])  # corners of each edge of a cell


def edges_of(cells):
    """Returns the edges of this rank by their ends, ascending, and for each cell its six edges."""
    ends, number = np.unique(np.sort(cells[:, EDGES].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    return ends, number.reshape(-1, 6)


def corners_in_parents(coarse, fine):
    """Returns the parent of each cell of the fine level, and the barycentric coordinates of its corners in the parent,
    (cells, corner of the child, corner of the parent)."""
    parents, _ = fine.parents()
    p = coarse.points[coarse.cells[parents]]
    of_three = np.linalg.solve((p[:, 1:] - p[:, :1]).transpose(0, 2, 1),
                               (fine.points[fine.cells] - p[:, :1]).transpose(0, 2, 1)).transpose(0, 2, 1)
    return parents, np.concatenate([1 - of_three.sum(axis=2, keepdims=True), of_three], axis=2)


def prolong_quadratic(coarse, fine, values):
    """Values of a quadratic function at the vertices of the coarse level and then at the middles of its edges, to those
    of the fine level."""
    parents, corners = corners_in_parents(coarse, fine)
    _, coarse_edges = edges_of(coarse.cells)
    fine_ends, fine_edges = edges_of(fine.cells)
    at = np.concatenate([corners, corners[:, EDGES].mean(axis=2)], axis=1)  # (cells, node, corner of the parent)
    basis = np.concatenate([at * (2 * at - 1), 4 * at[:, :, EDGES].prod(axis=3)], axis=2)
    of_parents = values[np.concatenate([coarse.cells, len(coarse.points) + coarse_edges], axis=1)][parents]
    made = np.empty(len(fine.points) + len(fine_ends))
    made[np.concatenate([fine.cells, len(fine.points) + fine_edges], axis=1)] = np.einsum(
        "cnj,cj->cn", basis, of_parents)
    return made


def prolong_along_edges(coarse, fine, values):
    """Integrals of a field along the edges of the coarse level, from the lower to the higher vertex, to those along the
    edges of the fine level. The basis function of the edge from i to j is l_i grad l_j - l_j grad l_i, with barycentric
    coordinates l; its integral from a to b is l_i(a) l_j(b) - l_j(a) l_i(b)."""
    parents, corners = corners_in_parents(coarse, fine)
    _, coarse_edges = edges_of(coarse.cells)
    fine_ends, fine_edges = edges_of(fine.cells)
    of_parents = (values[coarse_edges] * directions(coarse.cells))[parents]
    a, b = corners[:, EDGES[:, 0]], corners[:, EDGES[:, 1]]
    i, j = EDGES.T
    integrals = a[:, :, i] * b[:, :, j] - a[:, :, j] * b[:, :, i]  # (cells, edge of the child, edge of the parent)
    made = np.empty(len(fine_ends))
    made[fine_edges] = np.einsum("cej,cj->ce", integrals, of_parents) * directions(fine.cells)
    return made


def directions(cells):
    """Returns 1 for each edge of a cell that leads from the lower to the higher vertex, else -1."""
    return np.where(cells[:, EDGES[:, 0]] < cells[:, EDGES[:, 1]], 1, -1)


def quadratic(x):
    return x[:, 0] * x[:, 1] - x[:, 2]**2 + 2 * x[:, 1] + 1


def field(x):
    return np.cross([1.0, -2.0, 0.5], x) + [3.0, 1.0, -1.0]  # the edge elements contain such fields


def values_on(level):
    """Returns the two functions on a level, as the functions above represent them."""
    ends, _ = edges_of(level.cells)
    a, b = level.points[ends[:, 0]], level.points[ends[:, 1]]
    middles = (a + b) / 2
    return quadratic(np.concatenate([level.points, middles])), (field(middles) * (b - a)).sum(axis=1)


def run(path):
    mesh = octetra.read(path)
    for seed in range(3):
        mesh.refine_evenly(octetra.mark.random(mesh, 0.2, seed))
    levels = mesh.levels(growth=1)
    for coarse, fine in zip(levels, levels[1:]):
        (u, v), (fine_u, fine_v) = values_on(coarse), values_on(fine)
        errors = [np.abs(prolong_quadratic(coarse, fine, u) - fine_u).max(initial=0),
                  np.abs(prolong_along_edges(coarse, fine, v) - fine_v).max(initial=0)]
        if max(errors) > 1e-12:
            sys.exit(f"rank {mesh.rank}: errors {errors}")
        if mesh.rank == 0:
            print(f"{coarse.vertex_count} to {fine.vertex_count} vertices: both are the same functions")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: level_transfer.py INPUT")
    run(sys.argv[1])
