"""How fast something grows: slopes of logarithms."""

import math


def slope(xs, ys):
    """Of the line that fits log y over log x best: 1 where y grows in proportion to x."""
    u, v = [math.log(x) for x in xs], [math.log(y) for y in ys]
    mean_u, mean_v = sum(u) / len(u), sum(v) / len(v)
    return (sum((a - mean_u) * (b - mean_v) for a, b in zip(u, v))
            / sum((a - mean_u) ** 2 for a in u))


def steepest(xs, ys):
    """The largest slope between neighbouring points. What is paid once, and makes the first points
    high, cannot hide a late rise from it."""
    return max(slope(xs[i:i + 2], ys[i:i + 2]) for i in range(len(xs) - 1))
