"""Where and when it was measured, and what."""

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
    """What a command prints first; None where it fails or is not there."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return None
    lines = done.stdout.splitlines()
    return lines[0] if done.returncode == 0 and lines else None


def processor_times():
    """Of all cores together since the system began: at work, and in all. None where /proc is not."""
    line = first_match("/proc/stat", r"^cpu +(.*)$")
    if line is None:
        return None
    # user, nice, system, idle, waiting for disks, interrupts; guests are in the first two.
    times = [int(time) for time in line.split()[:8]]
    return sum(times) - times[3] - times[4], sum(times)


def busy_cores(seconds=0.5):
    """How many cores other programs keep busy, on average from now on for a moment. (The load that
    the system tells is that of the last minute, in which this may have been built.)"""
    before = processor_times()
    if before is None:
        return os.getloadavg()[0]
    time.sleep(seconds)
    work, together = (now - then for now, then in zip(processor_times(), before))
    return os.cpu_count() * work / max(together, 1)


def describe(octetra):
    """The machine as it is now. What is not known is None. `load` is how many cores others keep
    busy, before anything is run here."""
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
    """What is known of it, in words: when, which commit, where, built by what."""
    told = [machine["date"], f"commit {machine['commit']}" if machine["commit"] else None,
            plural(machine["cores"], "core") + " of " + machine["processor"],
            size(machine["memory_bytes"]) + " of memory" if machine.get("memory_bytes") else None,
            machine.get("system"), machine.get("compiler"),
            f"{machine['build']} build" if machine.get("build") else None, machine["mpi"]]
    return [words for words in told if words]


def is_busy(machine):
    """Did other programs keep so many cores busy that seconds are no measure?"""
    return machine["load"] >= 0.5 * machine["cores"]
