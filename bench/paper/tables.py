"""The tables of docs/paper.md."""
from machine import known


def table(heads, rows, words=1):
    """The first `words` columns contain words, all others numbers."""
    lines = ["| " + " | ".join(heads) + " |", "|---" * words + "|" + "---:|" * (len(heads) - words)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def count(number):
    return "" if number is None else f"{number:,}"


def share(fraction):
    return f"{100 * fraction:.4g} %"


def runs_table(runs, paper):
    """The paper's counts beside those of each kind of mesh."""
    by_kind = {(run["kind"], run["size"]): run for run in runs}
    kinds = sorted({run["kind"] for run in runs})
    rows = []
    for size, steps in paper.items():
        if (kinds[0], size) not in by_kind:
            continue
        for n in range(len(steps) + 1):
            vertices, cells = steps[n][1] if n < len(steps) else steps[-1][2]
            before = steps[n - 1][1][1] if n > 0 else None
            row = [f"{size}, {'input' if n == 0 else f'run {n}'}", count(cells), count(vertices),
                   f"{cells / before:.2f}" if before else ""]
            for kind in kinds:
                run = by_kind[kind, size]
                now = run["counts"][n]
                row += [count(now["cells"]), count(now["vertices"]),
                        f"{now['cells'] / run['counts'][n - 1]['cells']:.2f}" if n else "",
                        share(run["shares"][n - 1]) if n else ""]
            rows.append(row)
    heads = ["", "paper: cells", "vertices", "growth"]
    for kind in kinds:
        heads += [f"{kind}: cells", "vertices", "growth", "marked"]
    return table(heads, rows)


def propagation_rows(levels, name_of):
    rows = []
    for level in levels:
        marked = level["edges_marked"]
        rows.append([name_of(level), count(level["input_cells"]), count(level["marked"]), count(marked),
                     f"{level['edges_closed'] / marked:.2f}", share(level["cells_cut"] / level["input_cells"]),
                     f"{level['cells'] / level['input_cells']:.2f}", str(level["sweeps"]),
                     *(str(level["rounds"][ranks]) for ranks in ("2", "4", "8"))])
    return rows


PROPAGATION_HEADS = ["cells", "marked", "their edges", "times by closure", "cells cut", "growth", "sweeps",
                     "rounds on 2 ranks", "4", "8"]


def shares_table(levels):
    return table(["share marked", *PROPAGATION_HEADS], propagation_rows(levels, lambda level: share(level["share"])))


def levels_table(levels):
    numbers = {id(level): str(n + 1) for n, level in enumerate(levels)}
    return table(["level", *PROPAGATION_HEADS], propagation_rows(levels, lambda level: numbers[id(level)]))


def partitions_table(partitions):
    methods = list(partitions[0]["methods"])
    rows = []
    for case in partitions:
        of = case["methods"]
        rows.append([f"{case['kind']}", str(case["parts"]), *(f"{of[m]['links']:.2f}" for m in methods),
                     *(f"{of[m]['vertices']:,.0f}" for m in methods), *(f"{of[m]['balance']:.3f}" for m in methods)])
    return table(["mesh", "parts", f"cut links, %: {methods[0]}", *methods[1:],
                  f"shared vertices: {methods[0]}", *methods[1:],
                  f"most cells over mean: {methods[0]}", *methods[1:]], rows)


def synchronisation_table(cases):
    rows = []
    for case in cases:
        ways = case["ways"]
        rows.append([case["kind"], str(case["ranks"]),
                     *(f"{ways[w][key]:,}" for key in ("rounds", "messages", "bytes", "most_bytes")
                       for w in ("neighbour", "gateway"))])
    return table(["mesh", "ranks", "rounds: neighbour", "gateway", "messages: neighbour", "gateway",
                  "bytes: neighbour", "gateway", "of the busiest rank: neighbour", "gateway"], rows)


def speed_table(cases):
    rows = []
    for case in cases:
        seconds = case["seconds"]
        one = seconds["1"]["median"]
        rows.append([case["mesh"], count(case["cells"][0]), count(case["cells"][-1]),
                     *(f"{1000 * of['median']:.0f} ({1000 * of['least']:.0f} to {1000 * of['most']:.0f})"
                       for of in seconds.values()),
                     *(f"{one / of['median']:.2f}" for ranks, of in seconds.items() if ranks != "1")])
    ranks = list(cases[0]["seconds"])
    return table(["mesh", "cells", "to cells", f"ms on {ranks[0]} rank", *ranks[1:],
                  f"faster on {ranks[1]}", *ranks[2:]], rows)


def machine_words(machine):
    return (f"{', '.join(known(machine))}; other programs kept {machine['load']:.1f} cores busy when it began. Medians of "
            f"{machine['repetitions']} runs in turns (least to most)")
