"""Charts as SVG elements; page.css defines the colours of the classes."""

from html import escape

def text(x, y, words, anchor="middle", kind="label"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" class="{kind}">'
            f"{escape(words)}</text>")


def line(x1, y1, x2, y2, kind):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" class="{kind}"/>'


def bar(x, top, width, height, kind, hint=""):
    """A rectangle with a tooltip."""
    title = f"<title>{escape(hint)}</title>" if hint else ""
    return (f'<rect x="{x:.1f}" y="{top:.1f}" width="{width:.1f}" height="{max(height, 0):.1f}" '
            f'class="{kind}">{title}</rect>')


def path(points, kind):
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{corners}" class="{kind}"/>'


def round_steps(highest, about=4):
    """Marks from 0 to at least `highest`, at intervals of 1, 2, 2.5 or 5 times a power of ten."""
    if highest <= 0:
        return [0.0, 1.0]
    rough = highest / about
    power = 1.0
    while power > rough:
        power /= 10
    while power * 10 <= rough:
        power *= 10
    step = next(power * factor for factor in (1, 2, 2.5, 5, 10) if power * factor >= rough)
    steps = [0.0]
    while steps[-1] < highest * (1 - 1e-9):
        steps.append(steps[-1] + step)
    return steps


class Frame:
    """The area of a chart between its axes; `parts` collects its elements. The y axis ranges from 0
    to a round number that is at least `highest`."""

    def __init__(self, width, height, highest, left=52, top=26, bottom=40, right=18):
        self.width, self.height = width, height
        self.left, self.right = left, width - right
        self.top, self.bottom = top, height - bottom
        self.steps = round_steps(highest)
        self.parts = []

    def y(self, value):
        return self.bottom - (self.bottom - self.top) * value / self.steps[-1]

    def x(self, share):
        """The position of a fraction, 0 to 1, of the width between the axes."""
        return self.left + (self.right - self.left) * share

    def y_axis(self, unit):
        for step in self.steps:
            self.parts.append(line(self.left, self.y(step), self.right, self.y(step), "grid"))
            self.parts.append(text(self.left - 6, self.y(step) + 4, f"{step:g}", "end"))
        anchor = "end" if len(unit) < 7 else "middle"  # longer ones would leave the drawing
        self.parts.append(text(self.left - 6, self.top - 12, unit, anchor))

    def x_title(self, words):
        self.parts.append(text((self.left + self.right) / 2, self.height - 6, words))

    def svg(self, label):
        """`label` describes the chart for screen readers."""
        return (f'<svg viewBox="0 0 {self.width} {self.height}" role="img" '
                f'aria-label="{escape(label)}" width="{self.width}">'
                + "".join(self.parts) + "</svg>")


def legend(entries):
    """A line of coloured squares with labels; entries are (class, label)."""
    keys = "".join(f'<span><svg viewBox="0 0 10 10" class="key"><rect width="10" height="10" '
                   f'class="{kind}"/></svg>{escape(words)}</span>' for kind, words in entries)
    return f'<p class="legend">{keys}</p>'
