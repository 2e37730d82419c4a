"""Runs octetra, and extracts figures from profiles."""
import json
import pathlib
import re
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Octetra:
    def __init__(self, build, folder):
        self.program, self.bench = build / "cli/octetra", build / "bench/bench_refine"
        self.folder = pathlib.Path(folder)

    def run(self, *words, ranks=1, program=None):
        start = [] if ranks == 1 else [ROOT / "tests/support/mpirun.sh", str(ranks)]
        done = subprocess.run([*start, program or self.program, *map(str, words)], check=True, cwd=self.folder,
                              stdout=subprocess.PIPE, text=True)
        return done.stdout

    def generate(self, shape, name):
        self.run("generate", *shape.split(), "-o", name, "--quiet")
        return self.counts(name)

    def counts(self, name):
        found = json.loads(self.run("info", name, "--json"))
        return {"cells": found["counts"]["cells"], "vertices": found["counts"]["vertices"]}

    def refine(self, name, out, criteria, ranks=1, **options):
        """Refines, and returns the profile."""
        words = [word for key, value in options.items() for word in (f"--{key}", value)]
        self.run("refine", name, "-o", out, *criteria.split(), *words, "--profile", "profile.json", "--quiet",
                 ranks=ranks)
        return json.loads((self.folder / "profile.json").read_text())

    def timed_level(self, name, share, ranks):
        """Runs one level of the engine alone, after distribution. Returns its cells and seconds.
        Memory is already allocated, as in a program that refines repeatedly."""
        criteria = [] if share == 1 else ["--random", share]
        line = self.run(name, 1, *criteria, "--warm", "--memory-at-hand", 200, "--json", ranks=ranks,
                        program=self.bench)
        return json.loads(line)["levels"][0]

    def partition(self, name, parts, method):
        """Returns the fractions of cut faces and links, the mean number of shared vertices, and the
        ratio of the maximum to the mean number of cells."""
        lines = self.run("partition", name, "-n", parts, "--partition", method)

        def last(words, place=-1):
            return next(line for line in lines.splitlines() if line.startswith(words)).split()[place]
        return {"faces": float(last("cut faces", -2)), "links": float(last("cut links", -2)),
                "vertices": float(last("vertices shared", -3).replace(",", "")), "balance": float(last("cells "))}


def told(profile):
    """Returns rounds, messages and bytes of synchronisation, summed over all levels; bytes also of
    the busiest rank."""
    phases = [phase for phase in profile["phases"] if phase["phase"] == "synchronise"]
    busiest = [sum(of_ranks) for of_ranks in zip(*(phase["bytes"]["of_rank"] for phase in phases))]
    return {"rounds": sum(phase["rounds"]["max"] for phase in phases),
            "messages": sum(phase["messages"]["sum"] for phase in phases),
            "bytes": sum(phase["bytes"]["sum"] for phase in phases), "most_bytes": max(busiest)}


def rounds_of_levels(profile):
    return [phase["rounds"]["max"] for phase in profile["phases"] if phase["phase"] == "synchronise"]


def median(values):
    return statistics.median(values)
