"""Compares steps through Python with steps in C++, alternating: overhead.py BUILD [RANKS...]

Prints a row for each kind of step on a lattice of 998,250 cells: `uniform` bisects all cells,
`medium` a thousand cells of each rank, `small` one. Figures are the minimum over the runs, in
milliseconds; the figure of a run with medium or small steps is the median without the first step,
which builds the data for later steps.
"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

build = pathlib.Path(sys.argv[1]).resolve()
source = pathlib.Path(__file__).resolve().parents[2]
environment = {**os.environ, "PYTHONPATH": str(build / "python")}
IN_CPP = [build / "bench/python/bench_python_steps"]
IN_PYTHON = ["/usr/bin/python3", source / "bench/python/steps.py"]


def seconds(ranks, *words):
    launch = [source / "tests/support/mpirun.sh", ranks] if ranks > 1 else []
    done = subprocess.run([str(word) for word in (*launch, *words)], env=environment, text=True,
                          stdout=subprocess.PIPE, check=True)
    steps = [float(line.split()[0]) for line in done.stdout.splitlines()]
    return statistics.median(steps[1:] or steps)


def row(ranks, mesh, kind, steps, runs):
    ways = {"C++": [*IN_CPP, mesh, kind, steps], "Python": [*IN_PYTHON, mesh, kind, steps],
            "arrays held": [*IN_PYTHON, mesh, kind, steps, "look"]}
    taken = {way: [] for way in ways}
    for _ in range(runs):
        for way, words in ways.items():
            taken[way].append(seconds(ranks, *words))
    figures = {way: min(of) * 1000 for way, of in taken.items()}
    more = {way: 100 * (figures[way] / figures["C++"] - 1) for way in ways}
    print(f"| {ranks} | {kind} | {figures['C++']:.3f} | {figures['Python']:.3f} | {more['Python']:+.1f} % "
          f"| {figures['arrays held']:.3f} | {more['arrays held']:+.1f} % |", flush=True)


print("| ranks | step | C++, ms | Python, ms | | arrays held, ms | |\n|---|---|---|---|---|---|---|")
with tempfile.TemporaryDirectory() as folder:
    large = pathlib.Path(folder) / "large.meshb"
    subprocess.run([str(build / "cli/octetra"), "generate", "kuhn", "55", "-o", str(large), "--quiet"],
                   check=True)
    for count in [int(word) for word in sys.argv[2:]] or [1, 2]:
        row(count, large, "uniform", 1, 12)
        row(count, large, "medium", 40, 12)
        row(count, large, "small", 40, 12)
