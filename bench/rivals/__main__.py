"""Compares terminal-edge bisection with 8T-LE on the same meshes and goals.

./dev bench --rival         measures, into bench/rivals/measured.json and docs/rival.md
python3 bench/rivals page   generates docs/rival.md from the measurements
python3 bench/rivals check  exits with 1 if the page is not up to date

Every run is a separate process that prints a line of JSON (bench/rivals_bench.cpp). Repetitions
alternate between methods, so that a period of load does not affect a single one; times are medians
of processor seconds.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path += [str(HERE.parent), str(ROOT / "tools/equivalence")]

import prose  # noqa: E402
from machine import describe, known  # noqa: E402
from rivals.figures import SECONDS, added, figures_of, milliseconds, refining_nanoseconds  # noqa: E402

MEASURED = HERE / "measured.json"
METHODS = ("terminal", "8t", "4t", "2t")
MESHES = {"kuhn": (["kuhn", "16"], "0.5,0.5,0.5,0.2"),
          "random": (["random", "4000", "--seed", "1"], "0.5,0.5,0.5,0.2"),
          "gear": (["gear", "--edge", "0.08"], "0.8,0,0.1,0.2")}
QUICK = {"kuhn": (["kuhn", "4"], "0.5,0.5,0.5,0.3"), "random": (["random", "200", "--seed", "1"], "0.5,0.5,0.5,0.3")}
# task, halvings, only in the sphere
GOALS = (("edge", 1, False), ("edge", 2, False), ("edge", 2, True), ("edge", 3, True),
         ("once", 1, True), ("volume", 1, True), ("volume", 3, True))
# A: until no edge is longer than half of the longest; B: until every cell of a region is cut; C:
# many levels.
ON_RANKS = (("edge", 1, False), ("once", 1, True), ("volume", 2, True))
RANKS = (2, 4)

# Huge pages for all allocations, as the engine of octetra requests itself.
ENVIRONMENT = os.environ | {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}


def printed(command):
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=ENVIRONMENT)
    return json.loads(done.stdout)


def command_of(program, mesh, goal, sphere, method):
    task, halvings, local = goal
    where = ["--sphere", sphere] if local else []
    return [program, mesh, "--method", method, "--task", task, "--halvings", str(halvings), *where]


def medians(runs):
    """Medians of seconds; all other figures are the same in every run."""
    first = dict(runs[0])
    for key in SECONDS:
        first[key] = statistics.median(run[key] for run in runs)
    to_target = [sum(run[key] for key in SECONDS) for run in runs]
    first["most_over_median"] = max(to_target) / statistics.median(to_target)
    return first


def measured_goal(program, mesh, goal, sphere, repetitions):
    runs = {method: [] for method in METHODS}
    for _ in range(repetitions):
        for method in METHODS:
            runs[method].append(printed(command_of(program, mesh, goal, sphere, method)))
    return {method: medians(list_of) for method, list_of in runs.items()}


def on_ranks(program, mesh, goal, sphere, ranks):
    """Returns the communication of each method on this number of ranks, with its number of cells,
    which must not depend on the ranks."""
    made = {method: printed([ROOT / "tests/support/mpirun.sh", str(ranks),
                             *command_of(program, mesh, goal, sphere, method)]) for method in METHODS}
    return {method: {key: run[key] for key in ("rounds", "messages", "bytes", "cells")}
            for method, run in made.items()}


def check_cells(cases, of_ranks):
    """Checks that the mesh of each method is independent of the number of ranks."""
    alone = {(case["mesh"], tuple(case["goal"]), method): run["cells"]
             for case in cases for method, run in case["methods"].items()}
    for case in of_ranks:
        for method, run in case["methods"].items():
            if run["cells"] != alone.get((case["mesh"], tuple(case["goal"]), method), run["cells"]):
                sys.exit(f"rivals: {name_of(case)}, {method}: {run['cells']} cells on {case['ranks']} ranks")


def lines_of(made):
    """JSON, one case per line."""
    def one_a_line(cases):
        return "[" + ",\n  ".join(json.dumps(case) for case in cases) + "]"
    return (f'{{"repetitions": {made["repetitions"]}, "machine": {json.dumps(made["machine"])},\n'
            f' "cases": {one_a_line(made["cases"])},\n'
            f' "ranks": {one_a_line(made["ranks"])}}}\n')


def measure(build, repetitions, quick, only):
    program, octetra = build / "bench/bench_rivals", build / "cli/octetra"
    old = json.loads(MEASURED.read_text()) if only else {}
    machine = describe(str(octetra))
    if only == "ranks":
        repetitions, machine = old["repetitions"], old["machine"]  # for the seconds that are kept
    cases, of_ranks = [], []
    with tempfile.TemporaryDirectory() as folder:
        for name, (shape, sphere) in (QUICK if quick else MESHES).items():
            mesh = f"{folder}/{name}.meshb"
            subprocess.run([octetra, "generate", *shape, "-o", mesh, "--quiet"], check=True)
            for goal in GOALS if only != "ranks" else ():
                made = measured_goal(program, mesh, goal, sphere, repetitions)
                cases.append({"mesh": name, "goal": goal, "methods": made})
                print(name, *goal, file=sys.stderr)
            for goal in ON_RANKS if only != "cases" else ():
                for ranks in RANKS:
                    of_ranks.append({"mesh": name, "goal": goal, "ranks": ranks,
                                     "methods": on_ranks(program, mesh, goal, sphere, ranks)})
    cases, of_ranks = cases or old["cases"], of_ranks or old["ranks"]
    check_cells(cases, of_ranks)
    return {"repetitions": repetitions, "machine": machine, "cases": cases, "ranks": of_ranks}


def name_of(case):
    task, halvings, local = case["goal"]
    size = {"edge": f"edges / {2 ** halvings}", "once": "each cut once", "volume": f"volumes / {8 ** halvings}"}
    return f"{case['mesh']}, {size[task]}{', region' if local else ''}"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|---|" + "---:|" * (len(heads) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def beside(case, figure, form):
    """A figure of terminal-edge bisection, and those of the other methods as multiples of it."""
    methods = case["methods"]
    own = figure(methods["terminal"])
    others = [f"{figure(methods[m]) / own:.2f}" if own else f"{figure(methods[m]):,}" for m in METHODS[1:]]
    return [form(own), *others]


def cells_table(cases):
    rows = []
    for case in cases:
        methods = case["methods"]
        own = methods["terminal"]
        outside = []
        if case["goal"][2]:
            outside = [f"{methods[m]['cells_added_outside']:,}" for m in METHODS]
        rows.append([name_of(case), f"{own['input_cells']:,}", f"{own['targets']:,}",
                     *beside(case, added, lambda n: f"{n:,}"),
                     *(outside or [""] * 4)])
    return table(["mesh, goal", "cells", "targets", "added: terminal", "8t", "4t", "2t",
                  "outside: terminal", "8t", "4t", "2t"], rows)


def seconds_table(cases):
    rows = []
    for case in cases:
        methods = case["methods"]
        rows.append([name_of(case), f"{methods['terminal']['rounds']}",
                     *(f"{methods[m]['levels']}" for m in METHODS[1:]),
                     *(f"{refining_nanoseconds(methods[m]):,.0f}" for m in METHODS),
                     *(f"{milliseconds(methods[m]):,.1f}" for m in METHODS)])
    return table(["mesh, goal", "rounds", "levels: 8t", "4t", "2t", "ns a cell: terminal", "8t", "4t", "2t",
                  "ms to goal: terminal", "8t", "4t", "2t"], rows)


def shapes_table(cases):
    rows = []
    for case in cases:
        made = {method: run["shapes"] for method, run in case["methods"].items()}
        for name, shapes in {"(targets)": case["methods"]["terminal"]["shapes_of_targets"], **made}.items():
            rows.append([name_of(case) if name == "(targets)" else "", name,
                         *(f"{a:.1f}" for a in shapes["least_dihedral"]),
                         *(f"{a:.1f}" for a in shapes["greatest_dihedral"]),
                         *(f"{r:.2f}" for r in shapes["edge_ratio"])])
    return table(["mesh, goal", "method", "least dihedral: least", "1 %", "10 %", "50 %", "greatest: 50 %", "90 %",
                  "99 %", "most", "edge ratio: 50 %", "90 %", "99 %", "most"], rows)


def ranks_table(cases):
    rows = []
    for case in cases:
        methods = case["methods"]
        rows.append([name_of(case), str(case["ranks"]),
                     *(f"{methods[m]['rounds']}" for m in METHODS),
                     *(f"{methods[m]['messages']:,}" for m in METHODS),
                     *(f"{methods[m]['bytes'] / 1000:,.1f}" for m in METHODS)])
    return table(["mesh, goal", "ranks", "exchanges: terminal", "8t", "4t", "2t", "messages: terminal", "8t", "4t", "2t",
                  "kB: terminal", "8t", "4t", "2t"], rows)


def when_and_where(measured):
    """With the dispersion of repeated runs: nine in ten took at most this multiple of the median."""
    apart = sorted(run["most_over_median"] for case in measured["cases"] for run in case["methods"].values())
    machine = measured["machine"]
    return (f"{', '.join(known(machine))}; other programs kept {machine['load']:.1f} cores busy when it began. "
            f"Processor time on one core, medians of {measured['repetitions']} runs in turns; the slowest of them "
            f"took at most {apart[len(apart) * 9 // 10]:.2f} times the median in nine of ten cases, and {apart[-1]:.2f} times in "
            "the worst")


def page_text():
    measured = json.loads(MEASURED.read_text())
    cases = measured["cases"]
    shaped = [case for case in cases if tuple(case["goal"]) == ("volume", 3, True) and case["mesh"] != "kuhn"]
    try:
        text = (HERE / "page.md").read_text().replace("{measured}", when_and_where(measured))
        text = prose.told(text, lambda query: figures_of(measured, query))
    except prose.NotTrue as why:
        sys.exit(f"bench/rivals/page.md, {why}")
    for word, made in {"{cells}": cells_table(cases), "{seconds}": seconds_table(cases),
                       "{shapes}": shapes_table(shaped), "{ranks}": ranks_table(measured["ranks"])}.items():
        text = text.replace(word, made)
    return text


def main():
    parser = argparse.ArgumentParser(usage="./dev bench --rival [--quick] [--repetitions N] [--only cases|ranks] [--list]",
                                     description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["measure", "page", "check"],
                        help="default: measure, like ./dev bench --rival")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", metavar="FOLDER",
                        help="build folder [build/release]")
    parser.add_argument("--repetitions", type=int, default=5, metavar="N", help="runs of each case, whose medians are used [5]")
    parser.add_argument("--quick", action="store_true", help="small meshes, once each; results are only printed")
    parser.add_argument("--only", choices=["cases", "ranks"], help="measure one process, or ranks, and keep the other results")
    parser.add_argument("--list", action="store_true", help="only list what would be measured")
    chosen = parser.parse_args()
    page = ROOT / "docs/rival.md"
    if chosen.list:
        print("\n".join(name_of({"mesh": mesh, "goal": goal}) for mesh in MESHES for goal in GOALS))
        return 0
    if chosen.what == "check":
        return 0 if page.read_text() == page_text() else 1
    if chosen.what == "measure":
        made = measure(chosen.build, 1 if chosen.quick else chosen.repetitions, chosen.quick, chosen.only)
        if chosen.quick:
            print(cells_table(made["cases"]), ranks_table(made["ranks"]), sep="\n\n")
            return 0
        MEASURED.write_text(lines_of(made))
        print(ranks_table(made["ranks"]))
    page.write_text(page_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
