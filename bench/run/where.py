"""Time, machine, program and compiler of the measurement."""

import glob
import os
import subprocess

import machine
from machine import ROOT, first_match

# Files that a run of the benchmarks changes itself.
OWN = (":!bench/results.json", ":!bench/RESULTS.md")


def commit():
    """The commit, with a remark if the checkout differs from it; None outside git."""
    name = machine.first_line(["git", "-C", ROOT, "rev-parse", "--short=12", "HEAD"])
    if name is None:
        return None
    changes = subprocess.run(["git", "-C", ROOT, "status", "--porcelain", "--", ".", *OWN],
                             capture_output=True, text=True, check=False)
    return name + (" and changes" if changes.stdout else "")


def compiler(build):
    """The compiler found by CMake, such as "GNU 12.2.0"; None if unknown."""
    for path in glob.glob(os.path.join(build, "CMakeFiles", "*", "CMakeCXXCompiler.cmake")):
        parts = [first_match(path, rf'^set\(CMAKE_CXX_COMPILER_{part} "(.*)"\)$')
                 for part in ("ID", "VERSION")]
        if all(parts):
            return " ".join(parts)
    return None


def describe(build):
    found = machine.describe(os.path.join(build, "cli", "octetra"))
    build_type = first_match(os.path.join(build, "CMakeCache.txt"), r"^CMAKE_BUILD_TYPE:\w+=(.*)$")
    return {**found, "commit": commit(), "compiler": compiler(build), "build": build_type}
