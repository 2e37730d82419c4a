"""Evaluates the queries in the sentences of docs/paper.md, such as "partitions links lepp/dual".

A query names the table; a quantity of it; numerator and denominator; and the rows to which it is
restricted.
"""


def ratio(of, words, key=None):
    """The ratio "a/b" of two quantities measured in one run."""
    first, second = (of[word] if key is None else of[word][key] for word in words.split("/"))
    return first / second


def chosen(rows, key, words):
    return rows if words is None else [row for row in rows if str(row[key]) in words.split(",")]


def of_runs(made, quantity):
    assert quantity == "cells_of_vertex"
    return [count["cells"] / count["vertices"] for run in made["runs"] for count in run["counts"][1:]]


def of_propagation(made, tables, quantity, row=None):
    levels = [level for table in tables.split(",") for level in made["propagation"][table]]
    if quantity == "times":  # later levels relative to the first
        times = [level["edges_closed"] / level["edges_marked"] for level in levels]
        return [later / times[0] for later in times[1:]]
    if quantity == "rounds":
        return [rounds for level in levels for rounds in level["rounds"].values()]
    figure = {"sweeps": lambda level: level["sweeps"],
              "cut": lambda level: level["cells_cut"] / level["input_cells"]}[quantity]
    return [figure(level) for level in chosen(levels, "share", row)]


def of_partitions(made, quantity, methods):
    return [ratio(case["methods"], methods, quantity) for case in made["partitions"]]


def of_synchronisation(made, quantity, ways, ranks=None):
    return [ratio(case["ways"], ways, quantity) for case in chosen(made["synchronisation"], "ranks", ranks)]


def of_speed(made, ranks):
    """The speedup over one rank; or, for "a/b", of a ranks over b ranks."""
    first, _, second = ranks.partition("/")
    return [case["seconds"][second or "1"]["median"] / case["seconds"][first]["median"] for case in made["speed"]]


def figures_of(made, query):
    table, *words = query.split()
    if table == "cores":
        return [made["machine"]["cores"]]
    if table in ("shares", "levels", "shares,levels"):
        return of_propagation(made, table, *words)
    return {"runs": of_runs, "partitions": of_partitions, "synchronisation": of_synchronisation,
            "speed": of_speed}[table](made, *words)
