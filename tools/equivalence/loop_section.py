"""The section of the page about loops of steps."""

from html import escape

from charts import Frame, bar, legend, line, text
from tables import NO, YES, cell, heads, row, table
from words import count, plural, seconds, size

def name_of_run(run):
    ranks = [plural(n, "rank") for n in run["ranks"]]
    return ranks[0] if len(ranks) == 1 else f"{ranks[0]}, then {ranks[1]}"


def faults(loop):
    lines = [f"{name_of_run(run)}: {fault}" for run in loop["runs"] for fault in run["differences"]]
    if not loop["input_comes_back"]:
        lines.append("coarsening all cells does not restore the input")
    if not loop["valid"]:
        lines.append("verification: the finest mesh is not a refinement of the input")
    return lines


def figures_of(loop, ranks):
    return next((run["figures"] for run in loop["runs"] if run["ranks"] == [ranks]), None)


def time_of(loop, ranks):
    found = figures_of(loop, ranks)
    return seconds(found["seconds"]) if found else "–"


def loop_row(loop):
    straight = [run for run in loop["runs"] if len(run["ranks"]) == 1]
    stopped = [run for run in loop["runs"] if len(run["ranks"]) == 2]

    def right(runs):
        good = sum(run["identical"] for run in runs)
        return cell(f"{YES if good == len(runs) else NO} {good} of {len(runs)}", "answer")

    four = figures_of(loop, 4)
    return row(cell(f"<b>{escape(loop['name'])}</b><small>{escape(loop['about'])}</small>", "words"),
               cell(count(len(loop["steps"]))), cell(count(loop["input_cells"])), cell(count(max(loop["cells"]))),
               right(straight), right(stopped), cell(YES if loop["input_comes_back"] else NO, "answer"),
               cell(f"{YES} valid" if loop["valid"] else f"{NO} not valid", "answer"),
               cell(seconds(loop["reference"]["seconds"])), cell(time_of(loop, 1)), cell(time_of(loop, 2)),
               cell(size(four["bytes"]) if four else "–"), cell(size(four["peak_memory_bytes"]) if four else "–"))


def balance_chart(loop, ranks):
    """The ratio of the maximum to the mean number of cells of the ranks, before and after each step
    `rebalance`."""
    turns = figures_of(loop, ranks)["rebalanced"]
    frame = Frame(530, 230, max(before for before, _ in turns))
    frame.y_axis("most/mean")
    wide = (frame.right - frame.left) / len(turns)
    for number, (before, after) in enumerate(turns):
        left = frame.left + wide * number
        for place, value, kind in ((0.14, before, "before"), (0.51, after, "after")):
            top = frame.y(value)
            frame.parts.append(bar(left + place * wide, top, 0.35 * wide, frame.bottom - top, kind, f"{value:.2f}"))
        frame.parts.append(text(left + wide / 2, frame.bottom + 16, str(number + 1)))
    frame.parts.append(line(frame.left, frame.y(1), frame.right, frame.y(1), "even"))
    frame.x_title("step rebalance")
    return frame.svg(f"Maximum over mean number of cells of {ranks} ranks, before and after each step rebalance")


def commands(loop):
    return "\n".join([f"octetra generate {loop['generate']} -o input.mesh", "octetra adapt input.mesh --script steps.txt "
                      "-o end.mesh --engine reference", "mpirun -n RANKS octetra adapt input.mesh --script steps.txt "
                      "-o end.mesh", "", "steps.txt, with the mesh written after each:", *loop["steps"]])


def section(loops):
    if not loops:
        return ""
    head = heads("loop", "steps", "cells of the input", "at most", "1 to 4 ranks", "restarted on others",
                 "input comes back", "exact verification", "reference", "1 rank", "2 ranks", "sent, 4 ranks",
                 "memory, 4 ranks")
    drawn = [(loop, ranks) for loop in loops for ranks in (2, 4)
             if figures_of(loop, ranks) and figures_of(loop, ranks)["rebalanced"]]
    charts = "".join(f"<figure>{balance_chart(loop, ranks)}<figcaption><b>{escape(loop['name'])}</b>, {ranks} ranks"
                     "</figcaption></figure>" for loop, ranks in drawn)
    scripts = "".join(f"<details><summary>{escape(loop['name'])}</summary><pre>{escape(commands(loop))}</pre></details>"
                      for loop in loops)
    return ("<h2>Loops</h2><p>Meshes are repeatedly refined, coarsened and rebalanced, as by a solver. The mesh after every "
            "step is compared with the serial reference's, byte by byte: on 1 to 4 ranks, and after saving halfway and "
            "continuing on another number of ranks. Finally all cells are coarsened, which restores the input, bit by bit.</p>"
            + table(head, map(loop_row, loops), "loops of steps")
            + ("<h3>Maximum number of cells of a rank, over the mean</h3>" + legend([("before", "before"), ("after", "after")])
               + f"<div class=plots>{charts}</div>" if drawn else "")
            + scripts)
