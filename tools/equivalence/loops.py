"""Scripts of steps as in a solver's loop: by the serial reference, on 1 to 4 ranks, and interrupted
halfway and continued on another number of ranks. All intermediate meshes are compared byte by byte.
"""

import os
import re
from dataclasses import dataclass

import comparing
from measure import load, remove
from running import Failure, must, own_message, run

RANKS = (1, 2, 3, 4)
RESTARTS = ((1, 3), (4, 2), (3, 1))  # numbers of ranks before and after the interruption
END = "coarsen --all --levels 50"  # the end of every loop, which restores the input


@dataclass(frozen=True)
class Loop:
    name: str
    about: str
    generate: str  # for octetra generate
    steps: list  # of octetra adapt


def front(cycles):
    """A ball that moves along a diagonal: the mesh is coarsened where the ball has left."""
    steps = []
    for k in range(cycles):
        at = 0.2 + 0.6 * k / (cycles - 1)
        steps += ["coarsen --all --levels 9", f"refine --sphere {at:.3f},{at:.3f},{at:.3f},0.25 --levels 3",
                  "rebalance"]
    return steps


MIXED = ["refine --random 0.2 --seed 1", "refine --sphere 0.3,0.3,0.3,0.3 --levels 2 --scheme 4t",
         "coarsen --random 0.7 --seed 2", "refine --max-volume 0.001 --levels 2", "coarsen --sphere 0.5,0.5,0.5,0.4",
         "rebalance", "refine --random 0.1 --seed 3 --scheme 2t", "coarsen --outside --box 0.2,0.2,0.2,0.8,0.8,0.8",
         "coarsen --random 0.9 --seed 4 --levels 2", "refine --sphere 0.8,0.5,0.5,0.2 --levels 2"]

MOVING = Loop("loop: moving front", "a ball moves through a lattice, full of edges of the same length, in 8 cycles",
              "kuhn 8", front(8))
STEPS = Loop("loop: mixed steps", "ten steps of all kinds on a Delaunay mesh of 600 random points",
             "random 600 --seed 3", MIXED)
GEAR = Loop("loop: gear", "refined twice and taken back, on a gear with markers",
            "gear", ["refine --sphere 1,0,0.15,0.5 --levels 2", "coarsen --sphere 1,0,0.15,0.3",
                     "refine --random 0.1 --seed 5"])


def standard():
    return [MOVING, STEPS, GEAR]


def quick():
    return [GEAR]


def script_of(steps, first):
    """The steps, with a mesh written after each; they are numbered from `first`."""
    lines = []
    for number, step in enumerate(steps, start=first):
        lines += [step, f"write step{number:02}.mesh"]
    return "\n".join(lines) + "\n"


def adapt(place, folder, mesh, steps, first, output, launcher, options):
    with open(os.path.join(place.folder, "steps.txt"), "w", encoding="utf-8") as file:
        file.write(script_of(steps, first))
    return run([*launcher, place.octetra, "adapt", mesh, "--script", "../steps.txt", *options, "-o", output],
               folder)


def new_folder(place, name):
    folder = os.path.join(place.folder, name)
    remove(folder)
    os.mkdir(folder)
    return folder


def held_against_reference(place, folder, outcome):
    if outcome.status != 0:
        return [f"status {outcome.status}: {own_message(outcome) or outcome.err.strip()[-200:]}"]
    return comparing.differences(os.path.join(place.folder, "reference"), folder)


def evenness(said):
    """The ratio of the maximum to the mean number of cells of the ranks, before and after each step
    `rebalance`."""
    found = re.findall(r"rebalanced, .*most/mean cells ([\d.]+)(?: to ([\d.]+))?", said)
    return [(float(before), float(after or before)) for before, after in found]


def figures(profile, said):
    return {"seconds": profile["seconds"]["max"], "rebalanced": evenness(said),
            "bytes": sum(phase["bytes"]["sum"] for phase in profile["phases"]),
            "peak_memory_bytes": profile["peak_memory_bytes"]["max"]}


def on_ranks(loop, mesh, place, ranks):
    folder, profile = new_folder(place, "parallel"), os.path.join(place.folder, "profile.json")
    outcome = adapt(place, folder, mesh, [*loop.steps, END], 1, "end.mesh", ["mpirun", "-n", str(ranks)],
                    ["--profile", profile])
    lines = held_against_reference(place, folder, outcome)
    return {"ranks": [ranks], "identical": not lines, "differences": lines,
            "figures": figures(load(profile), outcome.out) if outcome.status == 0 else None}


def restarted(loop, mesh, place, before, after):
    """Interrupted halfway, and continued from a checkpoint on another number of ranks."""
    folder, half = new_folder(place, "parallel"), len(loop.steps) // 2
    outcome = adapt(place, folder, mesh, loop.steps[:half], 1, "state.octetra", ["mpirun", "-n", str(before)], [])
    if outcome.status == 0:
        outcome = adapt(place, folder, "state.octetra", [*loop.steps[half:], END], half + 1, "end.mesh",
                        ["mpirun", "-n", str(after)], [])
    remove(os.path.join(folder, "state.octetra"))
    lines = held_against_reference(place, folder, outcome)
    return {"ranks": [before, after], "identical": not lines, "differences": lines, "figures": None}


def verdict_of(mesh, place, name):
    """Returns whether the verifier accepts a mesh of the reference as a refinement of the input."""
    outcome = run([place.octetra, "verify", mesh, os.path.join("reference", name)], place.folder)
    if outcome.status not in (0, 1):
        raise Failure(f"octetra verify ended with status {outcome.status}:\n{outcome.err.strip()}")
    return outcome.status == 0


def cells_of(path):
    """The number of cells in a Medit text file written by octetra."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() == "Tetrahedra":
                return int(next(file))
    return 0


def measure_loop(loop, place):
    """The results of a loop, as an entry of the report's JSON."""
    mesh = os.path.join(place.folder, "input.mesh")
    must([place.octetra, "generate", *loop.generate.split(), "--quiet", "-o", mesh], place.folder)
    folder = new_folder(place, "reference")
    outcome = adapt(place, folder, mesh, [*loop.steps, END], 1, "end.mesh", [], ["--engine", "reference"])
    if outcome.status != 0:
        raise Failure(f"{loop.name}: the reference ended with status {outcome.status}:\n{outcome.err.strip()}")
    names = sorted(name for name in os.listdir(folder) if name.startswith("step"))
    cells = [cells_of(os.path.join(folder, name)) for name in names]
    finest = names[cells.index(max(cells))]
    comes_back = comparing.first_difference(mesh, os.path.join(folder, "end.mesh")) is None
    size = sum(file["bytes"] for file in comparing.fingerprints(folder).values())
    runs = ([on_ranks(loop, mesh, place, ranks) for ranks in RANKS]
            + [restarted(loop, mesh, place, *ranks) for ranks in RESTARTS])
    valid = verdict_of(mesh, place, finest)
    return {"name": loop.name, "about": loop.about, "generate": loop.generate, "steps": [*loop.steps, END],
            "input_cells": cells_of(mesh), "cells": cells, "bytes": size, "runs": runs,
            "reference": {"seconds": outcome.seconds}, "input_comes_back": comes_back, "valid": valid,
            "identical": comes_back and all(run["identical"] for run in runs)}
