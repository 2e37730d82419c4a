"""Totals over all cases."""

from cases import PAPER_COUNTS


def totals(report):
    """Counts over all cases and loops; `good` is the result of the report."""
    cases, loops = report["cases"], report.get("loops", [])
    refined = [case for case in cases if case["after"]]
    runs = [run for case in cases for run in case["runs"]]
    loop_runs = [run for loop in loops for run in loop["runs"]]
    return {
        "good": all(case["identical"] and case["valid"] for case in [*cases, *loops]),
        "cases": len(cases) + len(loops),
        "differing": [case["name"] for case in [*cases, *loops] if not case["identical"]],
        "refined": len(refined),
        "refused": len(cases) - len(refined),
        "invalid": [case["name"] for case in [*refined, *loops] if not case["valid"]],
        "runs": sum(run["repeats"] for run in runs) + len(loop_runs),
        "repeats": sum(run["repeats"] - 1 for run in runs),
        "differing_runs": sum(not run["identical"] for run in [*runs, *loop_runs]),
        "bytes": sum(run["repeats"] * file["bytes"] for case in cases for run in case["runs"]
                     for file in case["reference"]["files"].values())
                 + sum(len(loop["runs"]) * loop["bytes"] for loop in loops),
        "most_cells": max([*(case["after"]["cells"] for case in refined),
                           *(max(loop["cells"]) for loop in loops)], default=0),
        "loops": len(loops),
        "filtered": sum(case["verdict"]["arithmetic"]["filtered"] for case in refined),
        "exact": sum(case["verdict"]["arithmetic"]["exact"] for case in refined),
    }


def run_of(case, ranks, sync="neighbour"):
    """The figures of a run; None if there are none."""
    return next((run["figures"] for run in case["runs"]
                 if (run["ranks"], run["sync"]) == (ranks, sync)), None)


def paper_rows(cases):
    """The paper's refinements beside ours: (case, paper before, paper after); the paper's counts
    are (vertices, cells), with None for missing ones."""
    by_name = {case["name"]: case for case in cases}
    return [(by_name[name], before, after) for name, before, after in PAPER_COUNTS
            if name in by_name]
