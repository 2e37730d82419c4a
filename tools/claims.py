#!/usr/bin/env python3
"""The table of claims: tests/claims.txt, and docs/claims.md, which is made of it.

  tools/claims.py --write              make docs/claims.md anew
  tools/claims.py --check-page         fail if docs/claims.md is not what --write would make
  tools/claims.py --check-names BUILD  fail if a claim names a test that the build folder does not
                                       have; status 77 if not all of its programs are built
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
source = root / "tests/claims.txt"
page = root / "docs/claims.md"
NOT_ALL_BUILT = 77


def read_claims():
    """[(heading, [(claim, [test, ...]), ...]), ...]"""
    sections = []
    for number, line in enumerate(source.read_text().splitlines(), 1):
        if not line.strip() or line.startswith(";"):
            continue
        if line.startswith("# "):
            sections.append((line[2:], []))
        elif not line.startswith(" "):
            if not sections:
                sys.exit(f"{source}:{number}: a claim before the first heading")
            sections[-1][1].append((line, []))
        elif sections and sections[-1][1]:
            sections[-1][1][-1][1].append(line.strip())
        else:
            sys.exit(f"{source}:{number}: a test before the first claim")
    for _, claims in sections:
        for claim, tests in claims:
            if not tests:
                sys.exit(f"{source}: no test shows that {claim}")
    return sections


# ---- the page --------------------------------------------------------------------------------------


def page_of(sections):
    lines = ["# Claims and tests", "",
             "What Octetra promises, and the tests that fail if it is not so. Made by "
             "`tools/claims.py --write` of", "`tests/claims.txt`; do not edit. "
             "[TESTING.md](../TESTING.md) says how to run a test; `grep -rn CASE tests/` finds one by",
             "the last part of its name. Cases of programs that run under mpirun have no test of their own:",
             "`tests/support/mpirun.sh 3 build/release/tests/distributed/test_equality",
             "--gtest_filter='*LatticeFullOfTies*'` runs one of them on 3 ranks."]
    for heading, claims in sections:
        lines += ["", f"## {heading}", "", "| claim | tests |", "|---|---|"]
        lines += [f"| {claim} | {', '.join(f'`{test}`' for test in tests)} |"
                  for claim, tests in claims]
    return "\n".join(lines) + "\n"


# ---- the tests that there are ------------------------------------------------------------------------


def plain(name):
    """Without what a parameter adds: reference.Seeds/Closure.IsMinimal/0 is
    reference.Closure.IsMinimal."""
    return re.sub(r"^(\w+\.)(?:\w+/)?(\w+\.\w+)(?:/.*)?$", r"\1\2", name)


def listed_by(program):
    """Suite.Case of each case that a test program runs, with its filter if it has one."""
    done = subprocess.run([*program, "--gtest_list_tests"], capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        sys.exit(f"{' '.join(program)} --gtest_list_tests: status {done.returncode}\n{done.stderr}")
    suite = ""
    for line in done.stdout.splitlines():
        name = line.split("#")[0].rstrip()
        if re.fullmatch(r"[\w/]+\.", name):
            suite = name
        elif suite and re.fullmatch(r"  \S+", name):
            yield suite + name.strip()


def tests_of(build):
    """The names of all tests, and the programs that are not built."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"],
                           capture_output=True, text=True, check=True).stdout
    names, missing, programs = set(), set(), set()
    for test in json.loads(shown)["tests"]:
        name, command = test["name"], test.get("command", [])
        if name.endswith("_NOT_BUILT"):
            missing.add(name.removesuffix("_NOT_BUILT").removeprefix("test_"))
            continue
        names.add(plain(name))
        names.add(re.sub(r"\.\d+_ranks$", "", name))
        if any(argument.startswith("--gtest_filter=") for argument in command) and len(command) == 3:
            programs.add((name.split(".")[0], command[0]))  # a suite of a program of GoogleTest
        if command and command[0].endswith("/mpirun.sh"):  # MPIRUN RANKS [-x VARIABLE] PROGRAM ARGUMENTS...
            program = command[2:]
            while program[0] == "-x":
                program = program[2:]
            if pathlib.Path(program[0]).exists():
                programs.add((name.split(".")[0], command[0], "1", *program))
            else:
                missing.add(name.split(".")[1])
    for folder, *program in sorted(programs):
        names |= {plain(f"{folder}.{case}") for case in listed_by(program)}
    return names, missing


def check_names(sections, build):
    names, missing = tests_of(build)
    unknown = [(test, claim) for _, claims in sections for claim, tests in claims
               for test in tests if test not in names]
    if missing:
        print(f"not built, so names cannot be told: {', '.join(sorted(missing))}")
        return NOT_ALL_BUILT
    for test, claim in unknown:
        print(f"{source.relative_to(root)}: there is no test {test}, which is to show: {claim}")
    return 1 if unknown else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    action = parser.add_mutually_exclusive_group(required=True)
    action.add_argument("--write", action="store_true")
    action.add_argument("--check-page", action="store_true")
    action.add_argument("--check-names", metavar="BUILD")
    arguments = parser.parse_args()
    sections = read_claims()
    if arguments.write:
        page.write_text(page_of(sections))
    elif arguments.check_page:
        if not page.exists() or page.read_text() != page_of(sections):
            sys.exit(f"{page.relative_to(root)} is out of date: run tools/claims.py --write")
    else:
        sys.exit(check_names(sections, arguments.check_names))


if __name__ == "__main__":
    main()
