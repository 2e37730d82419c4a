"""The report as a single HTML file."""

import base64
import os
import shlex
from html import escape

import bench_section
import campaign_section
import loop_section
import plots
from charts import legend
from machine import is_busy, known
from summary import paper_rows, run_of, totals
from tables import (cases_table, checks_table, files_table, paper_table, runs_table,
                    where_run)
from words import count, degrees, plural, seconds, size

STYLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page.css")


def figure(drawing, caption, kind=""):
    return f'<figure class="{kind}">{drawing}<figcaption>{caption}</figcaption></figure>'


def details(summary, content, kind=""):
    return f'<details{f" class={kind}" if kind else ""}><summary>{summary}</summary>{content}</details>'


# --- the answer, first


def answer(total):
    """The result in one sentence, with its colour."""
    runs = plural(total["runs"], "run")
    cases = plural(total["cases"], "case")
    if total["differing"]:
        return "bad", (f"Not identical to the serial reference: {', '.join(total['differing'])} "
                       f"({plural(total['differing_runs'], 'kind')} of run).")
    if total["invalid"]:
        return "bad", f"Not valid by exact verification: {', '.join(total['invalid'])}."
    return "good", f"{cases}, {runs} on 1 to 4 ranks: all identical to the serial reference, byte by byte."


def verdict(total):
    kind, sentence = answer(total)
    judged = total["refined"] + total["loops"]
    valid = judged - len(total["invalid"])
    refused = (f" {plural(total['refused'], 'mesh/meshes')} refused by all runs, because "
               "rounding of midpoints would invert cells." if total["refused"] else "")
    return (f'<div class="verdict {kind}"><b>{escape(sentence)}</b>'
            f"{plural(total['repeats'], 'run')} of these only for timing. "
            f"{size(total['bytes'])} of files compared, from both synchronisations, with up to {count(total['most_cells'])} cells. "
            f"{count(valid)} of {plural(judged, 'refined mesh/meshes')} found valid by a verifier that shares with the "
            "engines only the mesh, its file formats and the order of edges. Of its decisions "
            f"{count(total['filtered'])} were made by floating point with an error bound, and "
            f"{count(total['exact'])} required exact arithmetic.{refused}</div>")


WORDS = {
    "reference": "the serial implementation; it shares only the mesh, its file formats and the order of edges with the "
                 "distributed engine, which is run on 1 to 4 ranks",
    "rank": "a process under mpirun, with a part of the mesh; the partition is <code>rcb</code>, the default",
    "scheme 8t, 4t, 2t": "a marked cell marks all six of its edges, the longest of each face, or its longest",
    "closure": "marking the longest edge of every face with a marked edge, until nothing changes; its propagation paths "
               "are the paper's LEPP, and those inside a part its local LEPP",
    "neighbour, gateway": "the exchange of marks on shared edges: directly between the sharers, or through the first "
                          "rank, which collects them and passes them on (<code>--sync</code>)",
    "rounds": "the number of exchanges of newly marked edges between ranks, over all levels",
    "messages and bytes": "in the table of cases those of synchronisation; in the table of a case's runs all messages of "
                          "the run, including those that distribute the mesh and collect it for writing",
    "parent maps": "a file (<code>--maps</code>) with the root, in the input, of each cell, facet and edge of the "
                   "result",
    "8T-LE": "a check of the verifier: the bisected edges are the closure of those that the scheme marks, and cells are "
             "cut by the right pattern",
    "η": "the mean ratio of a cell: 1 for a regular tetrahedron, 0 for a flat one",
}


def words_section():
    rows = "".join(f"<dt>{word}</dt><dd>{meaning}</dd>" for word, meaning in WORDS.items())
    return details("<b>Terms of this page</b>", f"<dl>{rows}</dl>")


def where(report):
    told = [*known(report["machine"]), report["machine"]["octetra"]]
    return f'<p class="faint">{escape(" · ".join(word for word in told if word))}</p>'


def load_notice(machine):
    """A warning if times were measured on a loaded machine."""
    if not is_busy(machine):
        return ""
    return (f'<p class="notice"><b>Times on this page are unreliable.</b> When the report was started, '
            f"other programs used {machine['load']:.1f} of {plural(machine['cores'], 'core')}. "
            "Bytes, rounds and messages do not depend on that.</p>")


def faults(case):
    """The faults of a case, one line each."""
    lines = [f"{where_run(run)}: {line}" for run in case["runs"] for line in run["differences"]]
    if not case["valid"]:
        lines += [f"verification: {code}, {plural(number, 'time')}"
                  for code, number in case["verdict"]["violation_counts"].items()]
    return lines


def faults_section(cases, loops):
    found = ([(case, line) for case in cases for line in faults(case)]
             + [(loop, line) for loop in loops for line in loop_section.faults(loop)])
    items = [f"<li><b>{escape(case['name'])}</b>, {escape(line)}</li>" for case, line in found]
    return f"<h2>Faults</h2><ul>{''.join(items)}</ul>" if items else ""


