"""LogGP (Alexandrov, Ionescu, Schauser, Scheiman 1995) with reductions: the seconds of one stage on
P ranks are

    computing(cells of a rank) + messages * 2 o + collective calls * (L + reduction(P)) + bytes * G

where each quantity is the maximum over the ranks, as if one rank had all maxima.
"""
import dataclasses
import math


@dataclasses.dataclass(frozen=True)
class Network:
    """The parameters of a cluster, in seconds."""
    latency: float       # L
    overhead: float      # o, of a message at each end
    byte: float          # G of a node's link, times the ranks that share it
    reduction: float     # of one number over 1,024 ranks


RANKS_OF_A_NODE = 64
LOW = Network(1.0e-6, 0.3e-6, 0.1e-9 * RANKS_OF_A_NODE, 15e-6)
HIGH = Network(1.5e-6, 0.5e-6, 0.1e-9 * RANKS_OF_A_NODE, 25e-6)


def between(points, x):
    """Interpolates (x, y) between the points adjacent to x, in logarithms; extrapolates in
    proportion to x."""
    points = sorted(points)
    if x >= points[-1][0]:
        return points[-1][1] * x / points[-1][0]
    if x <= points[0][0]:
        return points[0][1] * x / points[0][0]
    k = next(i for i in range(1, len(points)) if x <= points[i][0])
    (x0, y0), (x1, y1) = points[k - 1], points[k]
    return y0 * (x / x0) ** (math.log(y1 / y0) / math.log(x1 / x0))


def with_ranks(points, ranks):
    """Interpolates between measurements by the logarithm of ranks; extrapolates from the last two."""
    points = sorted(points)
    k = next((i for i in range(1, len(points) - 1) if ranks <= points[i][0]), len(points) - 1)
    (n0, y0), (n1, y1) = points[k - 1], points[k]
    return y0 + (y1 - y0) * math.log(ranks / n0) / math.log(n1 / n0)


class Stage:
    """The measurements of a stage in the runs of one case, as functions of ranks, or of the cells
    of a rank."""

    def __init__(self, runs, stage, alone=()):
        """`alone`: runs of one rank whose mesh is as large as a part, for the cost of a part
        without shared caches."""
        def points(x, key, least_ranks):
            return [(x(run), run[stage][key]) for run in runs if run["ranks"] >= least_ranks]

        self._computing = points(lambda run: run["cells"] / run["ranks"], "computing_seconds", 1)
        if alone:
            own_caches = [run for run in runs if run["ranks"] == 1] + list(alone)
            self._computing = [(run["cells"], run[stage]["computing_seconds"]) for run in own_caches]
        self._bytes = points(lambda run: run["cells"] / run["ranks"], "bytes", 4)
        self._messages = points(lambda run: run["ranks"], "messages", 4)
        self._calls = points(lambda run: run["ranks"], "collectives", 4)

    def computing(self, cells):
        return between(self._computing, cells)

    def seconds_of_a_cell(self):
        """The best time measured with half a million cells per rank or more."""
        return min(y / x for x, y in self._computing if x >= 5e5)

    def messages(self, ranks):
        """Extrapolates beyond the measurements by the last power of ranks."""
        most = max(n for n, _ in self._messages)
        if ranks <= most:
            return with_ranks(self._messages, ranks)
        before, last = sorted(self._messages)[-2:]
        return last[1] * (ranks / most) ** (math.log(last[1] / before[1]) / math.log(most / before[0]))

    def seconds(self, cells, ranks, network, faster=1):
        """The seconds of a rank with this number of cells; `faster` is the speed of processors
        relative to those measured."""
        if ranks == 1:
            return self.computing(cells) / faster
        reduction = network.reduction * math.log2(ranks) / 10
        return (self.computing(cells) / faster
                + self.messages(ranks) * 2 * network.overhead
                + with_ranks(self._calls, ranks) * (network.latency + reduction)
                + between(self._bytes, cells) * network.byte)


def weak_efficiency(stage, cells, ranks, network, faster=1):
    """Relative to one rank with as many cells, which sends nothing."""
    return stage.computing(cells) / faster / stage.seconds(cells, ranks, network, faster)


def strong_efficiency(stage, cells, ranks, network):
    """Relative to one rank with all cells, at the best time per cell."""
    return stage.seconds_of_a_cell() * cells / ranks / stage.seconds(cells / ranks, ranks, network)
