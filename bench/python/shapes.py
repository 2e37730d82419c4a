"""Dihedral angles while cells marked at random are refined, by three programs: shapes.py measure
FILE.json [--steps N], shapes.py draw FILE.json OUT.svg, on one rank.

Each step marks 1.5 % of the cells at random, but at least one and at most 100, and refines them: by
Octetra with the longest-edge and with the regular closure, and by DOLFINx's refine(). The number of
marks is that of each program's own mesh. All angles are computed by the same function. `draw` also
prints the tables of docs/shapes.md. Requires octetra in the path.
"""

import argparse
import itertools
import json
import pathlib
import subprocess
import tempfile

import numpy as np

MESHES = {"kuhn 2": ["kuhn", "2"], "gear": ["gear"], "random 200": ["random", "200"]}
WAYS = {"longest-edge": "#b3541e", "regular": "#0072b2", "DOLFINx": "#5b8c3a"}
MOST_MARKS = 100


# ---- measure ---------------------------------------------------------------------------------------


def extreme_angles(points, cells):
    """The least and the greatest dihedral angle, in degrees."""
    corners = points[cells]
    least, greatest = 180.0, 0.0
    for i, j in itertools.combinations(range(4), 2):
        k, m = sorted({0, 1, 2, 3} - {i, j})
        edge = corners[:, j] - corners[:, i]
        sides = [np.cross(edge, corners[:, n] - corners[:, i]) for n in (k, m)]
        across = np.linalg.norm(np.cross(*sides), axis=1)
        angles = np.degrees(np.arctan2(across, np.einsum("ij,ij->i", *sides)))
        least, greatest = min(least, angles.min()), max(greatest, angles.max())
    return least, greatest


class ByOctetra:
    def __init__(self, path, closure):
        import octetra

        self.mesh = octetra.read(path)
        self.closure = closure

    def arrays(self):
        return self.mesh.points, self.mesh.cells

    def refine(self, marks):
        self.mesh.refine(marks, closure=self.closure)


class ByDolfinx:
    def __init__(self, path):
        import octetra
        from lattice import created

        self.domain = created(octetra.read(path))()

    def arrays(self):
        from octetra.dolfinx._versions import nodes_of_cells

        return self.domain.geometry.x, nodes_of_cells(self.domain)

    def refine(self, marks):
        import dolfinx.mesh
        from lattice import IS_0_5

        topology = self.domain.topology
        topology.create_entities(1)
        cells = np.flatnonzero(marks).astype(np.int32)
        if IS_0_5:
            edges = dolfinx.mesh.compute_incident_entities(self.domain, cells, 3, 1)
            self.domain = dolfinx.mesh.refine(self.domain, edges, redistribute=False)
        else:
            topology.create_connectivity(3, 1)
            edges = dolfinx.mesh.compute_incident_entities(topology, cells, 3, 1)
            self.domain = dolfinx.mesh.refine(self.domain, edges)[0]


def run(program, steps):
    """The cells, least and greatest angle at the beginning and after each step."""
    random = np.random.default_rng(1)
    rows = []
    for step in range(steps + 1):
        points, cells = program.arrays()
        rows.append([len(cells), *map(float, extreme_angles(points, cells))])
        if step == steps:
            return rows
        count = max(1, min(MOST_MARKS, int(0.015 * len(cells))))
        marks = np.zeros(len(cells), bool)
        marks[random.choice(len(cells), count, replace=False)] = True
        del points, cells
        program.refine(marks)


def measure(steps):
    import octetra

    measured = {}
    for name, words in MESHES.items():
        with tempfile.TemporaryDirectory() as folder:
            path = str(pathlib.Path(folder) / "input.mesh")
            subprocess.run(["octetra", "generate", *words, "-o", path, "--quiet"], check=True)
            certificate = octetra.read(path).certify_shapes()
            bounds = [certificate.bounds[key] for key in ("min_dihedral", "max_dihedral")]
            measured[name] = {"bounds": bounds, "closed": certificate.closed}
            for way in WAYS:
                program = ByDolfinx(path) if way == "DOLFINx" else ByOctetra(path, way)
                measured[name][way] = run(program, steps)
                print(name, way, measured[name][way][-1], flush=True)
    return measured