# --- sections


def in_front(cases):
    """The cases that are shown first: all but those of the corpus, unless there are no others."""
    return [case for case in cases if case["group"] != "corpus"] or cases


def cases_section(cases):
    shown = in_front(cases)
    corpus = [case for case in cases if case not in shown]
    html = ("<h2>Cases</h2><p>Each is refined by the serial reference, then by the parallel engine "
            "on 1, 2, 3 and 4 ranks, with both synchronisations (meshes of the corpus with the gateway on 4 ranks only); "
            "then every file, including parent maps, is compared byte by byte.</p>" + cases_table(shown))
    if corpus:
        right = sum(case["identical"] and case["valid"] for case in corpus)
        html += details(f"<b>The corpus</b>: {plural(len(corpus), 'mesh/meshes')}, chosen for "
                        f"difficult cases (ties, slivers, unusual files); {right} of them "
                        "identical, and valid or refused by all runs. Meshes from files are refined by "
                        "<code>--all --levels 2</code>, the others by <code>--random 0.1 --levels 2</code>",
                        cases_table(corpus))
    return html


def picture_section(report, folder):
    html = ""
    for picture in report["pictures"]:
        case = next(case for case in report["cases"] if case["name"] == picture["case"])
        if picture["missing"]:
            html += f'<p class="faint">{escape(picture["missing"])}</p>'
            continue
        with open(os.path.join(folder, picture["file"]), "rb") as file:
            data = base64.b64encode(file.read()).decode("ascii")
        html += figure(f'<img alt="{escape(case["name"])} before and after" '
                       f'src="data:image/png;base64,{data}">',
                       f"<b>{escape(case['name'])}</b>: {escape(case['about'])}. Before and after, "
                       "on 4 ranks, coloured by rank.")
    if not html:
        return ""
    return f"<h2>Meshes and their partition</h2><div class=pictures>{html}</div>"


def paper_section(cases):
    if not paper_rows(cases):
        return ""
    return ("<h2>Comparison with the paper</h2><p>M. Balman, <i>Tetrahedral Mesh Refinement in Distributed "
            "Environments</i>, refines meshes of these sizes. <b>These are other meshes</b>, because "
            "the paper's are not available: gears of nearly the same numbers of vertices and cells, in which "
            "the number of random marks is chosen for about the same growth. Hence the counts of cells "
            "agree by construction; times cannot be compared, because the paper "
            "tabulates none.</p>" + paper_table(cases) +
            '<p class="faint">The paper\'s vertices for 235,941 cells are omitted, because they contradict its other '
            "figures; for 770,882 cells it has none. It does not state from which mesh the last one was refined; here "
            "it is the previous one.</p>")


def angle_figures(case):
    old, new = case["before"]["dihedral_angle"], case["after"]["dihedral_angle"]
    reach = (f"<b>{escape(case['name'])}</b>: dihedral angles are {degrees(old['min'])} to "
             f"{degrees(old['max'])} before, {degrees(new['min'])} to {degrees(new['max'])} after")
    ratio = (f"mean η is {case['before']['eta']['mean']:.3f} before, "
             f"{case['after']['eta']['mean']:.3f} after; the least "
             f"{case['before']['eta']['min']:.3f} and {case['after']['eta']['min']:.3f}")
    return (figure(plots.dihedral_angles(case), reach + ".")
            + figure(plots.mean_ratios(case), ratio + "."))


def angles_section(cases):
    shown = [case for case in in_front(cases) if case["after"]]
    if not shown:
        return ""
    pairs = ["<div class=plots>" + angle_figures(case) + "</div>" for case in shown]
    return ("<h2>Shapes of cells</h2><p>Fraction of all dihedral angles, and of all cells, in each "
            "bin.</p>" + legend([("before", "before"), ("after", "after")]) + "".join(pairs[:2])
            + (details(f"{plural(len(pairs) - 2, 'more case')}", "".join(pairs[2:]))
               if len(pairs) > 2 else ""))


def balance_figures(case):
    panels = [figure(plots.cells_per_rank(run_of(case, ranks)["cells_of_rank"]),
                     f"{ranks} ranks", "narrow")
              for ranks in (2, 3, 4) if run_of(case, ranks)]
    return f"<h3>{escape(case['name'])}</h3><div class=plots>{''.join(panels)}</div>"


def balance_section(cases):
    shown = [case for case in in_front(cases) if case["after"]]
    if not shown:
        return ""
    blocks = [balance_figures(case) for case in shown]
    return ("<h2>Cells of each rank</h2><p>The mesh is partitioned before refinement by the predicted number of "
            "cells; before a level cells are migrated if a rank would have far too many.</p>"
            + legend([("before", "before"), ("after", "after")])
            + "".join(blocks[:1]) + (details(f"{plural(len(blocks) - 1, 'more case')}",
                                             "".join(blocks[1:])) if len(blocks) > 1 else ""))


