"""Runs programs and returns their outcomes."""

import os
import pathlib
import subprocess
import time
from dataclasses import dataclass

TIMEOUT = 600  # seconds; a run that takes longer has failed
TOO_LONG = 124  # the status of such a run

SETTINGS = pathlib.Path(__file__).resolve().parent.parent / "mpi.env"


def mpi_environment():
    """The settings of mpirun for runs on one machine, by name."""
    lines = (line.strip() for line in SETTINGS.read_text().splitlines())
    return dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))


MPI_ENVIRONMENT = mpi_environment()


class Failure(Exception):
    """The report cannot be made, for the given reason."""


@dataclass(frozen=True)
class Outcome:
    status: int  # of the process; TOO_LONG if it exceeded TIMEOUT
    out: str
    err: str
    seconds: float  # by the wall clock, including the start of processes


def run(command, folder, timeout=TIMEOUT):
    """Runs `command` in `folder` until it ends. Raises Failure if there is no such program."""
    begin = time.monotonic()
    try:
        process = subprocess.Popen(command, cwd=folder, env={**os.environ, **MPI_ENVIRONMENT},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, errors="replace")
    except OSError as error:
        raise Failure(f"{command[0]} cannot be run: {error.strerror}") from error
    with process:
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            end(process)
            return Outcome(TOO_LONG, "", f"ended after {timeout} s", time.monotonic() - begin)
    return Outcome(process.returncode, out, err, time.monotonic() - begin)


def end(process):
    """mpirun ends its ranks on SIGTERM; on SIGKILL it may leave them running."""
    process.terminate()
    try:
        process.communicate(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()


def must(command, folder):
    """Runs a command that the report requires; returns its output."""
    return printed(command, run(command, folder))


def printed(command, outcome):
    """Returns the output; raises Failure if the command failed."""
    if outcome.status != 0:
        raise Failure(f"'{' '.join(map(str, command))}' ended with status {outcome.status}:\n"
                      f"{outcome.err.strip()}")
    return outcome.out


def own_message(outcome):
    """The error message of octetra, without the output of mpirun; empty if there is none."""
    for line in outcome.err.splitlines():
        if line.startswith("octetra: ") and not line.startswith("octetra: note: "):
            return line
    return ""
