"""Runs programs and says what came of it."""

import os
import subprocess
import time
from dataclasses import dataclass

TIMEOUT = 600  # seconds; a run that hangs is a failure, not a wait for ever

# What mpirun asks for as root and for more ranks than cores; and in many containers the kernel does
# not let one process copy from another's memory.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}


class Failure(Exception):
    """The report cannot be made, for this reason."""


@dataclass(frozen=True)
class Outcome:
    status: int  # of the process; 124 if it was ended for taking too long
    out: str
    err: str
    seconds: float  # by the wall clock, start of processes included


def run(command, folder, timeout=TIMEOUT):
    """Runs `command` in `folder` until it ends. Raises Failure if there is no such program."""
    begin = time.monotonic()
    try:
        done = subprocess.run(command, cwd=folder, env={**os.environ, **MPI_ENVIRONMENT},
                              capture_output=True, text=True, errors="replace", timeout=timeout,
                              stdin=subprocess.DEVNULL, check=False)
    except subprocess.TimeoutExpired:
        return Outcome(124, "", f"ended after {timeout} s", time.monotonic() - begin)
    except OSError as error:
        raise Failure(f"{command[0]} cannot be run: {error.strerror}") from error
    return Outcome(done.returncode, done.stdout, done.stderr, time.monotonic() - begin)


def must(command, folder):
    """Runs a command that the report cannot do without; returns what it printed."""
    outcome = run(command, folder)
    if outcome.status != 0:
        raise Failure(f"'{' '.join(map(str, command))}' ended with status {outcome.status}:\n"
                      f"{outcome.err.strip()}")
    return outcome.out


def own_message(outcome):
    """The line in which octetra says why it failed, without what mpirun adds; empty if none."""
    for line in outcome.err.splitlines():
        if line.startswith("octetra: ") and not line.startswith("octetra: note: "):
            return line
    return ""
