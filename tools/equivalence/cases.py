"""The cases of the report."""

import json
import os
from dataclasses import dataclass, field, replace

from machine import ROOT

CORPUS = os.path.join(ROOT, "corpus")


@dataclass(frozen=True)
class Case:
    """One refinement of one mesh: the mesh that `octetra generate` makes from `generate`, or a
    `file`, or the result of the case named in `after`."""
    name: str
    about: str
    group: str
    refine: str  # criteria and levels, as for octetra refine and octetra verify
    generate: str = ""
    file: str = ""
    after: str = ""
    output: str = "refined.ele"
    repeats: int = 1  # of each run; all are compared, and times are medians
    gateway_ranks: tuple = (2, 3, 4)  # numbers of ranks for runs with the gateway
    scaling: bool = False  # whether its times are plotted over the number of ranks
    view: list = field(default_factory=list)  # options of tools/render.py for a picture


SMALL_GEAR = "gear --teeth 5 --thickness 0.32 --bore 0.25 --edge 0.3"
LARGE_GEAR = "gear --teeth 20 --thickness 0.18 --edge 0.1"

GEAR = Case("gear tooth", "one tooth of a gear, twice", "shapes",
            "--sphere 1,0,0.15,0.4 --levels 2", generate="gear",
            view=["--view", "1,-0.25,1.2"])
INCLUSION = Case("inclusion", "the ball in a cube of two materials, by region tag; as a Medit file",
                 "shapes", "--region 2 --levels 2", generate="two-material", output="refined.mesh",
                 view=["--clip", "0.5,0.5,0.5,0,-1,0"])
FICHERA = Case("re-entrant corner", "a cube without an octant, at the inner corner; scheme 4t",
               "shapes", "--box -0.3,-0.3,-0.3,0.3,0.3,0.3 --scheme 4t --levels 4",
               generate="fichera", view=["--view", "0.6,0.7,0.5"])
LATTICE = Case("lattice", "a sphere in a cubic lattice, full of edges of the same length; other "
               "programs find 143,016 cells, too", "shapes",
               "--sphere 0.5,0.5,0.5,0.25 --levels 3", generate="kuhn 8")
RING = Case("ring", "a torus until no cell is larger than 0.0005", "shapes",
            "--max-volume 0.0005 --levels 8", generate="torus")
UNIFORM = Case("uniform", "all cells of a finer gear, once", "shapes", "--all",
               generate="gear --edge 0.05", repeats=3, scaling=True)

PAPER_SMALL = [
    Case("paper, small, 1st", "two fifths of the cells of a small mesh, at random", "paper",
         "--random 0.4 --seed 1", generate=SMALL_GEAR),
    Case("paper, small, 2nd", "the result refined again", "paper",
         "--random 0.28 --seed 1", after="paper, small, 1st"),
]
PAPER_LARGE = [
    Case("paper, large, 1st", "cells at random, all over a mesh", "paper",
         "--random 0.054 --seed 1", generate=LARGE_GEAR, view=["--view", "1,-0.25,1.2"]),
    Case("paper, large, 2nd", "the result refined again", "paper",
         "--random 0.021 --seed 1", after="paper, large, 1st"),
    Case("paper, large, 3rd", "and again", "paper",
         "--random 0.018 --seed 1", after="paper, large, 2nd", repeats=3, scaling=True),
]

# The counts that the paper reports, (vertices, cells), from one refinement to the next. Its vertex
# count for 235,941 cells cannot be right, and for 770,882 cells it has none; None represents both.
PAPER_COUNTS = [
    ("paper, small, 1st", (527, 1803), (3387, 13506)),
    ("paper, small, 2nd", (3387, 13506), (23351, 99121)),
    ("paper, large, 1st", (4502, 14904), (22568, 70203)),
    ("paper, large, 2nd", (22568, 70203), (None, 235941)),
    ("paper, large, 3rd", (None, 235941), (None, 770882)),
]


def seeds():
    """Delaunay meshes of random points, random cells, and every scheme."""
    schemes = ["8t", "4t", "2t"]
    return [Case(f"seed {seed}", f"800 random points, a twentieth of the cells, scheme {scheme}",
                 "seeds", f"--random 0.05 --seed {seed} --scheme {scheme} --levels 2",
                 generate=f"random 800 --seed {seed}")
            for seed, scheme in enumerate(2 * schemes, start=1)]


def corpus():
    """Every mesh of corpus/manifest.json; the small hand-made ones are refined uniformly."""
    with open(os.path.join(CORPUS, "manifest.json"), encoding="utf-8") as file:
        return [of_manifest(entry) for entry in json.load(file)["meshes"]]


def of_manifest(entry):
    about = entry["about"].rstrip(".")
    if "file" in entry:
        return Case(entry["name"], about, "corpus", "--all --levels 2",
                    file=os.path.join(CORPUS, entry["file"]))
    return Case(entry["name"], about, "corpus", "--random 0.1 --seed 1 --levels 2",
                generate=" ".join(entry["generate"]))


def standard():
    """The corpus with the gateway on 4 ranks only; tests/distributed/ runs all combinations."""
    by_fewer_runs = [replace(case, gateway_ranks=(4,)) for case in corpus()]
    return [*in_full(), *by_fewer_runs]


def in_full():
    return [GEAR, INCLUSION, FICHERA, LATTICE, RING, UNIFORM, *PAPER_SMALL, *PAPER_LARGE, *seeds()]


def quick():
    """Cases of a few seconds: every run once."""
    chosen = [GEAR, INCLUSION, PAPER_SMALL[0], seeds()[1]]
    return [replace(case, repeats=1) for case in chosen]
