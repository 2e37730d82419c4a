#!/usr/bin/python3
"""Refines many meshes by the serial reference and on 1 to 4 ranks, compares the bytes, verifies the
results, and writes a report: index.html, equivalence.json and equivalence.md.

python3 tools/equivalence --octetra build/release/cli/octetra -o equivalence

Requires only Python's standard library and mpirun; pictures of meshes require python3-vtk9 and
xvfb. Exit status: 0 all results are identical and valid; 1 some are not; 2 the report could not be
made.
"""

import argparse
import json
import os
import shutil
import sys
import tempfile
import time

import bench_section
import cases as all_cases
import loops as all_loops
import machine
import pictures
from markdown import markdown
from measure import Place, measure
from page import answer, page
from running import Failure
from summary import totals


def parse_command_line():
    parser = argparse.ArgumentParser(prog="./dev equivalence", description=__doc__.split("\n\n")[0])
    parser.add_argument("--octetra", metavar="PROGRAM", default="octetra", help="[octetra, in the PATH; with ./dev: its build]")
    parser.add_argument("-o", "--output", metavar="FOLDER", default="equivalence", help="[equivalence; with ./dev and --quick or --only: equivalence/part]")
    parser.add_argument("--quick", action="store_true", help="a few small cases and a loop, every run once")
    parser.add_argument("--only", metavar="WORDS", help="only cases whose name contains this, and "
                        "those on which they depend")
    parser.add_argument("--list", action="store_true", help="run nothing; list the cases")
    parser.add_argument("--no-pictures", action="store_true", help="omit pictures of meshes")
    parser.add_argument("--bench", metavar="FILE.json", default=bench_section.RESULTS,
                        help="results of ./dev bench, which are plotted if the file exists")
    parser.add_argument("--from", dest="old", metavar="FILE.json", help="run nothing; generate the "
                        "pages of an older report again, in its folder")
    return parser.parse_args()


def chosen_cases(options):
    if options.only is None:
        return all_cases.quick() if options.quick else all_cases.standard()
    cases = all_cases.quick() if options.quick else [*all_cases.in_full(), *all_cases.corpus()]
    wanted = [case for case in cases if options.only in case.name]
    names = {case.name for case in wanted}
    for case in reversed(cases):  # a case follows the one that it continues
        if case.name in names and case.after:
            names.add(case.after)
    if not names and not chosen_loops(options):
        raise Failure(f"no case has '{options.only}' in its name")
    return [case for case in cases if case.name in names]


def chosen_loops(options):
    loops = all_loops.quick() if options.quick else all_loops.standard()
    return [loop for loop in loops if options.only is None or options.only in loop.name]


def folder_name(case):
    return "".join(c if c.isalnum() else "-" for c in case.name)


def tell(words):
    print(words, file=sys.stderr, flush=True)


def in_short(measured):
    if not measured["identical"]:
        return "NOT IDENTICAL"
    if measured["verdict"] is None:
        return "refused by all"
    return "identical, valid" if measured["valid"] else "identical, NOT VALID"


def measure_all(cases, octetra, work, output, with_pictures):
    """The cases and pictures of the report, in the order given."""
    measured, drawn, places = [], [], {}
    for number, case in enumerate(cases, start=1):
        begin = time.monotonic()
        place = Place(octetra, os.path.join(work, folder_name(case)), dict(places))
        os.mkdir(place.folder)
        measured.append(measure(case, place))
        if with_pictures and case.view:
            name = folder_name(case) + ".png"
            missing = pictures.draw(case, place, os.path.join(output, name))
            drawn.append({"case": case.name, "file": name, "missing": missing})
        tell(f"[{number}/{len(cases)}] {case.name}: {in_short(measured[-1])} "
             f"({time.monotonic() - begin:.1f} s)")
        places[case.name] = place.folder
        if not any(later.after == case.name for later in cases[number:]):
            shutil.rmtree(place.folder)
    return measured, drawn


def measure_loops(loops, octetra, work):
    measured = []
    for number, loop in enumerate(loops, start=1):
        begin = time.monotonic()
        place = Place(octetra, os.path.join(work, folder_name(loop)), {})
        os.mkdir(place.folder)
        measured.append(all_loops.measure_loop(loop, place))
        shutil.rmtree(place.folder)
        good = measured[-1]["identical"] and measured[-1]["valid"]
        tell(f"[loop {number}/{len(loops)}] {loop.name}: {'identical, valid' if good else 'NOT AS IT SHOULD BE'} "
             f"({time.monotonic() - begin:.1f} s)")
    return measured


def make_report(options):
    octetra = shutil.which(options.octetra)
    if octetra is None:
        raise Failure(f"{options.octetra}: no such program; --octetra says where it is")
    octetra, output = os.path.abspath(octetra), os.path.abspath(options.output)
    cases = chosen_cases(options)
    where = machine.describe(octetra)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="equivalence-", dir=output) as work:
        measured, drawn = measure_all(cases, octetra, work, output, not options.no_pictures)
        loops = measure_loops(chosen_loops(options), octetra, work)
    return {"format": "octetra equivalence", "version": 1, "machine": where,
            "seconds": time.monotonic() - begin, "cases": measured, "loops": loops, "pictures": drawn}


def write(path, words):
    with open(path, "w", encoding="utf-8") as file:
        file.write(words)


def main():
    options = parse_command_line()
    try:
        if options.list:
            print("\n".join(each.name for each in [*chosen_cases(options), *chosen_loops(options)]))
            return 0
        os.makedirs(options.output, exist_ok=True)
        if options.old:
            with open(options.old, encoding="utf-8") as file:
                report = json.load(file)
        else:
            report = make_report(options)
            write(os.path.join(options.output, "equivalence.json"),
                  json.dumps(report, indent=1) + "\n")
        write(os.path.join(options.output, "index.html"),
              page(report, options.output, bench_section.load(options.bench)))
        write(os.path.join(options.output, "equivalence.md"), markdown(report))
    except (Failure, OSError) as failure:
        tell(f"equivalence: {failure}")
        return 2
    total = totals(report)
    print(answer(total)[1])
    return 0 if total["good"] else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
