"""Runs one case: by the serial reference, then on 1 to 4 ranks with both synchronisations; compares
the bytes, verifies the result of the reference, and collects the figures."""

import json
import os
import shutil
import statistics
from dataclasses import dataclass

import comparing
from running import Failure, must, own_message, run

RANKS = (1, 2, 3, 4)

NOT_REFINING = {"read", "partition", "distribute", "number vertices", "write", "rest"}


@dataclass(frozen=True)
class Place:
    """The environment of a case."""
    octetra: str  # the program
    folder: str  # of this case
    others: dict  # folders of the previous cases, by name


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def coarse_mesh(case, place):
    """The file of the mesh that the case refines."""
    if case.file:
        return case.file
    if case.after:
        return os.path.join(place.others[case.after], "reference", "refined.ele")
    path = os.path.join(place.folder, "coarse.ele")
    must([place.octetra, "generate", *case.generate.split(), "--quiet", "-o", path], place.folder)
    return path


def refine(case, mesh, place, into, launcher, options):
    """Refines once, into the new folder `into`. Returns the outcome and, if there is one, the
    profile."""
    folder = os.path.join(place.folder, into)
    profile = os.path.join(place.folder, "profile.json")
    for old in (folder, profile):
        remove(old)
    os.mkdir(folder)
    outcome = run([*launcher, place.octetra, "refine", mesh, *case.refine.split(), "--quiet",
                   *options, "--maps", "maps.txt", "--profile", profile, "-o", case.output], folder)
    return outcome, load(profile) if outcome.status == 0 and os.path.exists(profile) else None


def remove(path):
    if os.path.isdir(path):
        shutil.rmtree(path)
    elif os.path.exists(path):
        os.remove(path)


# --- figures of a profile


def phases_of(profile):
    """Seconds of each phase, summed over all levels and averaged over ranks, in the order of the
    run."""
    phases = {}
    for entry in profile["phases"]:
        sums = phases.setdefault(entry["phase"], {"computing": 0.0, "communicating": 0.0})
        sums["computing"] += entry["computing_seconds"]["mean"]
        sums["communicating"] += entry["communicating_seconds"]["mean"]
    return phases


def refining_seconds(profile):
    return sum(sum(seconds.values()) for phase, seconds in phases_of(profile).items()
               if phase not in NOT_REFINING)


def synchronisation(profile):
    """The cost of the rounds of synchronisation, over all levels."""
    entries = [e for e in profile["phases"] if e["phase"] == "synchronise"]
    return {"rounds": sum(e["rounds"]["max"] for e in entries),
            "messages": sum(e["messages"]["sum"] for e in entries),
            "bytes": sum(e["bytes"]["sum"] for e in entries)}


def median_phases(profiles):
    every = [phases_of(profile) for profile in profiles]
    return {phase: {part: statistics.median(one[phase][part] for one in every)
                    for part in ("computing", "communicating")} for phase in every[0]}


def spread_of(seconds):
    """The ratio of the slowest to the fastest time."""
    return max(seconds) / min(seconds) if min(seconds) > 0 else 1


def figures(profiles):
    """The figures of repeated runs: times are medians; other figures are the same in every run."""
    last = profiles[-1]
    return {
        "seconds": statistics.median(p["seconds"]["max"] for p in profiles),
        "refining_seconds": statistics.median(refining_seconds(p) for p in profiles),
        "refining_spread": spread_of([refining_seconds(p) for p in profiles]),
        "phases": median_phases(profiles),
        "synchronisation": synchronisation(last),
        "messages": sum(e["messages"]["sum"] for e in last["phases"]),
        "bytes": sum(e["bytes"]["sum"] for e in last["phases"]),
        "cells_of_rank": [level["cells"]["of_rank"] for level in last["levels"]],
        "peak_memory_bytes": last["peak_memory_bytes"]["max"],
    }


# --- the runs


def by_reference(case, mesh, place):
    """The serial reference, with which all other runs are compared. If it refuses a mesh (because
    rounding would invert cells), they must refuse it as well."""
    outcomes = [refine(case, mesh, place, "reference", [], ["--engine", "reference"])
                for _ in range(case.repeats)]
    outcome, profile = outcomes[-1]
    if outcome.status not in (0, 2) or (outcome.status == 0 and profile is None):
        raise Failure(f"{case.name}: the reference ended with status {outcome.status}:\n"
                      f"{outcome.err.strip()}")
    folder = os.path.join(place.folder, "reference")
    return {"status": outcome.status, "message": own_message(outcome),
            "seconds": statistics.median(p["seconds"]["max"] for _, p in outcomes)
            if profile else None,
            "files": comparing.fingerprints(folder)}


