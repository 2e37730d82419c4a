"""The paper's tables, made again: what can be, of M. Balman, Tetrahedral Mesh Refinement in Distributed Environments.

    ./dev bench --paper        measures, into bench/paper/measured.json and docs/paper.md
    python3 bench/paper page   makes docs/paper.md anew of what was measured
    python3 bench/paper check  status 1 if the page is another

Meshes are octetra's own, of the paper's sizes. All but seconds is the same on any machine.
"""
import argparse
import json
import os
import pathlib
import random
import sys
import tempfile

BENCH = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(BENCH.parent / "tools/equivalence"), str(BENCH)]

import prose  # noqa: E402
import tables  # noqa: E402
from cases import LARGE_GEAR, PAPER_COUNTS, SMALL_GEAR  # noqa: E402
from machine import describe  # noqa: E402
from paper.figures import figures_of  # noqa: E402
from program import ROOT, Octetra, median, rounds_of_levels, told  # noqa: E402
from propagation import predicted, read_medit  # noqa: E402

HERE = pathlib.Path(__file__).parent
MEASURED = HERE / "measured.json"
SMALL, LARGE = PAPER_COUNTS[:2], PAPER_COUNTS[2:]
#        kind of mesh and its size: what is generated, and of each run the share of cells that is marked
MESHES = {("gear", "small"): (SMALL_GEAR, (0.4, 0.28)),
          ("gear", "large"): (LARGE_GEAR, (0.054, 0.021, 0.018)),
          ("random", "small"): ("random 309 --seed 1", (0.21, 0.22)),
          ("random", "large"): ("random 2295 --seed 1", (0.0285, 0.0155, 0.0148))}
SHARES = (0.001, 0.01, 0.05, 0.2)
RANKS = (1, 2, 3, 4)
PARTS = (2, 4, 8, 16, 64)
METHODS = ("lepp", "dual", "rcb", "block")


class Sizes:
    """Large enough to say something; or only to see that all runs."""

    def __init__(self, quick):
        self.propagation = "random 300 --seed 1" if quick else "random 26000 --seed 1"
        self.levels = "random 300 --seed 1" if quick else MESHES["random", "large"][0]
        self.parts = (2, 4) if quick else PARTS
        self.synchronised = (2, 4) if quick else (2, 4, 8)
        self.timed_ranks = (1, 2) if quick else RANKS
        self.sizes = ("small",) if quick else ("small", "large")
        self.uniform = "kuhn 4" if quick else "kuhn 40"


def runs(octetra, sizes):
    """The paper's refinements, each of the result of the one before."""
    made = []
    for (kind, size), (shape, shares) in MESHES.items():
        if size not in sizes.sizes:
            continue
        counts = [octetra.generate(shape, f"{kind}-{size}-0.meshb")]
        for n, share in enumerate(shares):
            out = f"{kind}-{size}-{n + 1}.meshb"
            octetra.refine(f"{kind}-{size}-{n}.meshb", out, f"--random {share} --seed 1")
            counts.append(octetra.counts(out))
        made.append({"kind": kind, "size": size, "shape": shape, "shares": shares, "counts": counts})
    return made


def one_level(octetra, name, share, out, seed):
    """Cells drawn here, closed here and by octetra: the counts must be the same."""
    points, cells = read_medit(octetra.folder / name)
    chosen = sorted(random.Random(seed).sample(range(len(cells)), max(1, round(share * len(cells)))))
    (octetra.folder / "cells.txt").write_text("\n".join(str(c + 1) for c in chosen) + "\n")
    foreseen = predicted(points, cells, chosen)
    rounds = {}
    for ranks in (2, 4, 8):
        profile = octetra.refine(name, out, "--cells cells.txt", ranks=ranks, partition="lepp")
        rounds[ranks] = rounds_of_levels(profile)[0]
    found = octetra.counts(out)
    if found != {key: foreseen[key] for key in found}:
        sys.exit(f"paper: {name}, {share}: octetra makes {found}, and it should be {foreseen}")
    return {"share": share, "input_cells": len(cells), "marked": len(chosen), "rounds": rounds, **foreseen}


def propagation(octetra, sizes):
    octetra.generate(sizes.propagation, "wide.mesh")
    shares = [one_level(octetra, "wide.mesh", share, "out.mesh", seed=1) for share in SHARES]
    octetra.generate(sizes.levels, "level-0.mesh")
    levels = [one_level(octetra, f"level-{n}.mesh", 0.01, f"level-{n + 1}.mesh", seed=n) for n in range(3)]
    return {"shares": shares, "levels": levels}


def partitions(octetra, sizes):
    made = []
    for kind in ("gear", "random"):
        name = f"{kind}-{sizes.sizes[-1]}-0.meshb"
        for parts in sizes.parts:
            made.append({"kind": kind, "parts": parts,
                         "methods": {m: octetra.partition(name, parts, m) for m in METHODS}})
    return made


