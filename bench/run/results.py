"""RESULTS.md: the figures as tables."""

from machine import is_busy, known


def number(value):
    """With three digits; as a whole number if it is large or a count."""
    if isinstance(value, int) or abs(value) >= 1000:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def with_unit(value, unit):
    return f"{number(value)} {unit}".rstrip()


def spread(figure):
    if "least" not in figure:
        return ""
    return f" ({number(figure['least'])} to {number(figure['most'])})"


def target(figure):
    for key, words in (("at_most", "at most"), ("at_least", "at least")):
        if key in figure:
            return f"{words} {with_unit(figure[key], figure['unit'])}"
    return ""


def answer(figure):
    if "met" not in figure:
        return ""
    return "met" if figure["met"] else "**not met**"


def rows(case, quick):
    for i, figure in enumerate(case["figures"]):
        if quick:  # targets are for the sizes of a full run
            figure = {key: figure[key] for key in ("name", "value", "unit")}
        yield (f"| {case['name'] if i == 0 else ''} | {figure['name']} "
               f"| {with_unit(figure['value'], figure['unit'])}{spread(figure)} "
               f"| {target(figure)} | {answer(figure)} |")


def table(group, date, quick):
    lines = [f"## {group['name'].capitalize()}", "", group["about"], ""]
    if group["date"] != date:
        lines += [f"Measured {group['date']}, of the same commit, {busy(group['load'])} when it "
                  "began.", ""]
    lines += ["| case | figure | value | target | |", "|---|---|---:|---:|---|"]
    for case in group["cases"]:
        lines += rows(case, quick)
        lines += [f"| {case['name']} | **wrong** | {line} | | |" for line in case["wrong"]]
    return lines + [""]


def busy(load):
    return f"{load:.1f} cores busy with other work"


def where(machine):
    return ", ".join([*known(machine), busy(machine["load"]) + " when it began"]) + "."


def loud(machine):
    if not is_busy(machine):
        return []
    return ["**Other programs ran at the same time**, so seconds are no measure.", ""]


def of_what(made):
    repetitions = sorted({group["repetitions"] for group in made["groups"]})
    runs = ("Single runs" if repetitions == [1] else
            f"Medians of {' or '.join(map(str, repetitions))} runs in turns; of one "
            "program's speed against another's, of what it was in each turn; in parentheses the "
            "least and the most of the runs")
    words = ("Small meshes, to see that all runs; targets are for large ones. " if made["quick"]
             else "")
    return (f"{words}{runs}; seconds by the wall clock unless it says "
            "processor. What each group means: [README.md](README.md).")


def results(made):
    lines = ["# Results of the benchmarks", "",
             "Made by `./dev bench`; do not edit.", "", where(made["machine"]), "",
             *loud(made["machine"]), of_what(made), ""]
    for group in made["groups"]:
        lines += table(group, made["machine"]["date"], made["quick"])
    return "\n".join(lines)
