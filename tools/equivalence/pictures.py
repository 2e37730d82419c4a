"""Pictures of meshes, coloured by the rank that has each cell, drawn by tools/render.py."""

import os

from machine import ROOT
from measure import coarse_mesh
from running import must, run

RENDER = os.path.join(ROOT, "tools", "render.py")
RANKS = 4
NOTHING = ["--random", "0", "--seed", "1"]  # selects no cell: the distributed input


def pieces(case, mesh, place, criteria, name):
    """A mesh as distributed over the ranks, in pieces."""
    path = os.path.join(place.folder, name)
    must(["mpirun", "-n", str(RANKS), place.octetra, "refine", mesh, *criteria, "--quiet",
          "-o", path], place.folder)
    return path


def draw(case, place, output):
    """Draws the mesh before and after into `output`, a .png. Returns the reason if there is no
    picture, otherwise ""."""
    mesh = coarse_mesh(case, place)
    before = pieces(case, mesh, place, NOTHING, "before.pvtu")
    after = pieces(case, mesh, place, case.refine.split(), "after.pvtu")
    outcome = run([RENDER, before, after, "-o", output, "--color", "rank", "--size", "1500x720",
                   *case.view], place.folder)
    return "" if outcome.status == 0 else outcome.err.strip()
