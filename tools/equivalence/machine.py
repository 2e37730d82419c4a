"""Time, machine and program of a measurement."""

import datetime
import os
import platform
import re
import subprocess
import time

from words import plural, size

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def first_match(path, pattern):
    try:
        with open(path, encoding="utf-8") as file:
            found = re.search(pattern, file.read(), re.MULTILINE)
    except OSError:
        return None
    return found.group(1) if found else None


def first_line(command):
    """The first line of a command's output; None if it fails or does not exist."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return None
    lines = done.stdout.splitlines()
    return lines[0] if done.returncode == 0 and lines else None


def processor_times():
    """Busy and total time of all cores together since the system was started. None without /proc."""
    line = first_match("/proc/stat", r"^cpu +(.*)$")
    if line is None:
        return None
    # user, nice, system, idle, waiting for disks, interrupts; guests are contained in the first
    # two.
    times = [int(time) for time in line.split()[:8]]
    return sum(times) - times[3] - times[4], sum(times)


def busy_cores(seconds=0.5):
    """The average number of cores that other programs use during the next moment. (The system's
    load average covers the last minute, which may include the build.)"""
    before = processor_times()
    if before is None:
        return os.getloadavg()[0]
    time.sleep(seconds)
    work, together = (now - then for now, then in zip(processor_times(), before))
    return os.cpu_count() * work / max(together, 1)


def describe(octetra):
    """The present state of the machine; None for unknown values. `load` is the number of cores used
    by others before the first run."""
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
        "load": busy_cores(),
    }


def known(machine):
    """The known values in words: date, commit, machine, compiler."""
    told = [machine["date"], f"commit {machine['commit']}" if machine["commit"] else None,
            plural(machine["cores"], "core") + " of " + machine["processor"],
            size(machine["memory_bytes"]) + " of memory" if machine.get("memory_bytes") else None,
            machine.get("system"), machine.get("compiler"),
            f"{machine['build']} build" if machine.get("build") else None, machine["mpi"]]
    return [words for words in told if words]


def is_busy(machine):
    """Returns whether other programs used so many cores that times are unreliable."""
    return machine["load"] >= 0.5 * machine["cores"]
