#!/usr/bin/python3
"""Runs the benchmarks and writes what they measured: RESULTS.md, one table for each group, with
targets and whether they are met, and results.json, the same for programs.

    python3 bench/run --build build/release -o bench

Repetitions are made in turns, so that a busy moment of the machine does not meet one run alone.
Needs Python's standard library alone, and mpirun. Status 0: all ran; 1: a result is not right (what
DOLFINx made has other cells, say); 2: it could not be measured. A target that is missed changes no
status: seconds depend on the machine.
"""

import argparse
import json
import os
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "tools", "equivalence"))  # running, machine, words

# pylint: disable=wrong-import-position
import groups  # noqa: E402
import kept  # noqa: E402
import where  # noqa: E402
from measuring import Place, measure  # noqa: E402
from results import results  # noqa: E402
from running import Failure  # noqa: E402


def positive(word):
    if int(word) < 1:
        raise argparse.ArgumentTypeError("one or more")
    return int(word)


def parse_command_line():
    parser = argparse.ArgumentParser(prog="bench", description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", metavar="FOLDER", default="build/release")
    parser.add_argument("-o", "--output", metavar="FOLDER", default="bench")
    parser.add_argument("--quick", action="store_true",
                        help="small meshes, once each: to see that all runs")
    parser.add_argument("--peers", action="store_true", help="DOLFINx and PETSc, too, in turns with octetra")
    parser.add_argument("--only", metavar="CASE", nargs="+", default=[],
                        help="only cases with one of these in the name of them or their group")
    parser.add_argument("--repetitions", metavar="N", type=positive,
                        help="5 unless told, with --quick 1")
    parser.add_argument("--list", action="store_true",
                        help="only name the cases that would be run")
    return parser.parse_args()


def tell(words):
    print(words, file=sys.stderr, flush=True)


def chosen(every, words):
    """The groups with the cases that were asked for, without those of which none was."""
    if not words:
        return every
    picked = []
    for group in every:
        cases = [case for case in group.cases
                 if any(word in f"{group.name} {case.name}" for word in words)]
        if cases:
            picked.append(group.of(cases))
    if not picked:
        raise Failure(f"no case has {' or '.join(words)} in its name; there are\n"
                      + listed(every))
    return picked


def listed(every):
    return "\n".join(f"  {group.name}: {case.name}" for group in every for case in group.cases)


def chosen_groups(options):
    every = groups.quick(options.peers) if options.quick else groups.standard(options.peers)
    return chosen(every, options.only)


def measured_groups(options, place):
    """All groups so far, after each case anew."""
    repetitions = options.repetitions or (1 if options.quick else 5)
    groups_so_far = []
    for group in chosen_groups(options):
        groups_so_far.append({"name": group.name, "about": group.about,
                              "repetitions": repetitions, "cases": []})
        for case in group.cases:
            begin = time.monotonic()
            groups_so_far[-1]["cases"].append(measure(case, place, repetitions))
            tell(f"{group.name}, {case.name}: {time.monotonic() - begin:.0f} s")
            yield groups_so_far


def make_results(options):
    """Writes them after each case, so that what fails later takes nothing with it."""
    machine = where.describe(os.path.abspath(options.build))
    begin = time.monotonic()
    old = kept.load(os.path.join(options.output, "results.json"))
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        for measured in measured_groups(options, Place(os.path.abspath(options.build), folder)):
            made = {"format": "octetra bench", "version": 2, "quick": options.quick,
                    "machine": machine, "seconds": time.monotonic() - begin, "groups": measured}
            made = kept.with_old(made, old, groups.NAMES)
            write(options.output, "results.json", json.dumps(made, indent=1) + "\n")
            write(options.output, "RESULTS.md", results(made))
    return made


def write(folder, name, words):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(words)


def main():
    options = parse_command_line()
    try:
        if options.list:
            print(listed(chosen_groups(options)))
            return 0
        os.makedirs(options.output, exist_ok=True)
        made = make_results(options)
    except (Failure, OSError) as failure:
        tell(f"bench: {failure}")
        return 2
    wrong = [f"{case['name']}: {line}" for group in made["groups"] for case in group["cases"]
             for line in case["wrong"]]
    for line in wrong:
        tell(f"bench: {line}")
    return 1 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