# ---- draw ------------------------------------------------------------------------------------------

WIDTH, HEIGHT, LEFT, TOP, GAP = 250, 260, 44, 36, 46


def panel(left, name, runs):
    steps = len(runs["regular"]) - 1

    def at(step, angle):
        return f"{left + WIDTH * step / steps:.1f},{TOP + HEIGHT * (1 - angle / 180):.1f}"

    yield f'<text x="{left}" y="{TOP - 12}" font-size="14">{name}</text>'
    for angle in range(0, 181, 30):
        y = at(0, angle).split(",")[1]
        yield f'<path d="M{left},{y}h{WIDTH}" stroke="#d9dde3"/>'
        yield f'<text x="{left - 6}" y="{float(y) + 4:.1f}" text-anchor="end">{angle}</text>'
    for step in range(0, steps + 1, 10):
        x = at(step, 0).split(",")[0]
        yield f'<text x="{x}" y="{TOP + HEIGHT + 18}" text-anchor="middle">{step}</text>'
    yield f'<text x="{left + WIDTH / 2}" y="{TOP + HEIGHT + 36}" text-anchor="middle">steps</text>'
    for bound in runs["bounds"]:
        yield f'<path d="M{at(0, bound)} L{at(steps, bound)}" stroke="#21262f" stroke-dasharray="4 3"/>'
    for way, colour in WAYS.items():
        for angle in (1, 2):
            points = " ".join(at(step, row[angle]) for step, row in enumerate(runs[way]))
            yield f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>'


def drawing(measured):
    width = len(measured) * (WIDTH + GAP) + LEFT
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {TOP + HEIGHT + 70}" width="{width}" '
           f'height="{TOP + HEIGHT + 70}" font-family="sans-serif" font-size="12">')
    yield "<title>Least and greatest dihedral angle, in degrees, over steps that mark cells at random</title>"
    yield '<rect width="100%" height="100%" fill="white"/>'
    for number, (name, runs) in enumerate(measured.items()):
        yield from panel(LEFT + number * (WIDTH + GAP), name, runs)
    entries = [*WAYS.items(), ("proved bounds of the regular closure (dashed)", "#21262f")]
    for number, (way, colour) in enumerate(entries):
        yield f'<text x="{LEFT + 120 * number}" y="{TOP + HEIGHT + 60}" fill="{colour}">&#9632; {way}</text>'
    yield "</svg>\n"


def print_table(measured):
    print("| mesh | | longest-edge | regular | DOLFINx | proved bounds |\n|---|---|---:|---:|---:|---:|")
    for name, runs in measured.items():
        bounds = "{:.3g} to {:.4g}".format(*runs["bounds"]) if runs["closed"] else "open"
        angles = (f"{runs[way][-1][1]:.3g} to {runs[way][-1][2]:.4g}" for way in WAYS)
        print(f"| `{name}` | angles |", " | ".join(angles), f"| {bounds} |")
        print("| | cells |", " | ".join(f"{runs[way][-1][0]:,}" for way in WAYS), "| |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("measure", "draw"))
    parser.add_argument("measured", type=pathlib.Path)
    parser.add_argument("drawing", type=pathlib.Path, nargs="?")
    parser.add_argument("--steps", type=int, default=30)
    given = parser.parse_args()
    if given.command == "measure":
        given.measured.write_text(json.dumps(measure(given.steps)) + "\n", encoding="utf-8")
        return
    measured = json.loads(given.measured.read_text(encoding="utf-8"))
    given.drawing.write_text("\n".join(drawing(measured)), encoding="utf-8")
    print_table(measured)


if __name__ == "__main__":
    main()
