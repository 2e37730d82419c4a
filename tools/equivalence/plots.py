"""The plots of the report."""

from charts import Frame, bar, line, path, text
from words import count, seconds

# The steps of the paper's algorithm, and the phases of a profile that constitute each.
STEPS = [
    ("partition,|distribute", ("partition", "distribute", "interfaces")),
    ("select,|local LEPP", ("number edges", "select", "closure")),
    ("synchronise", ("synchronise",)),
    ("bisect edges", ("bisect edges",)),
    ("bisect|tetrahedra", ("bisect tetrahedra",)),
    ("number,|collect", ("number vertices", "collect")),
    ("read, write", ("read", "write")),
]


def shares(histogram):
    total = sum(histogram["counts"]) or 1
    return [100 * number / total for number in histogram["counts"]]


def outline(frame, values):
    """The outline of a histogram, as points."""
    points = [(frame.x(0), frame.y(0))]
    for i, value in enumerate(values):
        points += [(frame.x(i / len(values)), frame.y(value)),
                   (frame.x((i + 1) / len(values)), frame.y(value))]
    return points + [(frame.x(1), frame.y(0))]


def histogram(before, after, title, unit, marks):
    """Two histograms with the same bins, superimposed, in per cent; `marks` are the labels of the
    axis."""
    old, new = shares(before), shares(after)
    frame = Frame(530, 250, max(old + new))
    frame.y_axis("%")
    frame.parts.append(path(outline(frame, old), "before area"))
    frame.parts.append(path(outline(frame, new), "after outline"))
    low, high = before["low"], before["high"]
    for mark in marks:
        frame.parts.append(text(frame.x((mark - low) / (high - low)), frame.bottom + 16,
                                f"{mark:g}{unit}"))
    frame.x_title(title)
    return frame.svg(f"Histogram of {title}, before and after")


def dihedral_angles(case):
    return histogram(case["before"]["dihedral_histogram"], case["after"]["dihedral_histogram"],
                     "dihedral angle", "°", range(0, 181, 30))


def mean_ratios(case):
    return histogram(case["before"]["eta_histogram"], case["after"]["eta_histogram"],
                     "mean ratio η of a cell (1: regular)", "", (0, 0.2, 0.4, 0.6, 0.8, 1))


# --- by rank


def cells_per_rank(cells_of_rank):
    """Bars for the cells of each rank, before and after; the line is the mean."""
    first, last = cells_of_rank[0], cells_of_rank[-1]
    ranks = len(last)
    of_first, of_last = ([100 * c / sum(level) for c in level] for level in (first, last))
    frame = Frame(70 + 80 * ranks, 210, max(of_first + of_last))
    frame.y_axis("% of cells")
    wide = (frame.right - frame.left) / ranks
    for rank in range(ranks):
        left = frame.left + wide * rank
        for place, values, cells, kind in ((0.14, of_first, first, "before"),
                                           (0.51, of_last, last, "after")):
            top = frame.y(values[rank])
            frame.parts.append(bar(left + place * wide, top, 0.35 * wide, frame.bottom - top, kind,
                                   f"rank {rank}, {kind}: {count(cells[rank])} cells"))
        frame.parts.append(text(left + wide / 2, frame.bottom + 16, str(rank)))
    even = frame.y(100 / ranks)
    frame.parts.append(line(frame.left, even, frame.right, even, "even"))
    frame.x_title("rank")
    return frame.svg(f"Fraction of the cells on each of {ranks} ranks, before and after")


def neighbour_runs(case):
    return [run for run in case["runs"] if run["sync"] == "neighbour" and run["figures"]]


def step_seconds(run, phases):
    """Seconds that a run spent computing and communicating in these phases."""
    found = [run["figures"]["phases"][phase] for phase in phases
             if phase in run["figures"]["phases"]]
    return (sum(f["computing"] for f in found), sum(f["communicating"] for f in found))


def phases(case):
    """As in the paper's Figure 10: for each step, a bar for each number of ranks, computing below
    communicating."""
    runs = neighbour_runs(case)
    heights = [[step_seconds(run, of) for run in runs] for _, of in STEPS]
    highest = max(sum(h) for step in heights for h in step)
    unit, of_second = ("s", 1) if highest >= 1 else ("ms", 1000)
    frame = Frame(1100, 320, of_second * highest, bottom=66)
    frame.y_axis(unit)
    wide = (frame.right - frame.left) / len(STEPS)
    one = 0.8 * wide / len(runs)
    for i, (name, _) in enumerate(STEPS):
        for j, run in enumerate(runs):
            left = frame.left + wide * i + 0.1 * wide + one * j
            phase_bars(frame, left, one, heights[i][j], of_second,
                       f"{run['ranks']} ranks, {name.replace('|', ' ')}")
            frame.parts.append(text(left + one / 2, frame.bottom + 14, str(run["ranks"]),
                                    kind="label small"))
        for row, words in enumerate(name.split("|")):
            frame.parts.append(text(frame.left + wide * (i + 0.5), frame.bottom + 34 + 15 * row,
                                    words))
    return frame.svg("Seconds computing and communicating in every step, on 1 to 4 ranks")


def phase_bars(frame, left, wide, height, of_second, hint):
    computing, communicating = (of_second * h for h in height)
    middle, top = frame.y(computing), frame.y(computing + communicating)
    frame.parts.append(bar(left + 1.5, middle, wide - 3, frame.bottom - middle, "computing",
                           f"{hint}: computing {seconds(height[0])}"))
    frame.parts.append(bar(left + 1.5, top, wide - 3, middle - top, "communicating",
                           f"{hint}: communicating {seconds(height[1])}"))


# --- over the number of ranks


def scaling(case, cores):
    """Speedup over one rank; the background is shaded where ranks outnumber the cores."""
    runs = neighbour_runs(case)
    most = max(run["ranks"] for run in runs)
    curves = [(key, [(run["ranks"], runs[0]["figures"][key] / run["figures"][key])
                     for run in runs]) for key in ("refining_seconds", "seconds")]
    frame = Frame(530, 280, max(most, *(s for _, curve in curves for _, s in curve)))

    def x(ranks):
        return frame.x((ranks - 0.5) / most)

    if cores < most:
        frame.parts.append(bar(x(cores + 0.5), frame.top, frame.right - x(cores + 0.5),
                               frame.bottom - frame.top, "shade"))
        frame.parts.append(text((x(cores + 0.5) + frame.right) / 2, frame.top - 6,
                                "more ranks than cores", kind="label small"))
    frame.y_axis("times")
    frame.parts.append(path([(x(n), frame.y(n)) for n in range(1, min(cores, most) + 1)], "even"))
    for key, curve in curves:
        frame.parts.append(path([(x(n), frame.y(speed)) for n, speed in curve], f"curve {key}"))
        frame.parts += [f'<circle cx="{x(n):.1f}" cy="{frame.y(s):.1f}" r="4" class="dot {key}">'
                        f"<title>{n} ranks: {s:.2f} times as fast as one</title></circle>"
                        for n, s in curve]
    for n in range(1, most + 1):
        frame.parts.append(text(x(n), frame.bottom + 16, str(n)))
    frame.x_title("ranks")
    return frame.svg("Speedup over one rank, by number of ranks")
