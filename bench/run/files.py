"""Files, and the whole program."""

import json
import os
import shutil
import statistics

from measuring import Case, Figure, Run, driver, launcher, median
from refinement import on
from running import must, run

FILES = "bench/bench_files"


def rate(line):
    """MB (10^6 bytes) of the file per second, by the wall clock."""
    (benchmark,) = line["benchmarks"]
    return benchmark["file MB"] / (benchmark["real_time"] * 1e-3)


def rates(lines):
    return [Figure(f"{name} TetGen files", statistics.median(map(rate, of_run)),
                   "MB/s", at_least=200) for name, of_run in lines.items()]


def tetgen():
    """Google Benchmark chooses the number of repetitions within a run."""
    return Case("TetGen files", [
        driver(name, FILES, f"--benchmark_filter={name}_file/tetgen --benchmark_format=json")
        for name in ("read", "write")], rates)


# --- octetra refine


def whole_program(place, ranks, shape):
    mesh = place.mesh(shape, "whole.ele")
    folder = os.path.join(place.folder, "whole")
    os.mkdir(folder)
    try:
        command = [*launcher(ranks), place.program("cli/octetra"), "refine", mesh, "--all", "--quiet",
                   "-o", os.path.join(folder, "fine.ele")]
        # The program is timed as users run it, without a profile. Both runs write to new files,
        # because replacing an old file costs as much again.
        seconds = timed(command, folder)
        for file in os.listdir(folder):
            os.remove(os.path.join(folder, file))
        must([*command, "--profile", os.path.join(folder, "profile.json")], folder)
        with open(os.path.join(folder, "profile.json"), encoding="utf-8") as file:
            profile = json.load(file)
    finally:
        shutil.rmtree(folder)
    return {"seconds": seconds, "profiled_seconds": profile["seconds"]["max"],
            "files_seconds": sum(of_phase(profile, name) for name in ("read", "write")),
            "cells": profile["levels"][-1]["cells"]["sum"],
            "peak_bytes": profile["peak_memory_bytes"]["max"]}


def in_a_corner(cubes, levels):
    """Memory of each rank when a mesh is refined at one place."""
    shape = f"kuhn {cubes}"
    arguments = f"--sphere 0.2,0.2,0.2,0.1 --levels {levels}"

    def line(place, ranks):
        mesh = place.mesh(shape, "corner.mesh")
        profile = os.path.join(place.folder, "corner.json")
        must([*launcher(ranks), place.program("cli/octetra"), "refine", mesh, *arguments.split(),
              "--quiet", "-o", "corner-fine.mesh", "--profile", profile], place.folder)
        with open(profile, encoding="utf-8") as file:
            found = json.load(file)
        return {"cells": found["levels"][-1]["cells"],
                "peak_bytes": found["peak_memory_bytes"]["max"]}
    return Case("a sphere in a corner", [
        Run(on(ranks), lambda place, ranks=ranks: line(place, ranks),
            f"mpirun -n {ranks} octetra refine ({shape}) {arguments} -o corner-fine.mesh")
        for ranks in (1, 2, 4)], corner_figures)


def corner_figures(lines):
    made = [Figure("cells of the result", lines[on(1)][0]["cells"]["sum"], "")]
    for name, of_run in lines.items():
        cells = of_run[0]["cells"]
        if name != on(1):
            made.append(Figure(f"cells of the rank that has most against the mean, {name}",
                               cells["max"] / cells["mean"], "times", at_most=1.25))
        made.append(Figure(f"peak memory of a rank, {name}", 1e-6 * median(of_run, "peak_bytes"),
                           "MB"))
    return made


def timed(command, folder):
    outcome = run(command, folder)
    if outcome.status != 0:
        must(command, folder)  # reports errors
    return outcome.seconds


def of_phase(profile, name):
    """The time of the slowest rank, including waiting, by the wall clock."""
    parts = ("computing_seconds", "communicating_seconds")
    of_rank = [[sum(seconds) for seconds in zip(*(entry[part]["of_rank"] for part in parts))]
               for entry in profile["phases"] if entry["phase"] == name]
    return max(map(sum, zip(*of_rank)))


def program_figures(lines):
    made = []
    for name, of_run in lines.items():
        against = statistics.median(line["profiled_seconds"] / line["files_seconds"]
                                    for line in of_run)
        peak = median(of_run, "peak_bytes")
        made += [Figure(f"octetra refine, {name}", median(of_run, "seconds"), "s"),
                 Figure(f"peak memory of a rank, {name}", 1e-6 * peak, "MB"),
                 Figure(f"against its reading and writing alone, {name}", against, "times",
                        at_most=3)]
    return made


def program(cubes):
    shape = f"kuhn {cubes}"

    def one(ranks):
        words = f"mpirun -n {ranks} " if ranks > 1 else ""
        return Run(on(ranks),
                   lambda place: whole_program(place, ranks, shape),
                   f"{words}octetra refine ({shape}) --all -o fine.ele")
    return Case("the whole program", [one(ranks) for ranks in (1, 2)], program_figures)
