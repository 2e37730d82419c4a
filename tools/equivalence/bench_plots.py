"""The plots of bench/results.json: growth of cost, and DOLFINx compared with octetra."""

from html import escape

from charts import Frame, bar, path, text
from log_frame import LogFrame
from words import count, seconds, size


def short(number):
    """10000 as 10 k; marks of axes are round numbers."""
    for unit, name in ((1e9, " G"), (1e6, " M"), (1e3, " k")):
        if number >= unit:
            return f"{number / unit:g}{name}"
    return f"{number:g}"


def short_seconds(value):
    return f"{value:g} s" if value >= 1 else f"{1e3 * value:g} ms" if value >= 1e-3 else (
        f"{1e6 * value:g} µs")


def curve(frame, points, kind, hints):
    """A line through points (x, y), with a tooltip at each."""
    places = [(frame.x_of(x), frame.y_of(y)) for x, y in points]
    frame.parts.append(path(places, f"curve {kind}"))
    frame.parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" class="dot {kind}">'
                    f"<title>{escape(hint)}</title></circle>"
                    for (x, y), hint in zip(places, hints)]


def plot(points, x, y, kind, words, x_marks=None, plain_x=False, proportion=False):
    """One curve of points[x], points[y]. `words`: the titles of the axes (`x`, `y`), and the
    formats of their numbers (`x_words`, `y_words`) and of those in tooltips (`x_hint`, `y_hint`).
    `proportion` adds a dashed line through the last point, to which proportional growth is
    parallel."""
    pairs = [(point[x], point[y]) for point in points]
    frame = LogFrame([a for a, _ in pairs], [b for _, b in pairs], x_marks, plain_x)
    frame.axes(words["x"], words["y"], words["x_words"], words["y_words"])
    if proportion:
        frame.parts.append(path(in_proportion(frame, pairs[-1]), "even"))
    hints = [f"{words['x_hint'](a)}: {words['y_hint'](b)}" for a, b in pairs]
    curve(frame, pairs, kind, hints)
    return frame.svg(f"{words['y']}, over {words['x']}")


def in_proportion(frame, last):
    """A line from the last point down to an edge of the frame, with slope 1."""
    x, y = last
    factor = min(x / frame.x_marks[0], y / frame.y_marks[0])
    return [(frame.x_of(x / factor), frame.y_of(y / factor)), (frame.x_of(x), frame.y_of(y))]


def cells(number):
    return f"{count(number)} cells"


CELLS = {"x": "cells of the result", "x_words": short, "x_hint": cells}
RANKS = {"x": "ranks", "x_words": str, "x_hint": lambda n: f"{n} ranks"}
LEVELS = {"x": "level", "x_words": str, "x_hint": lambda n: f"level {n}"}
TIME = {"y": "processor time", "y_words": short_seconds, "y_hint": seconds}
BYTES = {"y_words": lambda n: short(n) + "B", "y_hint": size}


def time_by_cells(points):
    return plot(points, "cells", "processor_seconds", "refining_seconds", {**CELLS, **TIME},
                proportion=True)


def memory_by_cells(points):
    return plot(points, "cells", "peak_bytes", "seconds",
                {**CELLS, **BYTES, "y": "peak memory"}, proportion=True)


def time_by_ranks(points):
    return plot(points, "ranks", "processor_seconds_of_rank", "refining_seconds",
                {**RANKS, **TIME, "y": "processor time of a rank"},
                [point["ranks"] for point in points])


def bytes_by_ranks(points):
    """One rank sends no bytes, which have no logarithm."""
    sending = [point for point in points if point["bytes"] > 0]
    return plot(sending, "ranks", "bytes", "seconds",
                {**RANKS, **BYTES, "y": "bytes sent, all ranks"},
                [point["ranks"] for point in sending])


def time_by_level(points):
    return plot(points, "level", "processor_seconds", "refining_seconds", {**LEVELS, **TIME},
                [point["level"] for point in points], plain_x=True)


def speeds(points):
    """Labelled bars for cells of the result per second; octetra's have one colour, others another
    one."""
    rates = [point["cells_a_second"] * 1e-6 for point in points]
    frame = Frame(530, 280, max(rates))
    frame.y_axis("")
    frame.parts.append(text(4, frame.top - 12, "million cells a second", "start"))
    wide = (frame.right - frame.left) / len(points)
    for i, (point, rate) in enumerate(zip(points, rates)):
        left, top = frame.left + wide * i, frame.y(rate)
        kind = "computing" if point["name"].startswith("octetra") else "seconds"
        frame.parts.append(bar(left + 0.2 * wide, top, 0.6 * wide, frame.bottom - top, kind,
                               f"{point['name']}: {rate:.3g} million cells a second"))
        frame.parts.append(text(left + wide / 2, top - 5, f"{rate:.3g}"))
        frame.parts.append(text(left + wide / 2, frame.bottom + 16, point["name"]))
    return frame.svg("Cells of the result a second, by program and ranks")
