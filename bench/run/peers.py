"""Octetra compared with DOLFINx: the same mesh from the same file, the same cells chosen,
alternating."""

import os

from measuring import (BEGUN_AGAIN, Case, Figure, Run, driver, launcher, median, median_ratio,
                       spread_figure)
from running import must, run

OURS, THEIRS = "bench/bench_refine", "bench/peers/peer_dolfinx"
SPHERE = "0.5,0.5,0.5,0.25"
# On more ranks than cores DOLFINx's partitioner sometimes hangs or crashes.
PATIENCE = 90  # seconds; the longest run takes 45


def name_of(program, ranks):
    return f"{program}, " + ("1 rank" if ranks == 1 else f"{ranks} ranks")


def runs(mesh, ours, theirs, all_ranks):
    return [driver(name_of(program, ranks), path, arguments, ranks, mesh, patience)
            for ranks in all_ranks
            for program, path, arguments, patience in (("octetra", OURS, ours, None),
                                                       ("DOLFINx", THEIRS, theirs, PATIENCE))]


def cells_a_second(lines, level):
    return lines[0]["levels"][level]["cells"] / median(lines, "levels", level, "seconds")


def ratio(lines, level, ranks, clock="seconds"):
    """The ratio of our speed to theirs. The numbers of cells are equal, as checked by
    other_counts()."""
    ours, theirs = (lines[name_of(program, ranks)] for program in ("octetra", "DOLFINx"))
    return median_ratio(theirs, ours, "levels", level, clock)


def other_counts(lines):
    """Lists the runs whose cells differ from those of the first; there must be none."""
    first_name, first = next(iter(lines.items()))
    expected = [level["cells"] for level in first[0]["levels"]]
    return [f"{name} has {found} cells, {first_name} {expected}"
            for name, of_run in lines.items() for line in of_run
            if (found := [level["cells"] for level in line["levels"]]) != expected]


def level_figures(least, all_ranks):
    def figures(lines):
        made = []
        for level, first in enumerate(lines[name_of("octetra", 1)][0]["levels"]):
            words = f"level {level + 1}"
            made.append(Figure(f"{words}: cells of the result, of both", first["cells"], ""))
            for ranks in all_ranks:
                made += [spread_figure(f"{words}: {name}", "s", lines[name],
                                       "levels", level, "seconds")
                         for name in (name_of("octetra", ranks), name_of("DOLFINx", ranks))]
                made.append(Figure(f"{words}: speed against DOLFINx, " + name_of("", ranks)[2:],
                                   ratio(lines, level, ranks), "times", at_least=least))
            made.append(Figure(f"{words}: speed against DOLFINx, 1 rank, by the processor",
                               ratio(lines, level, 1, "processor_seconds"), "times"))
        memory = [median(lines[name_of(program, 1)], "peak_bytes")
                  for program in ("DOLFINx", "octetra")]
        again = sum(line[BEGUN_AGAIN] for ranks in all_ranks
                    for line in lines[name_of("DOLFINx", ranks)])
        return made + [Figure("its peak memory against ours, 1 rank", memory[0] / memory[1],
                              "times"),
                       Figure("runs of DOLFINx that crashed or did not end, and were begun again",
                              again, "")]
    return figures


def bars(lines):
    """The speeds of the last level."""
    return [{"name": name, "cells_a_second": cells_a_second(of_run, -1)}
            for name, of_run in lines.items()]


def uniform(cubes):
    mesh = (f"kuhn {cubes}", "uniform-peers.mesh")
    all_ranks = (1, 2)
    return Case("beside DOLFINx, uniform", runs(mesh, "1 0 --json", "", all_ranks),
                level_figures(80, all_ranks), bars, other_counts)


def sphere(cubes):
    mesh = (f"kuhn {cubes}", "sphere-peers.mesh")
    all_ranks = (1, 2, 4)
    return Case("beside DOLFINx, sphere",
                runs(mesh, "3 0.25 --json", f"--levels 3 --sphere {SPHERE}", all_ranks),
                level_figures(60, all_ranks), bars, other_counts)


def bare_figures(lines):
    return [*(spread_figure(name, "s", of_run, "levels", 0, "seconds")
              for name, of_run in lines.items()),
            Figure("speed against DOLFINx, which makes no mesh of its cells, 1 rank",
                   ratio(lines, 0, 1), "times")]


def bare(cubes):
    mesh = (f"kuhn {cubes}", "uniform-peers.mesh")
    return Case("beside DOLFINx, uniform, new cells and points alone", [
        driver(name_of("octetra", 1), OURS, "1 0 --json", 1, mesh),
        driver(name_of("DOLFINx", 1), THEIRS, "--bare", 1, mesh)], bare_figures,
        wrong=other_counts)


# --- is what it makes right?


def judged(place, ranks, mesh, levels):
    """The verdict of octetra verify on DOLFINx's result, and its number of cells. DOLFINx drops
    markers and inverts some cells, so the coarse mesh is also converted by it."""
    path = place.mesh(*mesh)
    octetra, theirs = place.program("cli/octetra"), place.program(THEIRS)
    for name, options in (("coarse", ["--levels", "0"]),
                          ("fine", ["--levels", str(levels), "--sphere", SPHERE])):
        made, turned = (os.path.join(place.folder, name + end) for end in (".made.mesh", ".mesh"))
        must([*launcher(ranks), theirs, path, *options, "--write", made], place.folder)
        must([octetra, "convert", made, turned, "--fix-orientation", "--quiet"], place.folder)
    outcome = run([octetra, "verify", "coarse.mesh", "fine.mesh", "--sphere", SPHERE,
                   "--levels", str(levels)], place.folder)
    said = (outcome.out.strip() or outcome.err.strip() or "nothing").splitlines()
    return {"status": outcome.status, "verdict": said[-1]}


def valid_figures(lines):
    good = [all(line["status"] == 0 for line in of_run) for of_run in lines.values()]
    return [Figure("meshes of DOLFINx found valid, and refined as asked", sum(good),
                   f"of {len(good)}")]


def invalid(lines):
    return [f"DOLFINx, {name}: {line['verdict']}" for name, of_run in lines.items()
            for line in of_run if line["status"] != 0]


def valid(cubes, levels):
    mesh = (f"kuhn {cubes}", "valid-peers.mesh")

    def one(ranks):
        return Run("1 rank" if ranks == 1 else f"{ranks} ranks",
                   lambda place: judged(place, ranks, mesh, levels),
                   f"peer_dolfinx ({mesh[0]}) --levels {levels} --sphere {SPHERE} --write "
                   "fine.mesh; octetra verify coarse.mesh fine.mesh")
    return Case("what DOLFINx makes", [one(1), one(2)], valid_figures, wrong=invalid)
