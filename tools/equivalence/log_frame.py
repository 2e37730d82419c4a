"""A chart with logarithmic axes, on which powers are straight lines; the x axis may be linear."""

import math

from charts import Frame, line, text


def steps(lowest, highest):
    """Powers of ten from at most `lowest` to at least `highest`; if there are at most two decades,
    also 2 and 5 times those as needed."""
    low, high = math.floor(math.log10(lowest) + 1e-9), math.ceil(math.log10(highest) - 1e-9)
    if high - low > 2:
        return [10.0 ** power for power in range(low, high + 1)]
    every = [factor * 10.0 ** power for power in range(low, high + 1) for factor in (1, 2, 5)]
    first = max(i for i, step in enumerate(every) if step <= lowest * (1 + 1e-9))
    last = min(i for i, step in enumerate(every) if step >= highest * (1 - 1e-9))
    return every[first:max(last, first + 1) + 1]


def place(value, marks):
    """From 0 at the first mark to 1 at the last."""
    low, high = math.log(marks[0]), math.log(marks[-1])
    return (math.log(value) - low) / (high - low)


class LogFrame(Frame):
    """`x_marks` are the labelled marks of the x axis; without them, round steps."""

    def __init__(self, xs, ys, x_marks=None, plain_x=False):
        super().__init__(530, 280, 1, left=66)
        self.plain_x = plain_x
        self.x_marks = x_marks or steps(min(xs), max(xs))
        self.y_marks = steps(min(ys), max(ys))

    def x_of(self, value):
        low, high = self.x_marks[0], self.x_marks[-1]
        if low == high:
            share = 0.5
        elif self.plain_x:
            share = (value - low) / (high - low)
        else:
            share = place(value, self.x_marks)
        return self.x(0.04 + 0.92 * share)

    def y_of(self, value):
        return self.bottom - (self.bottom - self.top) * place(value, self.y_marks)

    def axes(self, x_title, y_unit, x_words, y_words):
        """`x_words` and `y_words` format the marks."""
        for mark in self.y_marks:
            self.parts.append(line(self.left, self.y_of(mark), self.right, self.y_of(mark), "grid"))
            self.parts.append(text(self.left - 6, self.y_of(mark) + 4, y_words(mark), "end"))
        for mark in self.x_marks:
            self.parts.append(text(self.x_of(mark), self.bottom + 16, x_words(mark)))
        self.parts.append(text(4, self.top - 12, y_unit, "start"))
        self.x_title(x_title)
