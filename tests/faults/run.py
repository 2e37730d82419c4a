#!/usr/bin/env python3
"""Runs commands in which something fails on one rank, and checks the outcome.

usage: run.py [--moments N] [--minutes M] [--seconds S] [--only TEXT] [--build FOLDER]

Each command is run repeatedly on three ranks. In each run one rank fails at another moment: it is killed
at an MPI call, a call that writes a file fails, or an allocation fails. Whatever the moment, all ranks must
end soon; the exit status must report the failure; the output must be the old file, byte by byte, or the
complete result; no other file may be left, except by a killed rank; one line must state the reason, except
for a killed rank. Prints a table. Exits with 1 if a violation occurs twice at the same moment: Open MPI
ends the other ranks in a race, whose outcome occasionally varies.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
RANKS = 3
BEFORE = b"what was there before\n"
SCRIPT = """refine --sphere 0,0,0,0.6 --levels 2
rebalance
coarsen --sphere 0,0,0,0.3
refine --box 0,0,0,0.4,0.4,0.4
"""

# Descriptions, with the arguments of the command and its outputs.
COMMANDS = {
    "refine a Medit text file": ("refine in.mesh --random 0.3 -o out.mesh", ["out.mesh"]),
    "refine TetGen files, cells moving": (
        "refine in.ele --sphere 0,0,0,0.4 --levels 2 --rebalance 0.02 -o out.ele", ["out.node", "out.ele", "out.face"]),
    "refine a binary Medit file": ("refine in.meshb --all -o out.meshb", ["out.meshb"]),
    "convert to Gmsh": ("convert in.meshb out.msh", ["out.msh"]),
    "refine into a .vtu": ("refine in.meshb --all -o out.vtu", ["out.vtu"]),
    "refine into a .vtkhdf": ("refine in.msh --all -o out.vtkhdf", ["out.vtkhdf"]),
    "refine into XDMF": ("refine in.meshb --all -o out.xdmf", ["out.xdmf", "out.h5"]),
    "adapt into a checkpoint": ("adapt in.mesh --script steps.txt -o out.octetra", ["out.octetra"]),
    "adapt with a series": ("adapt in.mesh --script steps.txt --series out.vtkhdf -o out.mesh",
                            ["out.vtkhdf", "out.mesh"]),
    "load a checkpoint and coarsen": ("coarsen in.octetra --all -o out.octetra", ["out.octetra"]),
    "load a checkpoint and refine": ("refine in.octetra --random 0.2 -o out.octetra", ["out.octetra"]),
    "verify a refinement": ("verify in.mesh fine.mesh", []),
}
STATUSES = {"killed": (137, 9), "file": (3,), "memory": (3,)}  # of mpirun; killed: Open MPI's, MPICH's
KINDS = {"killed": "killed at an MPI call", "file": "a file call fails", "memory": "an allocation fails"}


@dataclass
class Results:
    """The results for a command and a kind of fault."""
    calls: list = field(default_factory=list)  # calls that may fail, for each rank
    moments: int = 0
    succeeded: int = 0  # runs that succeeded in spite of the fault
    seconds: float = 0.0  # maximum until the last rank ended
    once: int = 0  # faults that did not recur
    faults: list = field(default_factory=list)


class Bench:
    """A folder of inputs, in which commands run."""

    def __init__(self, build, folder, seconds):
        self.program = build / "cli/octetra"
        self.libraries = {"killed": build / "tests/cli/libmpi_killer.so"}
        for kind in ("file", "memory"):
            self.libraries[kind] = build / "tests/faults/libfault_injector.so"
        self.inputs, self.folder, self.seconds = folder / "inputs", folder / "run", seconds
        self.inputs.mkdir()
        (self.inputs / "steps.txt").write_text(SCRIPT)
        self.prepare("generate kuhn 4 -o in.mesh")
        for name in ("in.ele", "in.meshb", "in.msh"):
            self.prepare(f"convert in.mesh {name}")
        self.prepare("adapt in.mesh --script steps.txt -o in.octetra")
        self.prepare("refine in.mesh --all -o fine.mesh")

    def prepare(self, arguments):
        subprocess.run([self.program, *arguments.split(), "--quiet"], cwd=self.inputs, check=True)

    def run(self, arguments, outputs, kind, rank, at):
        """Returns (status, stderr, seconds); the status is 124 if the command does not end."""
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.inputs, self.folder)
        for output in outputs:
            (self.folder / output).write_bytes(BEFORE)
        settings = {"LD_PRELOAD": self.libraries[kind]}
        if kind == "killed":
            settings |= {"OCTETRA_KILL_RANK": rank, "OCTETRA_KILL_AT": at}
        else:
            settings |= {"OCTETRA_FAULT_KIND": kind, "OCTETRA_FAULT_RANK": rank, "OCTETRA_FAULT_AT": at,
                         "OCTETRA_FAULT_FOLDER": self.folder}
        variables = [f"{name}={value}" for name, value in settings.items()]
        command = [ROOT / "tests/support/mpirun.sh", str(RANKS), "env", *variables, self.program, *arguments.split()]
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, errors="replace", start_new_session=True,
                                   env=os.environ | {"OCTETRA_SECONDS_TO_END": "1"})
        try:
            stderr_text = process.communicate(timeout=2 * self.seconds)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            return 124, process.communicate()[1], time.monotonic() - start
        return process.returncode, stderr_text, time.monotonic() - start

    def contents(self, outputs):
        return {output: (self.folder / output).read_bytes() if (self.folder / output).exists() else None
                for output in outputs}

    def unexpected_files(self, outputs):
        """Returns the files that are neither inputs nor outputs."""
        known = {path.name for path in self.inputs.iterdir()} | set(outputs)
        return sorted(path.name for path in self.folder.iterdir() if path.name not in known)


def fault_of(bench, outputs, complete, kind, status, stderr_text, seconds):
    """Describes a violation of the requirements, or returns an empty string."""
    if status == 124:
        return "does not end"
    if seconds > bench.seconds:
        return f"takes {seconds:.1f} s to end"
    found = bench.contents(outputs)
    if any(found[output] not in (BEFORE, complete[output]) for output in outputs):
        return "an output is neither the old file nor complete"
    if status == 0:
        return "" if found == complete else "exit status 0 without its outputs"
    if status not in STATUSES[kind]:
        return f"exit status {status}"
    if kind == "killed":
        return ""
    if bench.unexpected_files(outputs):
        return f"leaves {' '.join(bench.unexpected_files(outputs))}"
    messages = re.findall(r"^octetra: (?!note: ).*", stderr_text, re.MULTILINE)
    if len(messages) != 1:
        return f"prints {len(messages)} messages"
    return "" if kind != "memory" or "memory" in messages[0] else f"prints {messages[0]}"


def moments_of(calls, count):
    """At most `count` evenly spaced numbers from 1 to `calls`, including `calls`."""
    count = min(count, calls)
    return [round(calls * (k + 1) / count) for k in range(count)]


def run_moments(bench, arguments, outputs, kind, count):
    result = Results()
    for rank, share in ((0, count - count // 2), (RANKS - 1, count // 2)):
        status, stderr_text, _ = bench.run(arguments, outputs, kind, rank, 0)
        complete = bench.contents(outputs)
        calls = re.search(r"^calls(?: of MPI)?: (\d+)", stderr_text, re.MULTILINE)
        if status != 0 or not calls:
            sys.exit(f"without a fault: octetra {arguments}: exit status {status}\n{stderr_text}")
        result.calls.append(int(calls[1]))
        for at in moments_of(int(calls[1]), share):
            result.moments += 1
            for attempt in range(2):
                status, stderr_text, seconds = bench.run(arguments, outputs, kind, rank, at)
                fault = fault_of(bench, outputs, complete, kind, status, stderr_text, seconds)
                if not fault:
                    result.once += attempt
                    break
                words = f"octetra {arguments}: {KINDS[kind]}, rank {rank}, {at} of {calls[1]}: {fault}"
                print(words, "\n  " + stderr_text.strip().replace("\n", "\n  "), file=sys.stderr, flush=True)
            else:
                result.faults.append(words)
            result.succeeded += status == 0
            result.seconds = max(result.seconds, seconds)
    return result


def row(name, kind, result):
    calls = " and ".join(f"{calls:,}" for calls in result.calls)
    return (f"| {name} | {KINDS[kind]} | {calls} | {result.moments} | {result.succeeded} | "
            f"{result.seconds:.1f} | {result.once} | {len(result.faults)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--moments", type=int, default=100, help="number of moments for each command and kind of fault [100]")
    parser.add_argument("--minutes", type=float, default=30, help="start no further command after this time [30]")
    parser.add_argument("--seconds", type=float, default=10, help="maximum time until all ranks have ended [10]")
    parser.add_argument("--only", default="", metavar="TEXT", help="only commands whose description contains TEXT")
    chosen = parser.parse_args()
    if chosen.moments < 1:
        parser.error(f"--moments: not a positive number: {chosen.moments}")
    if not any(chosen.only in name for name in COMMANDS):
        parser.error(f"--only: no command contains {chosen.only!r}; the commands are: {'; '.join(COMMANDS)}")
    print("At each moment a call fails on one of three ranks, or the rank is killed. Succeeded: exit status 0, because "
          "the command\ndoes not depend on that call. Faults: ranks end in different ways or too late, or files are "
          "incomplete; once: not\nreproduced when repeated.\n")
    print("| command | fault | calls that may fail, on the first rank and the last | moments | succeeded | "
          "s until all ended, maximum | faults once | faults |\n|---|---|---:|---:|---:|---:|---:|---:|", flush=True)
    turns = [(name, kind) for name in COMMANDS if chosen.only in name for kind in KINDS]
    faults, moments, end = 0, 0, time.monotonic() + 60 * chosen.minutes
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(chosen.build.resolve(), pathlib.Path(folder), chosen.seconds)
        for name, kind in turns:
            if time.monotonic() > end:
                print(f"time is up before: {name}, {KINDS[kind]}; --only TEXT starts there")
                break
            result = run_moments(bench, *COMMANDS[name], kind, chosen.moments)
            faults += len(result.faults)
            moments += result.moments
            print(row(name, kind, result), flush=True)
    print(f"\n{moments:,} moments, {faults:,} faults" + ("" if faults else ": all ranks ended alike, and files are complete"))
    sys.exit(1 if faults else 0)


main()
