#!/usr/bin/env python3
"""Deliberate faults of the sources, and whether the tests detect them.

The faults are defined in the .toml files beside this one, each by a [[mutant]] with
  name   the fault; it selects the mutant on the command line
  file   the file of the checkout in which
  old    occurs exactly once and is replaced by
  new    (a line end at the beginning of either is removed)
  tests  the test programs that may detect it, fastest first: NAME runs test_NAME, NAME@3 runs it on
         3 ranks, NAME@3:FILTER runs only the cases selected by FILTER.

./dev campaign mutants applies one mutant after the other to a copy of the checkout, build/mutants/tree,
rebuilds what has changed and runs these programs. A program detects a mutant if it fails, or takes longer
than three times its time without a fault plus two minutes. A mutant that no program detects has survived:
a test is missing.
"""

import argparse
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import threading
import time
import tomllib

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
tree = root / "build/mutants/tree"
build = root / "build/mutants/build"
seconds_without_fault = 900


def die(message):
    sys.exit(f"mutants: {message}")


# ---- the list --------------------------------------------------------------------------------------


def read_mutants():
    mutants = []
    for path in sorted(here.glob("*.toml")):
        mutants += tomllib.loads(path.read_text())["mutant"]
    return mutants


def mutated(mutant, folder):
    """Returns the content of the file with the fault. Ends the program unless the fault fits
    exactly once."""
    path = folder / mutant["file"]
    if not path.exists():
        die(f"{mutant['name']}: there is no file {mutant['file']}")
    content = path.read_text()
    found = content.count(mutant["old"])
    if found != 1:
        die(f"{mutant['name']}: the text to be replaced occurs {found} times in {mutant['file']}, not once")
    if mutant["new"] == mutant["old"]:
        die(f"{mutant['name']}: changes nothing")
    return content.replace(mutant["old"], mutant["new"])


def program_of(test):
    return re.split("[@:]", test)[0]


def check(mutants):
    programs = set()
    for path in (root / "tests").glob("*/CMakeLists.txt"):
        programs |= set(re.findall(r"^(?:octetra_(?:mpi_)?test\(|add_executable\(test_)(\w+)",
                                   path.read_text(), re.MULTILINE))
    names = [mutant["name"] for mutant in mutants]
    for name in names:
        if names.count(name) > 1:
            die(f"two mutants are named {name}")
    for mutant in mutants:
        mutated(mutant, root)
        for test in mutant["tests"]:
            if program_of(test) not in programs:
                die(f"{mutant['name']}: there is no test program {test}")
    print(f"{len(mutants)} mutants fit the sources")


# ---- the copy --------------------------------------------------------------------------------------


def copy_tree():
    """Copies changed files, so that what was built from the others remains."""
    left_out = shutil.ignore_patterns(".git", "build", "demo", "__pycache__")
    kept = set()
    for folder, folders, files in os.walk(root):
        ignored = left_out(folder, folders + files)
        folders[:] = [name for name in folders if name not in ignored]
        for name in files:
            source = pathlib.Path(folder) / name
            if name in ignored or source.is_symlink():
                continue
            target = tree / source.relative_to(root)
            kept.add(target)
            write_if_other(target, source.read_bytes())
            shutil.copymode(source, target)
    for folder, _, files in os.walk(tree):
        for name in files:
            if pathlib.Path(folder) / name not in kept:
                (pathlib.Path(folder) / name).unlink()


