"""The section of the page that shows bench/results.json."""

import json
import os
from html import escape

import bench_plots as plots
from machine import ROOT, is_busy, known

RESULTS = os.path.join(ROOT, "bench", "results.json")

# The plots of the points of a case, and their captions.
DRAWN = {
    "with cells": [
        (plots.time_by_cells, "Uniform refinement on one rank, into memory that the process has "
         "not used before; dashed: proportional growth."),
        (plots.memory_by_cells, "Peak memory of that process; dashed: proportional growth."),
    ],
    "with cells, memory at hand": [
        (plots.time_by_cells, "The same in memory that the process has written before."),
    ],
    "with ranks": [
        (plots.time_by_ranks, "One mesh, a tenth of its cells marked, on increasing numbers of ranks, "
         "which share the cores: processor seconds, including waiting."),
        (plots.bytes_by_ranks, "Messages of that run: bytes sent by all ranks."),
    ],
    "around a point": [
        (plots.time_by_level, "Level by level around one point of a large mesh. The first "
         "processes every cell; later ones process only changes, unless an array must be reallocated."),
    ],
    "beside DOLFINx, uniform": [(plots.speeds, "Everything refined, beside DOLFINx.")],
    "beside DOLFINx, sphere": [(plots.speeds, "The third level in a sphere, compared with DOLFINx.")],
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
    """HTML; an empty string without measurements."""
    drawn = "".join(figures(results)) if results else ""
    if not drawn:
        return ""
    machine = results["machine"]
    loud = " Other programs ran at the same time, so times are unreliable."
    return ("<h2>Growth of cost</h2><p>Not measured with this report, but by "
            f"<code>./dev bench</code>: {escape(' · '.join(known(machine)))}."
            f"{loud if is_busy(machine) else ''}</p>"
            f'<div class="plots">{drawn}</div>')
