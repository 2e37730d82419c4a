"""Evaluates the queries in the sentences of docs/rival.md, such as "added 8t/terminal edges,volumes
random,gear".

A query names the quantity; one method, or two, where the first is given in units of the second;
then, in any order, the meshes, goals and ranks to which it is restricted. Goals are "edges" or,
more precisely, "edges/8", and "-region" excludes those with a region.
"""
# Up to the goal. The copying of results at the end of the rival is excluded, because octetra does
# not copy.
SECONDS = ("setup_seconds", "marking_seconds", "refining_seconds")
SIZES = {"edge": ("edges", 2), "once": ("once", 1), "volume": ("volumes", 8)}


def added(run):
    return run["cells"] - run["input_cells"]


def refining_nanoseconds(run):
    return 1e9 * run["refining_seconds"] / max(1, added(run))


def rounds(run):
    return run["levels"] if "levels" in run else run["rounds"]


def milliseconds(run):
    return 1000 * sum(run[key] for key in SECONDS)


OF_ONE = {"added": added, "outside": lambda run: run["cells_added_outside"], "ns": refining_nanoseconds,
          "ms": milliseconds, "setup": lambda run: 1000 * run["setup_seconds"], "rounds": rounds}
ON_RANKS = {"exchanges": lambda run: run["rounds"], "messages": lambda run: run["messages"],
            "kB": lambda run: run["bytes"] / 1000}
UNITS = {"setup": milliseconds}  # finding neighbours, relative to the other method's whole time


def names_of(case):
    """All words that restrict a query to this case."""
    task, halvings, local = case["goal"]
    kind, base = SIZES[task]
    names = {case["mesh"], kind, f"{kind}/{base ** halvings}", "-region" if not local else "region"}
    return names | ({f"{case['ranks']}-ranks"} if "ranks" in case else set())


def figures_of(measured, query):
    quantity, methods, *filters = query.split()
    figure = OF_ONE.get(quantity) or ON_RANKS[quantity]
    of, _, over = methods.partition("/")
    found = []
    for case in measured["cases" if quantity in OF_ONE else "ranks"]:
        if quantity == "outside" and not case["goal"][2]:
            continue
        if not all(set(words.split(",")) & names_of(case) for words in filters):
            continue
        value = figure(case["methods"][of])
        unit = UNITS.get(quantity, figure)(case["methods"][over]) if over else 1
        if value or unit:  # zero relative to zero is omitted
            found.append(value / unit)
    return found
