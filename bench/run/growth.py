"""How cost grows with cells and with ranks."""

from measuring import Case, Figure, driver, median
from refinement import REFINE, on
from slopes import slope, steepest


def cells_curve(lines):
    return [{"cells": of_run[0]["levels"][0]["cells"],
             "processor_seconds": median(of_run, "levels", 0, "processor_seconds"),
             "peak_bytes": median(of_run, "peak_bytes")} for of_run in lines.values()]


def cells_figures(lines):
    curve = cells_curve(lines)
    cells = [point["cells"] for point in curve]
    made = [Figure("cells of the results, least", cells[0], ""),
            Figure("cells of the results, most", cells[-1], "")]
    for key, words in (("processor_seconds", "processor time"), ("peak_bytes", "peak memory")):
        values = [point[key] for point in curve]
        made += [Figure(f"{words}: slope of the log-log fit", slope(cells, values), "",
                        at_most=1.05),
                 Figure(f"{words}: steepest slope between neighbours", steepest(cells, values), "")]
    return made


def with_cells(sizes):
    return Case("with cells", [driver(f"{n}^3 cubes", REFINE, f"{n} 1 --warm --json")
                               for n in sizes], cells_figures, cells_curve)


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
        made += [Figure(f"{name}: processor of a rank",
                        1e3 * point["processor_seconds_of_rank"], "ms"),
                 Figure(f"{name}: bytes sent, all ranks", point["bytes"], "bytes")]
    return made


def with_ranks(cubes, ranks):
    return Case("with ranks", [
        driver(on(number), REFINE, f"{cubes} 1 --random 0.1 --partition lepp --profile --json",
               number) for number in ranks], ranks_figures, ranks_curve)
