"""Cases and their measurement."""

import json
import os
import shlex
import statistics
from collections.abc import Callable
from dataclasses import dataclass, field

from running import TOO_LONG, Failure, must, printed, run

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


@dataclass(frozen=True)
class Place:
    build: str  # folder of the programs
    folder: str  # folder of the files of cases

    def built(self, name, kind=os.F_OK):
        path = os.path.join(self.build, name)
        if not os.access(path, kind):
            raise Failure(f"{path} does not exist: build it first")
        return path

    def program(self, name):
        return self.built(name, os.X_OK)

    def mesh(self, shape, name):
        """The file of a generated mesh, which is made on the first call."""
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            must([self.program("cli/octetra"), "generate", *shape.split(), "--quiet", "-o", path],
                 self.folder)
        return path


@dataclass(frozen=True)
class Run:
    """One of the programs that a case runs in turns. `line` runs it once and returns a dictionary
    of its measurements."""
    name: str
    line: Callable[[Place], dict]
    command: str = ""


@dataclass(frozen=True)
class Figure:
    """A result of a case. A target is an upper (or lower) bound on the value. `spread`: the minimum
    and the maximum of the runs whose median is the value."""
    name: str
    value: float
    unit: str
    at_most: float = None
    at_least: float = None
    spread: tuple = None

    def as_dict(self):
        made = {"name": self.name, "value": self.value, "unit": self.unit}
        if self.spread is not None:
            made |= {"least": self.spread[0], "most": self.spread[1]}
        if self.at_most is not None:
            made |= {"at_most": self.at_most, "met": self.value <= self.at_most}
        if self.at_least is not None:
            made |= {"at_least": self.at_least, "met": self.value >= self.at_least}
        return made


@dataclass(frozen=True)
class Case:
    """`figures` receives the lines of each run by name, as do `points`, which returns a list of
    dictionaries to be plotted over an axis, and `wrong`, which returns descriptions of faults.
    Cases with short runs have a multiple of the repetitions, those with long runs a maximum."""
    name: str
    runs: list
    figures: Callable[[dict], list]
    points: Callable[[dict], list] = field(default=lambda lines: [])
    wrong: Callable[[dict], list] = field(default=lambda lines: [])
    multiple: int = 1
    at_most: int = 1000


@dataclass(frozen=True)
class Group:
    name: str
    about: str
    cases: list

    def of(self, cases):
        return Group(self.name, self.about, cases)


BEGUN_AGAIN = "begun_again"


def has_crashed(outcome):
    """Returns whether the program crashed, by a signal or an MPI error, rather than reporting an
    error itself."""
    return not 0 <= outcome.status <= 128 or "*** An error occurred in MPI_" in outcome.err


def printed_by(command, folder, patience=None):
    """Returns the output of a command, and the number of restarts. With `patience`, a program that
    sometimes hangs or crashes is ended after this number of seconds and restarted up to five times.
    """
    if patience is None:
        return must(command, folder), 0
    for times in range(6):
        outcome = run(command, folder, patience)
        if outcome.status != TOO_LONG and not has_crashed(outcome):
            break
    return printed(command, outcome), times


def launcher(ranks):
    """The prefix of a command on this number of ranks."""
    return ["mpirun", "-n", str(ranks)] if ranks > 1 else []


def driver(name, program, arguments, ranks=1, mesh=None, patience=None):
    """A run of a driver that prints JSON. `mesh`, a shape and a file name, is generated first and
    is the first argument. With `patience`, see printed_by(), the line contains the number of
    restarts."""
    def line(place):
        first = [place.mesh(*mesh)] if mesh else []
        command = [*launcher(ranks), place.program(program), *first, *shlex.split(arguments)]
        words, times = printed_by(command, place.folder, patience)
        try:
            return json.loads(words) | ({BEGUN_AGAIN: times} if patience else {})
        except ValueError as error:
            raise Failure(f"{program} printed no JSON:\n{words[-300:]}") from error

    words = [f"mpirun -n {ranks}"] if ranks > 1 else []
    words += [program, *([f"({mesh[0]})"] if mesh else []), arguments]
    return Run(name, line, " ".join(words))


def script(name, path, arguments, ranks=1, patience=None):
    """The same for a driver in Python, with the module of the build."""
    def line(place):
        place.built("python/octetra/__init__.py")
        command = ["env", "PYTHONPATH=" + os.path.join(place.build, "python"), *launcher(ranks),
                   "/usr/bin/python3", os.path.join(ROOT, path), *shlex.split(arguments), "--json"]
        words, times = printed_by(command, place.folder, patience)
        try:
            # DOLFINx may print messages about forms that it compiles.
            return json.loads(words.splitlines()[-1]) | ({BEGUN_AGAIN: times} if patience else {})
        except (ValueError, IndexError) as error:
            raise Failure(f"{path} printed no JSON:\n{words[-300:]}") from error

    words = [f"mpirun -n {ranks}"] if ranks > 1 else []
    return Run(name, line, " ".join([*words, "python3", path, arguments]))


def measure(case, place, repetitions):
    """Measures a case: its runs, their numbers and the resulting figures. The output of runs is not
    kept: the figures have its medians, minima and maxima."""
    lines = {run.name: [] for run in case.runs}
    for _ in range(min(case.multiple * repetitions, case.at_most)):
        for one in case.runs:
            lines[one.name].append(one.line(place))
    return {"name": case.name,
            "runs": [{"name": one.name, "command": one.command, "times": len(lines[one.name])}
                     for one in case.runs],
            "figures": [figure.as_dict() for figure in case.figures(lines)],
            "points": case.points(lines), "wrong": case.wrong(lines)}


def inside(line, keys):
    """The number under these keys."""
    for key in keys:
        line = line[key]
    return line


def median(lines, *keys):
    """The median of the number under these keys over all lines."""
    return statistics.median(inside(line, keys) for line in lines)


def spread_figure(name, unit, lines, *keys):
    """The median of that number, with the minimum and the maximum."""
    values = [inside(line, keys) for line in lines]
    return Figure(name, statistics.median(values), unit, spread=(min(values), max(values)))


def median_ratio(lines, by_lines, *keys):
    """The median ratio of that number to the one in the line of the same turn: temporary load
    mostly slows both."""
    return statistics.median(inside(line, keys) / inside(by_line, keys)
                             for line, by_line in zip(lines, by_lines, strict=True))
