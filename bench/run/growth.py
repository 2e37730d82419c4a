"""Growth of the cost with cells and with ranks."""

from measuring import Case, Figure, driver, median
from refinement import REFINE, on
from slopes import slope, steepest


def cells_curve(lines):
    return [{"cells": of_run[0]["levels"][0]["cells"],
             "processor_seconds": median(of_run, "levels", 0, "processor_seconds"),
             "peak_bytes": median(of_run, "peak_bytes")} for of_run in lines.values()]


def slope_figures(curve, key, words, at_most=None):
    cells, values = [point["cells"] for point in curve], [point[key] for point in curve]
    return [Figure(f"{words}: slope of the log-log fit", slope(cells, values), "",
                   at_most=at_most),
            Figure(f"{words}: steepest slope between neighbours", steepest(cells, values), "")]


def new_memory_figures(lines):
    curve = [point | {"copying": median(of_run, "memcpy_seconds", "new")}
             for point, of_run in zip(cells_curve(lines), lines.values(), strict=True)]
    return [Figure("cells of the results, least", curve[0]["cells"], ""),
            Figure("cells of the results, most", curve[-1]["cells"], ""),
            *slope_figures(curve, "peak_bytes", "peak memory", at_most=1.05),
            *slope_figures(curve, "processor_seconds", "processor time, memory new", at_most=1.05),
            *slope_figures(curve, "copying", "memcpy of input and output, memory new")]


def with_cells(sizes):
    return Case("with cells", [driver(f"{n}^3 cubes", REFINE, f"{n} 1 --warm --memcpy --json")
                               for n in sizes], new_memory_figures, cells_curve)


def megabytes_for(cubes):
    """More memory than the run with this number of cubes a side uses at any time."""
    return 64 + 48 * cubes ** 3 * 64 // 1000000


def at_hand_figures(lines):
    return slope_figures(cells_curve(lines), "processor_seconds", "processor time", at_most=1.05)


def with_cells_at_hand(sizes):
    return Case("with cells, memory at hand", [
        driver(f"{n}^3 cubes", REFINE, f"{n} 1 --warm --memory-at-hand {megabytes_for(n)} --json")
        for n in sizes], at_hand_figures, cells_curve)


def ranks_curve(lines):
    return [{"ranks": of_run[0]["ranks"],
             "processor_seconds_of_rank":
                 median(of_run, "levels", 0, "processor_seconds") / of_run[0]["ranks"],
             "bytes": of_run[0]["profile"]["bytes"],
             "messages": of_run[0]["profile"]["messages"],
             "rounds": of_run[0]["levels"][0]["rounds"]} for of_run in lines.values()]


def ranks_figures(lines):
    made = []
    for point in ranks_curve(lines):
        name = on(point["ranks"])
        of_rank = 1e3 * point["processor_seconds_of_rank"]
        made += [Figure(f"{name}: processor, of a rank", of_rank, "ms"),
                 Figure(f"{name}: processor, all ranks", of_rank * point["ranks"], "ms"),
                 Figure(f"{name}: bytes sent, all ranks", point["bytes"], "bytes")]
    return made


def with_ranks(cubes, ranks):
    return Case("with ranks", [
        driver(on(number), REFINE, f"{cubes} 1 --random 0.1 --partition lepp --profile --json",
               number) for number in ranks], ranks_figures, ranks_curve)
