"""The engine alone, refining everything, a part, a small part, and cells at random."""

import statistics

from measuring import Case, Figure, driver, median, median_ratio, spread_figure

REFINE, LOCAL = "bench/bench_refine", "bench/bench_local"
RANKS = (1, 2, 4)
EVERYWHERE = "all cells chosen, 1 rank"


def on(ranks):
    return "1 rank" if ranks == 1 else f"{ranks} ranks"


def last(lines, key):
    return median(lines, "levels", -1, key)


# --- everywhere


def speeds(lines):
    cells = lines[on(1)][0]["levels"][-1]["cells"]
    made = []
    for ranks in RANKS:
        seconds = last(lines[on(ranks)], "seconds")
        made += [spread_figure(f"time, {on(ranks)}", "s", lines[on(ranks)],
                               "levels", -1, "seconds"),
                 Figure(f"cells of the result a second, {on(ranks)}", cells / seconds * 1e-6,
                        "million")]
    return made


def against_memcpy(lines, into):
    """Each repetition is related to its own copying, because the memory bandwidth of the machine
    varies."""
    return statistics.median(line["levels"][-1]["seconds"] / line["memcpy_seconds"][into]
                             for line in lines)


def uniform_figures(lines):
    one = lines[on(1)]
    cells = one[0]["levels"][-1]["cells"]
    return [
        Figure("cells of the result", cells, ""),
        *speeds(lines),
        Figure("peak memory for a cell of the result, 1 rank",
               median(one, "peak_bytes") / cells, "bytes", at_most=70),
        Figure("time against memcpy of input and output into new memory, 1 rank",
               against_memcpy(one, "new"), "times")]


def uniform(cubes):
    return Case("uniform, one level", [
        driver(on(ranks), REFINE, f"{cubes} 1 --json" + (" --memcpy" if ranks == 1 else ""), ranks)
        for ranks in RANKS], uniform_figures)


# Each with its own mesh: an upper bound for two ranks, whose deficit is due to the machine.
APART = "2 ranks apart"


def speed(lines, name, other):
    """The ratio of the speeds of two runs, in cells per second."""
    cells, other_cells = (lines[run][0]["levels"][-1]["cells"] for run in (name, other))
    return cells / other_cells * median_ratio(lines[other], lines[name], "levels", -1, "seconds")


def at_hand_figures(lines):
    return [
        *speeds(lines),
        Figure("speed on 2 ranks against 1", speed(lines, on(2), on(1)), "times", at_least=1.8),
        Figure("speed of 2 ranks with meshes of their own against 1",
               speed(lines, APART, on(1)), "times"),
        Figure("speed on 2 ranks against 2 with meshes of their own",
               speed(lines, on(2), APART), "times", at_least=0.9),
        Figure("speed on 4 ranks against 2", speed(lines, on(4), on(2)), "times", at_least=0.85),
        Figure("time against memcpy of input and output into used memory, 1 rank",
               against_memcpy(lines[on(1)], "used"), "times", at_most=8)]


def uniform_at_hand(cubes, cubes_apart, megabytes):
    """The same in memory that the process has written before."""
    def options(ranks):
        return f"--warm --memory-at-hand {megabytes // ranks} --json"
    return Case("the same, memory at hand", [
        *(driver(on(ranks), REFINE,
                 f"{cubes} 1 {options(ranks)}" + (" --memcpy" if ranks == 1 else ""), ranks)
          for ranks in RANKS),
        driver(APART, REFINE, f"{cubes_apart} 1 --apart {options(2)}", 2)],
        at_hand_figures, multiple=3)


# --- in a sphere


def sphere_figures(lines):
    made = []
    for level, figures in enumerate(lines[on(1)][0]["levels"]):
        made.append(Figure(f"cells after level {level + 1}", figures["cells"], ""))
        made += [Figure(f"level {level + 1}, {on(ranks)}",
                        1e3 * median(lines[on(ranks)], "levels", level, "seconds"), "ms")
                 for ranks in RANKS]
    per_cell, uniformly = per_new_cell(lines[on(1)]), per_new_cell(lines[EVERYWHERE])
    return made + [
        Figure("a new cell, 1 rank, processor", 1e9 * per_cell, "ns"),
        Figure("the same where all cells are chosen", 1e9 * uniformly, "ns"),
        Figure("a new cell against one where all are chosen", per_cell / uniformly, "times",
               at_most=3)]


def per_new_cell(lines):
    """Processor seconds over all levels."""
    levels = range(len(lines[0]["levels"]))
    used = sum(median(lines, "levels", level, "processor_seconds") for level in levels)
    return used / (lines[0]["levels"][-1]["cells"] - lines[0]["levels"][0]["before"])


def sphere(cubes):
    runs = [driver(on(ranks), REFINE, f"{cubes} 3 0.25 --json", ranks) for ranks in RANKS]
    return Case("sphere, three levels",
                [*runs, driver(EVERYWHERE, REFINE, f"{cubes} 2 --json")], sphere_figures)


# --- around a point


def shares(lines):
    """The time of each level relative to a uniform one: medians over the repetitions."""
    return [statistics.median(line["levels"][level]["processor_seconds"]
                              / line["uniform"]["processor_seconds"] for line in lines)
            for level in range(len(lines[0]["levels"]))]


def point_figures(lines):
    of_level = shares(lines["1 rank"])
    return [Figure("level 1, of a uniform level's time", 100 * of_level[0], "%"),
            Figure("levels 2 and later, the median one", 100 * statistics.median(of_level[1:]),
                   "%"),
            Figure("levels 2 and later, the most", 100 * max(of_level[1:]), "%", at_most=2)]


def point_curve(lines):
    lines = lines["1 rank"]
    return [{"level": i + 1, "cells": level["cells"],
             "processor_seconds": median(lines, "levels", i, "processor_seconds")}
            for i, level in enumerate(lines[0]["levels"])]


def around_a_point(cubes, levels, chosen):
    return Case("around a point", [driver("1 rank", LOCAL, f"{cubes} {levels} {chosen} --json")],
                point_figures, point_curve)


# --- cells at random


def random_cells_figures(lines):
    made = []
    for name, of_run in lines.items():
        levels = of_run[0]["levels"]
        made += [Figure(f"{name}: cells of the result", levels[-1]["cells"], ""),
                 Figure(f"{name}: rounds", levels[-1]["rounds"], ""),
                 Figure(f"{name}: time", 1e3 * last(of_run, "seconds"), "ms"),
                 Figure(f"{name}: share of synchronisation",
                        100 * statistics.median(map(share, of_run)), "%", at_most=15)]
    return made


def share(line):
    """The fraction of the time of all phases that ranks spent communicating or waiting."""
    profile = line["profile"]
    return profile["synchronising_seconds"] / (profile["computing_seconds"]
                                               + profile["communicating_seconds"])


def random_cells(points):
    mesh = (f"random {points} --seed 1", "delaunay.mesh")
    return Case("random Delaunay mesh, random cells, 2 ranks", [
        driver(f"{100 * chosen:g} %", REFINE,
               f"1 --random {chosen} --partition lepp --profile --json", 2, mesh)
        for chosen in (0.001, 0.01, 0.05, 0.2)], random_cells_figures)
