"""Groups that were not run this time."""

import json

# What must be the same for figures to stand in one table.
SAME = ("processor", "cores", "memory_bytes", "system", "mpi", "compiler", "build", "commit")


def is_alike(old, new):
    """Was the old one measured here, of the same program and with the same sizes?"""
    if old.get("format") != new["format"] or old.get("version") != new["version"]:
        return False
    commit = new["machine"]["commit"]
    if commit is None or commit.endswith(" and changes") or old["quick"] != new["quick"]:
        return False
    return all(old["machine"].get(key) == new["machine"].get(key) for key in SAME)


def merged(old_cases, new_cases):
    """New cases in the place of old ones of the same name; others stay, and where they were."""
    old, new = ({case["name"]: case for case in cases} for cases in (old_cases, new_cases))
    return list((old | new).values())


def load(path):
    """The results there; None if there are none."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def with_old(made, old, order):
    """`made`, and from old results, if there are any, what was not measured now, if it still holds;
    else it is left out."""
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