def synchronisation(octetra, sizes):
    """The last but one of each mesh's runs, by either synchronisation."""
    made = []
    for kind in ("gear", "random"):
        size = sizes.sizes[-1]
        shares = MESHES[kind, size][1]
        n = len(shares) - 2
        for ranks in sizes.synchronised:
            ways = {sync: told(octetra.refine(f"{kind}-{size}-{n}.meshb", "out.meshb",
                                              f"--random {shares[n]} --seed 1", ranks=ranks, partition="lepp",
                                              sync=sync))
                    for sync in ("neighbour", "gateway")}
            made.append({"kind": kind, "ranks": ranks, "ways": ways})
    return made


def speed(octetra, sizes, repetitions):
    """The last run of each mesh, and a lattice whole. Turn by turn, so that a busy moment does not meet one number of
    ranks alone."""
    size = sizes.sizes[-1]
    cases = []
    for kind in ("gear", "random"):
        shares = MESHES[kind, size][1]
        cases.append((f"{kind}-{size}-{len(shares) - 1}.meshb", shares[-1]))
    octetra.generate(sizes.uniform, "lattice.meshb")
    cases.append(("lattice.meshb", 1))
    made = []
    for name, share in cases:
        seconds = {ranks: [] for ranks in sizes.timed_ranks}
        for _ in range(repetitions):
            for ranks in sizes.timed_ranks:
                level = octetra.timed_level(name, share, ranks)
                seconds[ranks].append(level["seconds"])
        made.append({"mesh": name.split("-")[0].split(".")[0], "cells": [level["before"], level["cells"]],
                     "seconds": {ranks: {"median": median(of), "least": min(of), "most": max(of)}
                                 for ranks, of in seconds.items()}})
    return made


def measure(build, repetitions, quick, only):
    sizes, where = Sizes(quick), describe(str(build / "cli/octetra"))
    made = json.loads(MEASURED.read_text()) if only else {}
    with tempfile.TemporaryDirectory() as folder:
        octetra = Octetra(build, folder)
        made["runs"] = runs(octetra, sizes)
        if only != "counts":
            made["speed"] = speed(octetra, sizes, repetitions)
            made["machine"] = {**where, "repetitions": repetitions}
        if only != "speed":
            made["partitions"] = partitions(octetra, sizes)
            made["synchronisation"] = synchronisation(octetra, sizes)
            made["propagation"] = propagation(octetra, sizes)
    return json.loads(json.dumps(made))


def tables_of(made):
    return {"runs": tables.runs_table(made["runs"], {"small": SMALL, "large": LARGE}),
            "shares": tables.shares_table(made["propagation"]["shares"]),
            "levels": tables.levels_table(made["propagation"]["levels"]),
            "partitions": tables.partitions_table(made["partitions"]),
            "synchronisation": tables.synchronisation_table(made["synchronisation"]),
            "speed": tables.speed_table(made["speed"])}


def page_text(made):
    try:
        text = (HERE / "page.md").read_text().replace("{machine}", tables.machine_words(made["machine"]))
        text = prose.told(text, lambda query: figures_of(made, query))
    except prose.NotTrue as why:
        sys.exit(f"bench/paper/page.md, {why}")
    for name, table in tables_of(made).items():
        text = text.replace(f"{{{name}}}", table)
    return text


def lines_of(made):
    """JSON, an entry a line."""
    def text(value):
        if isinstance(value, list):
            return "[" + ",\n  ".join(json.dumps(entry) for entry in value) + "]"
        if isinstance(value, dict) and any(isinstance(entry, list) for entry in value.values()):
            return "{" + ",\n  ".join(f"{json.dumps(key)}: {text(entry)}" for key, entry in value.items()) + "}"
        return json.dumps(value)
    return text(made) + "\n"


def main():
    parser = argparse.ArgumentParser(usage="./dev bench --paper [--quick] [--repetitions N] [--only speed|counts] [--list]",
                                     description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["measure", "page", "check"],
                        help="measure: what ./dev bench --paper does")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", metavar="FOLDER",
                        help="where it is built [build/release]")
    parser.add_argument("--repetitions", type=int, default=5, metavar="N", help="runs of each, of which the medians count [5]")
    parser.add_argument("--quick", action="store_true", help="small meshes, once; prints, and writes no file")
    parser.add_argument("--only", choices=["speed", "counts"], help="measure this, and keep the other")
    parser.add_argument("--list", action="store_true", help="only name the tables")
    chosen = parser.parse_args()
    page = ROOT / "docs/paper.md"
    if chosen.list:
        print("runs\nspeed\npartitions\nsynchronisation\npropagation")
        return 0
    if chosen.what == "measure":
        made = measure(chosen.build, 1 if chosen.quick else chosen.repetitions, chosen.quick, chosen.only)
        if chosen.quick:
            print("\n\n".join(f"{name}\n\n{table}" for name, table in tables_of(made).items()))
            return 0
        MEASURED.write_text(lines_of(made))
    text = page_text(json.loads(MEASURED.read_text()))
    if chosen.what == "check":
        return 0 if page.read_text() == text else 1
    page.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
