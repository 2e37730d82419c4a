"""The report's tables as Markdown."""

import loop_section
from machine import known
from page import answer
from summary import paper_rows, totals
from tables import growth, own_counts, counts, time_of
from words import count, seconds


def line(*cells):
    return "| " + " | ".join(cells) + " |"


def rounds(case, sync):
    run = next(run for run in case["runs"] if (run["ranks"], run["sync"]) == (4, sync))
    if not run["figures"]:
        return "–"
    counted = run["figures"]["synchronisation"]
    return f"{count(counted['rounds'])} / {count(counted['messages'])}"


def case_line(case):
    right = sum(run["identical"] for run in case["runs"])
    reference = case["reference"]["seconds"]
    return line(case["name"], count(case["before"]["cells"]),
                count(case["after"]["cells"]) if case["after"] else "refused",
                f"{right} of {len(case['runs'])}",
                ("valid" if case["valid"] else "**not valid**") if case["verdict"] else "–",
                rounds(case, "neighbour"), rounds(case, "gateway"),
                seconds(reference) if reference is not None else "–",
                time_of(case, 1), time_of(case, 2))


def paper_line(case, before, after):
    return line(case["name"], counts(before), counts(after), growth(before, after),
                own_counts(case["before"]), own_counts(case["after"]),
                growth(*[(0, case[key]["cells"]) for key in ("before", "after")]))


def loop_lines(loops):
    if not loops:
        return []
    lines = ["", "Loops of steps; the mesh after every step is compared.", "",
             "| loop | steps | maximum of cells | identical, also after restarts | input restored | exact verification "
             "| reference | 1 rank | 2 ranks |", "|---|---:|---:|---:|---|---|---:|---:|---:|"]
    for loop in loops:
        right = sum(run["identical"] for run in loop["runs"])
        lines.append(line(loop["name"], count(len(loop["steps"])), count(max(loop["cells"])),
                          f"{right} of {len(loop['runs'])}", "yes" if loop["input_comes_back"] else "**no**",
                          "valid" if loop["valid"] else "**not valid**", seconds(loop["reference"]["seconds"]),
                          loop_section.time_of(loop, 1), loop_section.time_of(loop, 2)))
    return lines


def markdown(report):
    machine, cases = report["machine"], report["cases"]
    lines = ["# Equivalence report", "", answer(totals(report))[1], "",
             ", ".join(known(machine)) + f", {machine['load']:.1f} cores busy with other work "
             "when it began.", "",
             "| case | cells before | after | same bytes | exact verification "
             "| rounds / messages, neighbour, 4 ranks | gateway | reference | 1 rank | 2 ranks |",
             "|---|---:|---:|---:|---|---:|---:|---:|---:|---:|",
             *map(case_line, cases)]
    lines += loop_lines(report.get("loops", []))
    rows = paper_rows(cases)
    if rows:
        lines += ["", "The paper's counts, vertices / cells, beside ours; the meshes are not the "
                  "same.", "",
                  "| case | paper, before | after | growth | here, before | after | growth |",
                  "|---|---:|---:|---:|---:|---:|---:|",
                  *[paper_line(*row) for row in rows]]
    return "\n".join(lines) + "\n"