def timed_cases(cases):
    """The cases made for scaling or, if there are none, the largest."""
    refined = [case for case in cases if case["after"] and plots.neighbour_runs(case)]
    return ([case for case in refined if case["scaling"]]
            or sorted(refined, key=lambda case: case["after"]["cells"])[-1:])


def time_section(cases, cores):
    if not cases:
        return ""
    repeats = cases[0]["runs"][0]["repeats"]
    of = f"Medians of {repeats} runs" if repeats > 1 else "One run"
    charts = [figure(plots.phases(case),
                     f"<b>{escape(case['name'])}</b>, {count(case['before']['cells'])} to "
                     f"{count(case['after']['cells'])} cells: every step on 1, 2, 3 and 4 ranks, "
                     "as in the paper's Figure 10.") for case in cases]
    return ("<h2>Time of the steps</h2><p>Wall-clock seconds, averaged over ranks; "
            f"communicating is mostly waiting. {of}. This machine has {plural(cores, 'core')}, which "
            "more ranks must share, so that their times do not show scaling.</p>"
            + legend([("computing", "computing"), ("communicating", "communicating")])
            + "".join(charts))


def scaling_figure(case, cores):
    one = run_of(case, 1)
    return figure(plots.scaling(case, cores),
                  f"<b>{escape(case['name'])}</b>, {count(case['after']['cells'])} cells: on one "
                  f"rank refinement takes {seconds(one['refining_seconds'])} of "
                  f"{seconds(one['seconds'])}. Medians of {plural(case['runs'][0]['repeats'], 'run')}; the slowest "
                  f"takes up to {max(run_of(case, ranks).get('refining_spread', 1) for ranks in (1, 2, 3, 4)):.2f} times as long as the fastest.")


def scaling_section(cases, cores):
    cases = [case for case in cases if run_of(case, 1)]
    if not cases:
        return ""
    return ("<h2>Strong scaling</h2>"
            + legend([("refining_seconds", "refinement itself"),
                      ("seconds", "the whole run, with reading, partition and writing")])
            + '<p class="faint">Speedup over one rank; dashed: ideal speedup'
            ".</p><div class=plots>"
            + "".join(scaling_figure(case, cores) for case in cases) + "</div>")


# --- every run


def commands(case):
    made = {"generated": f"octetra generate {case['mesh']} -o coarse.ele",
            "refined": f"coarse mesh: the result of \"{case['mesh']}\"",
            "file": f"coarse mesh: corpus/meshes/{case['mesh']}"}[case["mesh_is"]]
    coarse = f"corpus/meshes/{case['mesh']}" if case["mesh_is"] == "file" else "coarse.ele"
    refine = f"octetra refine {shlex.quote(coarse)} {case['refine']} --maps maps.txt"
    return (f"{made}\n{refine} -o {case['output']} --engine reference\n"
            f"mpirun -n RANKS {refine} -o {case['output']} --sync neighbour|gateway\n"
            f"octetra verify {shlex.quote(coarse)} {case['output']} {case['refine']} "
            "--maps maps.txt")


def case_details(case):
    html = f"<pre>{escape(commands(case))}</pre>" + runs_table(case)
    if case["verdict"] is None:
        message = case["reference"]["message"]
        html += f"<p>Message of all runs: <code>{escape(message)}</code></p>"
        return details(escape(case["name"]), html)
    arithmetic = case["verdict"]["arithmetic"]
    html += (files_table(case) + checks_table(case["verdict"]) +
             f'<p class="faint">Verified in {seconds(case["verdict"]["seconds"])}: '
             f"{count(arithmetic['filtered'])} decisions by floating point with an error bound, "
             f"{count(arithmetic['exact'])} by exact arithmetic.</p>")
    return details(escape(case["name"]), html)


def runs_section(cases):
    return "<h2>Every run</h2>" + details(
        "commands, runs, hashes of the files, and checks of the verifier, by case",
        "".join(map(case_details, cases)), "appendix")


def page(report, folder, benchmarks=None):
    """The whole page; pictures are read from `folder`. `benchmarks`: results of ./dev bench, if
    there are any."""
    cases, machine, loops = report["cases"], report["machine"], report.get("loops", [])
    timed, cores = timed_cases(cases), machine["cores"]
    with open(STYLE, encoding="utf-8") as file:
        style = file.read()
    body = ('<p class="faint">Octetra: equivalence report</p>'
            f"<h1>Is the result of refinement identical in all runs?</h1>{where(report)}"
            + verdict(totals(report)) + faults_section(cases, loops) + load_notice(machine) + words_section()
            + cases_section(cases) + loop_section.section(loops) + picture_section(report, folder) + paper_section(cases)
            + angles_section(cases) + balance_section(cases) + time_section(timed, cores)
            + scaling_section(timed, cores) + bench_section.section(benchmarks) + campaign_section.section()
            + runs_section(cases))
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>Octetra: equivalence report</title><style>{style}</style></head>"
            f"<body>{body}</body></html>\n")
