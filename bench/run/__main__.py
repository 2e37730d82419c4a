#!/usr/bin/python3
"""Runs the benchmarks and writes their results: RESULTS.md, one table for each group, with targets
and whether they are met, and results.json for programs.

python3 bench/run --build build/release -o bench

Repetitions alternate between runs, so that a period of load does not affect a single one. Requires
only Python's standard library and mpirun. Exit status: 0 all ran; 1 a result is wrong (for example,
DOLFINx made different cells); 2 measurement failed. A missed target does not change the status,
because times depend on the machine.
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
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__.split("\n\n")[0],
                                     epilog="For the other benchmarks: ./dev bench --rival --help and "
                                            "./dev bench --paper --help.")
    parser.add_argument("--build", metavar="FOLDER", default="build/release")
    parser.add_argument("-o", "--output", metavar="FOLDER", default="bench")
    parser.add_argument("--quick", action="store_true",
                        help="small meshes, once each, to test that everything runs")
    parser.add_argument("--peers", action="store_true", help="also DOLFINx and PETSc, alternating with octetra")
    parser.add_argument("--only", metavar="CASE", nargs="+", default=[],
                        help="only cases whose name, or whose group, contains one of these")
    parser.add_argument("--repetitions", metavar="N", type=positive,
                        help="default: 5, with --quick 1")
    parser.add_argument("--list", action="store_true",
                        help="only list the cases that would be run")
    return parser.parse_args()


def tell(words):
    print(words, file=sys.stderr, flush=True)


def chosen(every, words):
    """The groups restricted to the requested cases, without empty groups."""
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
    """Yields all groups so far after each case."""
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
    """Writes the results after each case, so that a later failure loses none."""
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