def write_if_other(path, content):
    if path.exists() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def configure():
    cache = build / "CMakeCache.txt"
    if cache.exists() and f"CMAKE_HOME_DIRECTORY:INTERNAL={tree}\n" not in cache.read_text():
        shutil.rmtree(build)  # configured for a checkout in another folder
    # A fault may leave a name unused, which must not stop the build.
    command = ["cmake", "--preset", "release", "-S", tree, "-B", build, "-DOCTETRA_TESTS=ON",
               "-DOCTETRA_TEST_TIER=nightly", "-DOCTETRA_BENCH=OFF", "-DOCTETRA_WARNINGS_AS_ERRORS=OFF"]
    done = subprocess.run(command, cwd=tree, stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        die("the copy cannot be configured")


def build_programs(tests, jobs):
    """Returns an error message, or nothing."""
    targets = sorted({"test_" + program_of(test) for test in tests})
    command = ["cmake", "--build", build, "--parallel", str(jobs), "--target", *targets]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode != 0 else ""


# ---- running tests ---------------------------------------------------------------------------------


def failure_of(test, seconds):
    """Returns the first failure of a test program, at which the program is ended, or nothing."""
    program_and_ranks, _, cases = test.partition(":")
    name, _, ranks = program_and_ranks.partition("@")
    (program,) = (path for path in build.glob(f"tests/*/test_{name}") if path.is_file())
    command = [program, "--gtest_brief=1", "--gtest_color=no"]
    if cases:
        command += [f"--gtest_filter={cases}"]
    if ranks:
        command = [tree / "tests/support/mpirun.sh", ranks, *command]
    environment = os.environ | {"RC_PARAMS": "seed=1"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", env=environment)
    late = threading.Event()

    def stop():
        late.set()
        process.terminate()  # mpirun then ends its ranks

    timer = threading.Timer(seconds, stop)
    timer.start()
    failed = ""
    for line in process.stdout:
        found = re.search(r"\[  FAILED  \] (\S+?),? ", line)
        if found:
            failed = found[1]
            break
    timer.cancel()
    process.terminate()
    try:
        status = process.wait(timeout=20)
    except subprocess.TimeoutExpired:
        process.kill()
        status = process.wait()
    if failed:
        return f"{test}: {failed}"
    if late.is_set():
        return f"{test}: does not end"
    return f"{test}: exit status {status}" if status != 0 else ""


def fate_of(mutant, seconds_of, jobs):
    """Returns ("caught", the test), ("survived", "") or ("does not compile", the first error)."""
    path = tree / mutant["file"]
    original = path.read_bytes()
    path.write_text(mutated(mutant, tree))
    try:
        for test in mutant["tests"]:
            wrong = build_programs([test], jobs)
            if wrong:
                errors = [line for line in wrong.splitlines() if "error:" in line]
                return "does not compile", errors[0] if errors else wrong[-200:]
            failure = failure_of(test, 120 + 3 * seconds_of[test])
            if failure:
                return "caught", failure
        return "survived", ""
    finally:
        path.write_bytes(original)


def run(mutants, minutes, jobs):
    end = time.monotonic() + 60 * minutes
    copy_tree()
    configure()
    every_test = sorted({test for mutant in mutants for test in mutant["tests"]})
    print(f"building and running {', '.join(every_test)} without faults", flush=True)
    wrong = build_programs(every_test, jobs)
    if wrong:
        die("the copy does not compile\n" + wrong)
    seconds_of = {}
    for test in every_test:
        begin = time.monotonic()
        failure = failure_of(test, seconds_without_fault)
        if failure:
            die(f"fails without faults: {failure}")
        seconds_of[test] = time.monotonic() - begin
    bad = 0
    for done, mutant in enumerate(mutants):
        if time.monotonic() > end:
            print(f"\ntime is up after {done} of {len(mutants)} mutants; to continue: "
                  f"./dev campaign mutants --from {mutant['name']}, with the same --shuffle")
            break
        begin = time.monotonic()
        fate, how = fate_of(mutant, seconds_of, jobs)
        bad += fate != "caught"
        print(f"{fate:<9}{time.monotonic() - begin:5.0f} s  {mutant['name']:<50}  {how}", flush=True)
    return bad


def positive(text):
    number = float(text)
    if not number > 0:
        raise argparse.ArgumentTypeError(f"takes a number greater than 0, not {text}")
    return number


def main():
    parser = argparse.ArgumentParser(prog="./dev campaign mutants")
    parser.add_argument("--check", action="store_true", help="only check that the mutants fit the sources")
    parser.add_argument("--minutes", type=positive, default=30, help="start no further mutant after this time")
    parser.add_argument("--shuffle", type=int, metavar="SEED",
                        help="in a random order, so that limited time tries a random sample")
    parser.add_argument("--from", dest="first", metavar="NAME", help="start with this mutant")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help=argparse.SUPPRESS)
    parser.add_argument("names", metavar="NAME", nargs="*", help="only these mutants; default: all")
    arguments = parser.parse_args()

    mutants = read_mutants()
    check(mutants)
    if arguments.check:
        return
    known = [mutant["name"] for mutant in mutants]
    if arguments.first and arguments.names:
        parser.error("--from and names exclude each other")
    for name in arguments.names + ([arguments.first] if arguments.first else []):
        if name not in known:
            print(f"mutants: there is no mutant {name}", file=sys.stderr)
            sys.exit(2)
    if arguments.names:
        mutants = [mutant for mutant in mutants if mutant["name"] in arguments.names]
    if arguments.shuffle is not None:
        random.Random(arguments.shuffle).shuffle(mutants)
    if arguments.first:
        mutants = mutants[[mutant["name"] for mutant in mutants].index(arguments.first):]
    bad = run(mutants, arguments.minutes, arguments.jobs)
    if bad:
        die(f"{bad} not caught")


main()