def held_against(reference, outcome, place):
    """The differences of a parallel run from the reference, one line each; [] if there are none."""
    if outcome.status != reference["status"]:
        return [f"status {outcome.status} instead of {reference['status']}: "
                f"{own_message(outcome) or outcome.err.strip()[-200:]}"]
    if own_message(outcome) != reference["message"]:
        return [f"says '{own_message(outcome)}' instead of '{reference['message']}'"]
    return comparing.differences(os.path.join(place.folder, "reference"),
                                 os.path.join(place.folder, "parallel"))


def difference_by_compare(case, place):
    """The degree of difference of meshes whose bytes differ: the last line of octetra compare."""
    outcome = run([place.octetra, "compare", os.path.join("reference", case.output),
                   os.path.join("parallel", case.output)], place.folder)
    said = outcome.out.strip().splitlines() or outcome.err.strip().splitlines()
    return "octetra compare: " + (said[-1] if said else f"status {outcome.status}")


def in_parallel(case, mesh, reference, place, ranks, sync):
    """One repetition of one run: the differences, and the profile."""
    outcome, profile = refine(case, mesh, place, "parallel", ["mpirun", "-n", str(ranks)],
                              ["--sync", sync])
    lines = held_against(reference, outcome, place)
    if lines and outcome.status == reference["status"] == 0:
        lines.append(difference_by_compare(case, place))
    return lines, profile


def runs_of(case):
    """One rank needs no synchronisation."""
    by_gateway = [(ranks, "gateway") for ranks in case.gateway_ranks]
    return sorted([*((ranks, "neighbour") for ranks in RANKS), *by_gateway], key=lambda run: run[0])


def parallel_runs(case, mesh, reference, place):
    """All runs; repetitions alternate, so that a period of load does not affect a single run."""
    runs = runs_of(case)
    lines = {key: [] for key in runs}
    profiles = {key: [] for key in runs}
    for _ in range(case.repeats):
        for key in runs:
            differing, profile = in_parallel(case, mesh, reference, place, *key)
            lines[key] += [line for line in differing if line not in lines[key]]
            if profile:
                profiles[key].append(profile)
    return [{"ranks": ranks, "sync": sync, "repeats": case.repeats,
             "identical": not lines[ranks, sync], "differences": lines[ranks, sync],
             "figures": figures(profiles[ranks, sync]) if profiles[ranks, sync] else None}
            for ranks, sync in runs]


# --- looking at the meshes


def verified(case, mesh, place):
    """The verdict on the reference's result, and thereby on all identical files."""
    report = os.path.join(place.folder, "verdict.json")
    outcome = run([place.octetra, "verify", mesh, os.path.join("reference", case.output),
                   *case.refine.split(), "--maps", os.path.join("reference", "maps.txt"),
                   "--report", report], place.folder)
    if outcome.status not in (0, 1):
        raise Failure(f"{case.name}: octetra verify ended with status {outcome.status}:\n"
                      f"{outcome.err.strip()}")
    verdict = load(report)
    kept = ("valid", "checks", "violation_counts", "facts", "arithmetic")
    return {**{key: verdict[key] for key in kept}, "seconds": outcome.seconds}


def measured(mesh, place):
    """The statistics of a mesh by octetra info."""
    info = json.loads(must([place.octetra, "info", mesh, "--json"], place.folder))
    kept = ("volume", "dihedral_angle", "dihedral_histogram", "eta", "eta_histogram")
    return {"vertices": info["counts"]["vertices"], "cells": info["counts"]["cells"],
            **{key: info[key] for key in kept}}


def measure(case, place):
    """The results of a case, as an entry of the report's JSON."""
    mesh = coarse_mesh(case, place)
    reference = by_reference(case, mesh, place)
    refused = reference["status"] != 0
    runs = parallel_runs(case, mesh, reference, place)
    fine = os.path.join(place.folder, "reference", case.output)
    verdict = None if refused else verified(case, mesh, place)
    return {
        "name": case.name, "about": case.about, "group": case.group,
        "mesh": case.generate or case.after or os.path.basename(case.file),
        "mesh_is": "generated" if case.generate else "refined" if case.after else "file",
        "refine": case.refine, "output": case.output, "scaling": case.scaling,
        "before": measured(mesh, place), "after": None if refused else measured(fine, place),
        "reference": reference, "runs": runs, "verdict": verdict,
        "identical": all(run["identical"] for run in runs),
        "valid": refused or verdict["valid"],
    }
