"""Poisson's equation, -div grad u = 1 with u = 0 on the boundary, with linear elements in petsc4py: in each step the
mesh is converted to a DMPlex, PETSc solves on it, and the cells with the largest variation of u are refined.

    mpirun -n 4 python3 -m mpi4py petsc_poisson.py cube.mesh 3

Options of PETSc follow the arguments: -pc_type gamg -ksp_monitor.
"""

import sys

import petsc4py

if __name__ == "__main__":
    petsc4py.init(sys.argv)

import numpy as np
from petsc4py import PETSc

import octetra
from octetra.petsc import points_of, to_plex


def give_vertices_unknowns(plex):
    """Assigns an unknown to each vertex except those on the boundary, whose faces to_plex() has labelled."""
    boundary = plex.getLabel("boundary")
    plex.labelComplete(boundary)  # their vertices and edges, on all ranks that have them
    plex.setNumFields(1)
    plex.setSection(plex.createSection([1], [1, 0, 0, 0], [0], bcPoints=[boundary.getStratumIS(1)]))


def places(plex, mesh):
    """Returns the position in a local vector of the value at each vertex of this rank."""
    section, first = plex.getSection(), points_of(plex).first_vertex
    return np.array([section.getOffset(first + v) for v in range(len(mesh.points))], PETSc.IntType)


def gradients(mesh):
    """Returns the gradients of the four hat functions of each cell: (cells, 4, 3)."""
    corners = mesh.points[mesh.cells]
    inverse = np.linalg.inv(corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    return np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)


def assemble(plex, mesh, place, volumes):
    """Returns the matrix and the right-hand side. PETSc ignores entries with negative indices, which are no unknowns."""
    g = gradients(mesh)
    unknowns = plex.getLGMap().apply(place)[mesh.cells]
    matrix = plex.createMatrix()
    for of_cell, values in zip(unknowns, np.einsum("cid,cjd,c->cij", g, g, volumes)):
        matrix.setValues(of_cell, of_cell, values, PETSc.InsertMode.ADD_VALUES)
    matrix.assemble()
    local, right = plex.createLocalVector(), plex.createGlobalVector()
    local.array[place] = np.bincount(mesh.cells.ravel(), np.repeat(volumes / 4, 4), len(mesh.points))
    plex.localToGlobal(local, right, PETSc.InsertMode.ADD_VALUES)
    return matrix, right


def solve(mesh, volumes):
    """Returns u at each vertex of this rank, and the number of unknowns."""
    plex = to_plex(mesh)
    give_vertices_unknowns(plex)
    place = places(plex, mesh)
    matrix, right = assemble(plex, mesh, place, volumes)
    solver = PETSc.KSP().create(plex.comm)
    solver.setType("cg")
    solver.setTolerances(rtol=1e-10)
    solver.setOperators(matrix)
    solver.setFromOptions()
    solution = right.duplicate()
    solver.solve(right, solution)
    local = plex.createLocalVector()
    local.set(0)  # including the boundary
    plex.globalToLocal(solution, local)
    return local.array[place], solution.size


def run(path, steps):
    mesh = octetra.read(path)
    PETSc.Sys.Print("    cells  unknowns  integral of u")
    for step in range(steps + 1):
        volumes = octetra.quality.volume(mesh)
        u, unknowns = solve(mesh, volumes)
        of_cells = u[mesh.cells]
        integral = PETSc.COMM_WORLD.tompi4py().allreduce(volumes @ of_cells.mean(axis=1))
        PETSc.Sys.Print(f"{mesh.count_cells():9} {unknowns:9} {integral:14.8f}")
        if step < steps:
            mesh.refine(octetra.mark.maximum(mesh, volumes * np.ptp(of_cells, axis=1) ** 2, 0.2))
            mesh.rebalance()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: petsc_poisson.py INPUT STEPS")
    run(sys.argv[1], int(sys.argv[2]))
