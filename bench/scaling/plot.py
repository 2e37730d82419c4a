"""Efficiency over ranks, as an SVG."""
import math

WIDTH, HEIGHT, LEFT, TOP, GAP = 330, 230, 48, 34, 70
COLOURS = ("#0072b2", "#d55e00", "#009e73")
RANKS = [2 ** k for k in range(2, 15)]


def efficiency_plot(panels, stages, networks):
    shapes = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * (LEFT + WIDTH) + GAP}" '
              f'height="{TOP + HEIGHT + 64}" font-family="sans-serif" font-size="12">',
              '<rect width="100%" height="100%" fill="white"/>']
    for number, (title, efficiency) in enumerate(panels):
        shapes += panel(LEFT + number * (WIDTH + GAP), title, efficiency, stages, networks)
    return "\n".join(shapes + ["</svg>\n"])


def panel(left, title, efficiency, stages, networks):
    def at(ranks, value):
        x = left + WIDTH * math.log2(ranks / RANKS[0]) / math.log2(RANKS[-1] / RANKS[0])
        return f"{x:.1f},{TOP + HEIGHT * (1 - min(value, 1.2) / 1.2):.1f}"

    yield f'<text x="{left}" y="{TOP - 14}" font-size="14">{title}</text>'
    for tenth in range(0, 13, 2):
        y = at(RANKS[0], tenth / 10).split(",")[1]
        yield f'<path d="M{left},{y}h{WIDTH}" stroke="#ddd"/>'
        yield f'<text x="{left - 6}" y="{float(y) + 4}" text-anchor="end">{tenth * 10} %</text>'
    for ranks in RANKS[::2]:
        x = at(ranks, 0).split(",")[0]
        yield f'<text x="{x}" y="{TOP + HEIGHT + 18}" text-anchor="middle">{ranks:,}</text>'
    yield f'<text x="{left + WIDTH / 2}" y="{TOP + HEIGHT + 36}" text-anchor="middle">ranks</text>'
    for number, (name, stage) in enumerate(stages.items()):
        low, high = ([at(n, efficiency(stage, n, network)) for n in RANKS] for network in networks)
        colour = COLOURS[number]
        yield f'<path d="M{" L".join(low + high[::-1])}Z" fill="{colour}" fill-opacity="0.25"/>'
        yield f'<path d="M{" L".join(low)}" fill="none" stroke="{colour}" stroke-width="2"/>'
        yield (f'<text x="{left + 10 + 80 * number}" y="{TOP + HEIGHT + 56}" fill="{colour}">'
               f'&#9632; {name}</text>')
