"""What the sentences of docs/rival.md ask for: "added 8t/terminal edges,volumes random,gear", and the like.

First the quantity; then one method, or two of which the first is told in units of the second; then, in any order, the
meshes, the goals and the ranks to which it is confined. Goals are "edges" or, more closely, "edges/8", and "-region"
leaves those that have one.
"""
# To the goal. Copying a result out, as the rival does at the end, is none of it: octetra's stays where it is.
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
UNITS = {"setup": milliseconds}  # finding neighbours first, beside the other's whole way to the goal


def names_of(case):
    """Every word by which a query may confine itself to this case."""
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
        if value or unit:  # none of either says nothing
            found.append(value / unit)
    return found
