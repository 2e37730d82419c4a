"""The tables of the page."""

from html import escape

from summary import paper_rows, run_of
from words import count, seconds, size

YES, NO = '<span class="yes">✓</span>', '<span class="no">✗</span>'


def cell(words, kind="number"):
    return f'<td class="{kind}">{words}</td>'


def row(*cells):
    return "<tr>" + "".join(cells) + "</tr>"


def table(head, rows, label, kind=""):
    """Wide tables scroll separately."""
    return (f'<div class="wide"><table class="{kind}" aria-label="{escape(label)}">'
            f"<thead>{head}</thead><tbody>"
            + "".join(rows) + "</tbody></table></div>")


def heads(*names):
    """The first heading is that of words, the others those of numbers."""
    return "<tr>" + "".join(f"<th{'' if i == 0 else ' class=number'}>{name}</th>"
                            for i, name in enumerate(names)) + "</tr>"


# --- the cases


def same_bytes(case):
    right = sum(run["identical"] for run in case["runs"])
    return f"{YES if case['identical'] else NO} {right} of {len(case['runs'])}"


def validity(case):
    if case["verdict"] is None:
        return "refused"
    return f"{YES} valid" if case["valid"] else f"{NO} not valid"


def synchronisation(case, sync):
    figures = run_of(case, 4, sync)
    if figures is None:
        return "–"
    counted = figures["synchronisation"]
    return f"{count(counted['rounds'])} · {count(counted['messages'])} · {size(counted['bytes'])}"


def time_of(case, ranks):
    figures = run_of(case, ranks)
    return seconds(figures["seconds"]) if figures else "–"


def case_row(case):
    reference = case["reference"]["seconds"]
    return row(
        cell(f"<b>{escape(case['name'])}</b><small>{escape(case['about'])}</small>", "words"),
        cell(count(case["before"]["cells"])),
        cell(count(case["after"]["cells"]) if case["after"] else "–"),
        cell(same_bytes(case), "answer"), cell(validity(case), "answer"),
        cell(synchronisation(case, "neighbour")), cell(synchronisation(case, "gateway")),
        cell(seconds(reference) if reference is not None else "–"),
        cell(time_of(case, 1)), cell(time_of(case, 2)))


def cases_table(cases):
    head = ("<tr><th rowspan=2>case</th><th colspan=2>cells</th><th rowspan=2>runs with the<br>"
            "reference's bytes</th><th rowspan=2>exact<br>verification</th>"
            "<th colspan=2>synchronisation of 4 ranks: rounds · messages · bytes</th>"
            "<th colspan=3 class=number>time, files included</th></tr>"
            "<tr><th class=number>before</th><th class=number>after</th><th class=number>neighbour"
            "</th><th class=number>gateway</th><th class=number>reference</th>"
            "<th class=number>1 rank</th><th class=number>2 ranks</th></tr>")
    return table(head, [case_row(case) for case in cases], "Cases", "full")


# --- the paper's cases


def counts(vertices_and_cells):
    """As in "527 / 1,803"; a dash if the paper has no count, or a wrong one."""
    return " / ".join("–" if n is None else count(n) for n in vertices_and_cells)


def own_counts(mesh):
    return counts((mesh["vertices"], mesh["cells"]))


def growth(before, after):
    return f"× {after[1] / before[1]:.2f}"


def paper_table(cases):
    head = ("<tr><th rowspan=2>case</th><th colspan=3>the paper: vertices / cells</th>"
            "<th colspan=3>here: vertices / cells</th></tr><tr>"
            + 2 * ("<th class=number>before</th><th class=number>after</th>"
                   "<th class=number>growth</th>") + "</tr>")
    rows = []
    for case, before, after in paper_rows(cases):
        ours = [(mesh["vertices"], mesh["cells"]) for mesh in (case["before"], case["after"])]
        rows.append(row(cell(escape(case["name"]), "words"), cell(counts(before)),
                        cell(counts(after)), cell(growth(before, after)),
                        *(cell(counts(mesh)) for mesh in ours), cell(growth(*ours))))
    return table(head, rows, "The paper's counts beside ours")


# --- one case in detail


def where_run(run):
    return f"{run['ranks']} ranks, {run['sync']}" if run["ranks"] > 1 else "1 rank"


def run_row(run):
    where, answer = where_run(run), YES if run["identical"] else NO
    figures = run["figures"]
    if figures is None:
        return row(cell(where, "words"), cell(answer, "answer"), *[cell("–")] * 5)
    counted = figures["synchronisation"]
    return row(cell(where, "words"), cell(answer, "answer"), cell(seconds(figures["seconds"])),
               cell(seconds(figures["refining_seconds"])), cell(count(counted["rounds"])),
               cell(f"{count(figures['messages'])} · {size(figures['bytes'])}"),
               cell(size(figures["peak_memory_bytes"])))


def runs_table(case):
    head = heads("run", "same", "time", "of it refining", "rounds", "all messages · bytes",
                 "peak memory of a rank")
    return table(head, [run_row(run) for run in case["runs"]], f"Runs of {case['name']}")


def files_table(case):
    rows = [row(cell(escape(name), "words"), cell(size(file["bytes"])),
                cell(f"<code>{file['sha256']}</code>"))
            for name, file in case["reference"]["files"].items()]
    return table(heads("file", "size", "SHA-256"), rows, f"Files of {case['name']}")


def checks_table(verdict):
    sign = {"passed": YES, "failed": NO}
    rows = [row(cell(escape(check["name"]), "words"),
                cell(f"{sign.get(check['status'], '')} {check['status']}", "answer"),
                cell(escape(check["note"]), "words")) for check in verdict["checks"]]
    return table("<tr><th>check</th><th>answer</th><th>note</th></tr>", rows, "Checks")
