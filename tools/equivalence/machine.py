"""Where and when it was measured, and what."""

import datetime
import os
import platform
import re
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def first_match(path, pattern):
    try:
        with open(path, encoding="utf-8") as file:
            found = re.search(pattern, file.read(), re.MULTILINE)
    except OSError:
        return None
    return found.group(1) if found else None


def first_line(command):
    """What a command prints first; None where it fails or is not there."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return None
    lines = done.stdout.splitlines()
    return lines[0] if done.returncode == 0 and lines else None


def describe(octetra):
    """The machine as it is now. What is not known is None. `load` is how many processes wanted a
    core in the last minute, before anything was run here."""
    memory = first_match("/proc/meminfo", r"^MemTotal: +(\d+) kB")
    return {
        "processor": first_match("/proc/cpuinfo", r"^model name\s*: (.*)$") or platform.machine(),
        "cores": len(os.sched_getaffinity(0)),
        "memory_bytes": int(memory) * 1024 if memory else None,
        "system": first_match("/etc/os-release", r'^PRETTY_NAME="(.*)"$') or platform.system(),
        "mpi": first_line(["mpirun", "--version"]),
        "octetra": first_line([octetra, "--version"]),
        "commit": first_line(["git", "-C", ROOT, "describe", "--always", "--dirty", "--abbrev=12"]),
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        "load": os.getloadavg()[0],
    }
