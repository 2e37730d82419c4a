#!/usr/bin/python3
"""Counts the instructions of a case with callgrind and compares them with the recorded count, or
records them. Exit status: 0 at most MARGIN more; 1 more than that; 77 no comparison is possible,
for the printed reason."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

MARGIN = 10  # per cent
SKIPPED = 77
HOW_TO_RECORD = "cmake --build build/release --target record_instructions"
HEAD = """\
# Instructions of the cases of counted_cases.cpp, as counted by callgrind, and the compiler of the
# program: counts of other compilers are not compared. Recorded by
#     {how}
# Explain in the commit message why the counts have changed.
"""


def read(path):
    """Returns the compiler of the program, and the counts by case; None and {} if there is no file."""
    built_by, counts = None, {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            for line in file:
                key, _, value = line.strip().partition(" ")
                if key == "built-by":
                    built_by = value
                elif key and key != "#":
                    counts[key] = int(value)
    return built_by, counts


def write(path, built_by, counts):
    with open(path, "w", encoding="utf-8") as file:
        file.write(HEAD.format(how=HOW_TO_RECORD) + f"built-by {built_by}\n")
        for case, number in counts.items():
            file.write(f"{case} {number}\n")


def count(program, case):
    """Instructions within counted(), which the program calls once."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["valgrind", "--tool=callgrind", "--collect-atstart=no",
                               "--toggle-collect=octetra::counted(*",
                               f"--callgrind-out-file={folder}/out", program, case],
                              capture_output=True, text=True, check=False)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not found or int(found[1]) == 0:
        sys.exit(f"{case} could not be counted:\n{done.stderr}")
    return int(found[1])


def verdict(case, now, before):
    """Returns the message about a count, and the exit status."""
    change = 100 * (now - before) / before
    words = f"{case}: {now:,} instructions, recorded {before:,}: {change:+.1f} %"
    if change > MARGIN:
        return (f"{words}. At most {MARGIN} % more are allowed. If the increase is justified:\n"
                f"    {HOW_TO_RECORD}\nand commit tests/instructions/recorded.txt with the reason.", 1)
    if change < -MARGIN:
        return f"dev note: {words}. To record it: {HOW_TO_RECORD}", 0
    return words, 0


def check(options, case):
    built_by, counts = read(options.recorded)
    if shutil.which("valgrind") is None:
        return "not counted: valgrind is not installed", SKIPPED
    if built_by != options.built_by:
        return (f"not compared: the recorded counts are of '{built_by}', and this program is built by "
                f"'{options.built_by}'"), SKIPPED
    if case not in counts:
        return f"{case} is not recorded. To do so: {HOW_TO_RECORD}", 1
    return verdict(case, count(options.program, case), counts[case])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--built-by", required=True)
    parser.add_argument("--recorded", metavar="FILE", required=True)
    parser.add_argument("--check", metavar="CASE")
    parser.add_argument("--record", metavar="CASE", nargs="+")
    options = parser.parse_args()
    if options.record:
        write(options.recorded, options.built_by,
              {case: count(options.program, case) for case in options.record})
        return 0
    words, status = check(options, options.check)
    print(words)
    return status


if __name__ == "__main__":
    sys.exit(main())
