"""Groups that were not run this time."""

import json

# Properties that must be equal for figures in one table.
SAME = ("processor", "cores", "memory_bytes", "system", "mpi", "compiler", "build", "commit")


def is_alike(old, new):
    """Returns whether the old result is from this machine, with the same program and sizes."""
    if old.get("format") != new["format"] or old.get("version") != new["version"]:
        return False
    commit = new["machine"]["commit"]
    if commit is None or commit.endswith(" and changes") or old["quick"] != new["quick"]:
        return False
    return all(old["machine"].get(key) == new["machine"].get(key) for key in SAME)


def merged(old_cases, new_cases):
    """Replaces old cases by new ones of the same name; others stay at their positions."""
    old, new = ({case["name"]: case for case in cases} for cases in (old_cases, new_cases))
    return list((old | new).values())


def load(path):
    """The results in a file; None if there is none."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def with_old(made, old, order):
    """Adds to `made` the old results of what was not measured now, if they are still valid."""
    machine = made["machine"]
    dated = [{**group, "date": machine["date"], "load": machine["load"]}
             for group in made["groups"]]
    made = {**made, "groups": dated}
    if old is None or not is_alike(old, made):
        return made
    by_name = {group["name"]: group for group in old["groups"]}
    for group in dated:
        before = by_name.get(group["name"])
        cases = merged(before["cases"], group["cases"]) if before else group["cases"]
        by_name[group["name"]] = {**group, "cases": cases}
    return {**made, "groups": sorted(by_name.values(), key=lambda g: order.index(g["name"]))}
