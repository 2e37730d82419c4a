"""The section of the page that shows bench/results.json."""

import json
import os
from html import escape

import bench_plots as plots
from machine import ROOT, is_busy, known

RESULTS = os.path.join(ROOT, "bench", "results.json")

# What is drawn of the points of a case, and what is said of it.
DRAWN = {
    "with cells": [
        (plots.time_by_cells, "Uniform refinement on one rank, into memory that the system has "
         "yet to hand out; dashed: what would grow in proportion."),
        (plots.memory_by_cells, "The most memory of that process, the dashed line likewise."),
    ],
    "with cells, memory at hand": [
        (plots.time_by_cells, "The same in memory that the process has written to before."),
    ],
    "with ranks": [
        (plots.time_by_ranks, "One mesh, a tenth of its cells chosen, on more and more ranks, "
         "which take turns on the cores: seconds of the processor, waiting included."),
        (plots.bytes_by_ranks, "Messages of that run: bytes that all ranks send together."),
    ],
    "around a point": [
        (plots.time_by_level, "Level by level around one point of a large mesh. The first "
         "looks at every cell; later ones at what changes, unless an array has to move to grow."),
    ],
    "beside DOLFINx, uniform": [(plots.speeds, "Everything refined, beside DOLFINx.")],
    "beside DOLFINx, sphere": [(plots.speeds, "The third level in a sphere, beside DOLFINx.")],
}


def load(path=RESULTS):
    """The results of the benchmarks, or None if there are none."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return None


def figures(results):
    points = {case["name"]: case["points"] for group in results["groups"]
              for case in group["cases"]}
    for name, drawings in DRAWN.items():
        for draw, caption in drawings if points.get(name) else []:
            yield (f"<figure>{draw(points[name])}<figcaption>{escape(caption)}</figcaption>"
                   "</figure>")


def section(results):
    """HTML; nothing where nothing was measured."""
    drawn = "".join(figures(results)) if results else ""
    if not drawn:
        return ""
    machine = results["machine"]
    loud = " Other programs ran at the same time, so seconds are no measure."
    return ("<h2>How cost grows</h2><p>Not measured with this report, but by "
            f"<code>./dev bench</code>: {escape(' · '.join(known(machine)))}."
            f"{loud if is_busy(machine) else ''}</p>"
            f'<div class="plots">{drawn}</div>')
