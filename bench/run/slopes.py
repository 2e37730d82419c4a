"""Growth rates as slopes of logarithms."""

import math


def slope(xs, ys):
    """The slope of the line that fits log y over log x best: 1 if y is proportional to x."""
    u, v = [math.log(x) for x in xs], [math.log(y) for y in ys]
    mean_u, mean_v = sum(u) / len(u), sum(v) / len(v)
    return (sum((a - mean_u) * (b - mean_v) for a, b in zip(u, v))
            / sum((a - mean_u) ** 2 for a in u))


def steepest(xs, ys):
    """The largest slope between adjacent points: a fixed cost, which raises the first points,
    cannot hide a late rise from it."""
    return max(slope(xs[i:i + 2], ys[i:i + 2]) for i in range(len(xs) - 1))
