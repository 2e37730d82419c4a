"""Time of transferring a mesh to DOLFINx compared with its create_mesh on the same cells:
hand_over.py [CUBES] [--json], under mpirun for several ranks.

Prints the minimum of five runs, in seconds from barrier to barrier, for a lattice of 6 * CUBES^3
cells, a tenth of which are bisected. PYTHONPATH must contain octetra.
"""

import argparse
import json

import dolfinx.fem.petsc
import numpy as np
import ufl
from lattice import created, lattice, say, seconds, world

import octetra.dolfinx
from octetra.dolfinx._versions import linear_space

CREATE, TO, GHOSTS, FROM = "create_mesh, no ghosts", "to_mesh, no ghosts", "to_mesh, ghosts by face", "from_mesh"


def entities(mesh):
    mesh.topology.create_entities(1)
    mesh.topology.create_entities(2)


def matrix(mesh):
    """Creates what a solver needs of the mesh: the numbering of unknowns, and the matrix of the
    Laplace operator."""
    space = linear_space(mesh, None)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    dolfinx.fem.petsc.assemble_matrix(dolfinx.fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)).assemble()


def measure(mesh):
    """Returns {method: {operation: least seconds}}."""
    create = created(mesh)
    made = create()
    ways = {CREATE: create,
            TO: lambda: octetra.dolfinx.to_mesh(mesh, ghosts=None, tags=False).mesh,
            GHOSTS: lambda: octetra.dolfinx.to_mesh(mesh, tags=False).mesh,
            FROM: lambda: octetra.dolfinx.from_mesh(made)}
    least = {way: {} for way in ways}
    for _ in range(5):
        for way, work in ways.items():
            taken = {}
            taken["seconds"], result = seconds(work)
            if way != FROM:
                taken["entities_seconds"] = seconds(lambda: entities(result))[0]
                taken["matrix_seconds"] = seconds(lambda: matrix(result))[0]
            del result
            least[way] = {what: min(spent, least[way].get(what, spent)) for what, spent in taken.items()}
    return least


def table(cells, least):
    say(f"{cells:,} cells, {world.size} ranks\n"
        "| | s | of create_mesh | then edges and facets, s | then a matrix, s |\n|---|---|---|---|---|")
    for way, of in least.items():
        then = " | ".join(f"{of[key]:.3f}" if key in of else "" for key in ("entities_seconds", "matrix_seconds"))
        say(f"| {way} | {of['seconds']:.4f} | {of['seconds'] / least[CREATE]['seconds']:.4f} | {then} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("cubes", nargs="?", type=int, default=40)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    mesh = lattice(options.cubes)
    mesh.refine(np.abs(mesh.points[mesh.cells, 0].mean(axis=1) - 0.5) < 0.05)
    cells, least = mesh.count_cells(), measure(mesh)
    if options.json:
        say(json.dumps({"ranks": world.size, "cells": cells, "ways": least}))
    else:
        table(cells, least)


main()
