"""Poisson's equation, -div grad u = 1 with u = 0 on the boundary, with linear elements: conjugate gradients with one
V-cycle of multigrid on the levels of the refined mesh. In each step the cells with the largest variation of u are refined.

    octetra generate fichera --edge 0.5 -o fichera.mesh
    mpirun -n 4 python3 -m mpi4py multigrid_poisson.py fichera.mesh 6

Options of PETSc follow the arguments: -pc_type gamg for another preconditioner, -ksp_monitor.
"""

import sys

import petsc4py

if __name__ == "__main__":
    petsc4py.init(sys.argv)

import numpy as np
from petsc4py import PETSc

import octetra
from octetra.petsc import interpolations


def vector_of(index_map, values):
    """Returns a vector with the values of the vertices that this rank owns."""
    owned = values[index_map.entities[:index_map.owned_count]]
    return PETSc.Vec().createWithArray(np.array(owned, float), (index_map.owned_count, None))


def assemble(mesh, index_map, volumes):
    """Returns the stiffness matrix. Each row and column is that of a vertex of the whole mesh."""
    corners = mesh.points[mesh.cells]
    inverse = np.linalg.inv(corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    gradients = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
    of_cells = np.einsum("cid,cjd,c->cij", gradients, gradients, volumes)
    n = len(mesh.points)  # add up the entries on this rank, in order of rows and columns
    places = np.repeat(mesh.cells.astype(np.int64), 4, axis=1) * n + np.tile(mesh.cells, 4)
    places, which = np.unique(places.ravel(), return_inverse=True)
    begin = np.searchsorted(places, np.arange(n + 1) * n)
    numbers = index_map.numbers.astype(PETSc.IntType)
    matrix = PETSc.Mat().create()
    matrix.setSizes([(index_map.owned_count, None)] * 2)
    matrix.setType("aij")
    matrix.setPreallocationNNZ((np.diff(begin).max(), 20))
    matrix.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
    matrix.setValuesIJV(begin.astype(PETSc.IntType), numbers[places % n],
                        np.bincount(which.ravel(), of_cells.ravel()), PETSc.InsertMode.ADD_VALUES, numbers)
    matrix.assemble()
    return matrix


def constrain(matrix, is_free):
    """Replaces the rows and columns of vertices on the boundary by those of the unit matrix."""
    matrix.diagonalScale(is_free, is_free)
    unit = is_free.copy()
    unit.scale(-1)
    unit.shift(1)
    matrix.setDiagonal(matrix.getDiagonal() + unit)


def preconditioner(solver, mesh, matrix):
    """Sets one V-cycle on the levels of the mesh. Boundary vertices take no part in it."""
    levels = mesh.levels()
    mg = solver.getPC()
    mg.setType("mg")
    mg.setMGLevels(len(levels))
    maps = [level.vertex_sharing.index_map() for level in levels]
    on_boundary = mesh.boundary_vertices()  # the vertices of a level are the first ones of the mesh
    free = [vector_of(m, ~on_boundary[:len(m.numbers)]) for m in maps]
    for k, interpolation in reversed(list(enumerate(interpolations(levels), start=1))):
        interpolation.diagonalScale(free[k], free[k - 1])
        mg.setMGInterpolation(k, interpolation)
        mg.getMGSmoother(k).setOperators(matrix)
        matrix = matrix.ptap(interpolation)
        constrain(matrix, free[k - 1])
    mg.getMGCoarseSolve().setOperators(matrix)
    return len(levels)


def solve(mesh, volumes):
    """Returns u at each vertex of this rank, the number of levels, and that of iterations."""
    sharing = mesh.vertex_sharing
    index_map = sharing.index_map()
    matrix = assemble(mesh, index_map, volumes)
    is_free = vector_of(index_map, ~mesh.boundary_vertices())
    constrain(matrix, is_free)
    right = vector_of(index_map, mesh.vertex_volumes()) * is_free
    solver = PETSc.KSP().create()
    solver.setType("cg")
    solver.setTolerances(rtol=1e-8)
    solver.setOperators(matrix)
    levels = preconditioner(solver, mesh, matrix)
    solver.setFromOptions()
    solution = right.duplicate()
    solver.solve(right, solution)
    u = np.zeros(len(mesh.points))
    u[index_map.entities[:index_map.owned_count]] = solution.array
    return sharing.update_copies(u), levels, solver.getIterationNumber()


def run(path, steps):
    options = PETSc.Options()
    for name, value in {"mg_levels_ksp_type": "chebyshev", "mg_levels_ksp_max_it": 1,
                        "mg_levels_pc_type": "jacobi"}.items():
        if not options.hasName(name):
            options[name] = value
    mesh = octetra.read(path)
    PETSc.Sys.Print("    cells  vertices  levels  iterations")
    for step in range(steps + 1):
        volumes = octetra.quality.volume(mesh)
        u, levels, iterations = solve(mesh, volumes)
        PETSc.Sys.Print(f"{mesh.count_cells():9} {mesh.vertex_count:9} {levels:7} {iterations:11}")
        if step < steps:
            variation = np.ptp(u[mesh.cells], axis=1)
            mesh.refine_evenly(octetra.mark.maximum(mesh, volumes * variation**2, 0.2))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: multigrid_poisson.py INPUT STEPS")
    run(sys.argv[1], int(sys.argv[2]))
