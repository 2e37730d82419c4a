"""Compares refinement until a target size with a search by an independent reader of the files: the
cells that the search finds are marked by their numbers.

usage: size_test.py OCTETRA SOURCES
"""
import itertools
import math
import pathlib
import struct
import subprocess
import sys
import unittest

from program_case import ProgramCase, octetra

mpirun = pathlib.Path(sys.argv[2]) / "tests/support/mpirun.sh"


def read_mesh(path):
    """Returns the vertices, and the cells by vertices counted from 0."""
    words = iter(path.read_text().split())
    vertices, cells = [], []
    for word in words:
        if word == "Vertices":
            for _ in range(int(next(words))):
                vertices.append(tuple(float(next(words)) for _ in range(3)))
                next(words)
        if word == "Tetrahedra":
            for _ in range(int(next(words))):
                cells.append(tuple(int(next(words)) - 1 for _ in range(4)))
                next(words)
    return vertices, cells


def sol(section, kind, rows):
    """Returns the text of a .sol file with one field: kind 1 is a scalar, 3 a symmetric tensor."""
    lines = [" ".join(map(repr, row)) for row in rows]
    return "\n".join(["MeshVersionFormatted 2", "Dimension 3", section, str(len(rows)), f"1 {kind}",
                      *lines, "End", ""])


def edges(cell):
    return itertools.combinations(cell, 2)


def mean(values):
    return sum(values) / len(values)


def centroid(vertices, cell):
    return tuple(mean([vertices[v][k] for v in cell]) for k in range(3))


def longest(vertices, cell):
    return max(math.dist(vertices[a], vertices[b]) for a, b in edges(cell))


def longest_in_metric(vertices, cell, metrics):
    """Tensors are xx, xy, yy, xz, yz, zz, as in the file."""
    place = ((0, 1, 3), (1, 2, 4), (3, 4, 5))

    def length(a, b):
        v = [vertices[b][k] - vertices[a][k] for k in range(3)]
        m = [(x + y) / 2 for x, y in zip(metrics[a], metrics[b])]
        return math.sqrt(sum(v[r] * m[place[r][c]] * v[c] for r in range(3) for c in range(3)))
    return max(length(a, b) for a, b in edges(cell))


def graded(vertices, cells, sizes, gradation):
    """Lowers sizes until they grow slowly from each cell to its neighbours."""
    faces = {}
    for number, cell in enumerate(cells):
        for face in itertools.combinations(sorted(cell), 3):
            faces.setdefault(face, []).append(number)
    pairs = [pair for pair in faces.values() if len(pair) == 2]
    centres = [centroid(vertices, cell) for cell in cells]
    sizes, changed = list(sizes), True
    while changed:
        changed = False
        for a, b in itertools.chain(pairs, (pair[::-1] for pair in pairs)):
            limit = sizes[b] + (gradation - 1) * math.dist(centres[a], centres[b])
            if limit < sizes[a] * (1 - 1e-12):
                sizes[a], changed = limit, True
    return sizes


def determinant(u, v, w):
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0]))


def interpolated(p, vertices, cells, values):
    """Returns the value at a point of a mesh that contains it."""
    def minus(a, b):
        return tuple(x - y for x, y in zip(a, b))
    best = None
    for cell in cells:
        corners = [vertices[v] for v in cell]
        parts = []
        for k in range(4):
            a, b, c, d = (p if i == k else corners[i] for i in range(4))
            parts.append(determinant(minus(b, a), minus(c, a), minus(d, a)))
        weights = [part / sum(parts) for part in parts]
        if best is None or min(weights) > best[0]:
            best = min(weights), sum(w * values[v] for w, v in zip(weights, cell))
    assert best[0] > -1e-12
    return best[1]


def with_data(msh, section, rows, version, is_binary):
    """Returns the bytes of a Gmsh file with a section of values of 1 component, by number."""
    head = f'${section}\n1\n"a size"\n1\n0.0\n3\n-1\n1\n{len(rows)}\n'.encode()
    if is_binary:
        values = b"".join(struct.pack("<id", number, value) for number, value in rows)
    else:
        values = "".join(f"{number} {value!r}\n" for number, value in rows).encode()
    return msh + head + values + f"\n$End{section}\n".encode()


class Sizes(ProgramCase):
    def setUp(self):
        super().setUp()
        self.run_octetra("generate", "gear", "--edge", "0.3", "-o", "m.mesh")

    def written(self, ranks, *words):
        """Returns the mesh that octetra refine writes."""
        launcher = [str(mpirun), str(ranks)] if ranks > 1 else []
        done = subprocess.run([*launcher, octetra, "refine", *words, "-o", "out.mesh", "--quiet"],
                              cwd=self.path, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.path / "out.mesh").read_bytes()

    def refused(self, *words):
        """Returns the message of octetra refine m.mesh."""
        done = subprocess.run([octetra, "refine", "m.mesh", *words, "-o", "none.mesh"],
                              cwd=self.path, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse((self.path / "none.mesh").exists())
        return done.stderr.splitlines()[-1].removeprefix("octetra: ")

    def expect_marked(self, numbers, mesh, *words):
        """Expects that one level refines these cells, counted from 0, on one rank and several."""
        self.assertGreater(len(numbers), 0)
        (self.path / "cells.txt").write_text("\n".join(str(n + 1) for n in numbers) + "\n")
        expected = self.written(1, mesh, "--cells", "cells.txt")
        for ranks in (1, 3):
            self.assertEqual(self.written(ranks, mesh, *words), expected, f"{words}, {ranks} ranks")

    def test_sizes_on_vertices_and_cells(self):
        vertices, cells = read_mesh(self.path / "m.mesh")
        h = [0.1 + 0.2 * abs(x) for x, y, z in vertices]
        (self.path / "h.sol").write_text(sol("SolAtVertices", 1, [[s] for s in h]))
        at_centroid = [mean([h[v] for v in cell]) for cell in cells]
        too_large = [n for n, cell in enumerate(cells) if longest(vertices, cell) > at_centroid[n]]
        self.assertLess(len(too_large), len(cells))
        self.expect_marked(too_large, "m.mesh", "--size", "h.sol")
        (self.path / "hc.sol").write_text(sol("SolAtTetrahedra", 1, [[s] for s in at_centroid]))
        self.expect_marked(too_large, "m.mesh", "--size", "hc.sol")

    def test_metric(self):
        vertices, cells = read_mesh(self.path / "m.mesh")
        metric = [(20 + 30 * abs(x), 1.0, 15.0, -2.0, 0.5, 30 + y) for x, y, z in vertices]
        (self.path / "metric.sol").write_text(sol("SolAtVertices", 3, metric))
        too_large = [n for n, cell in enumerate(cells)
                     if longest_in_metric(vertices, cell, metric) > 1]
        self.assertLess(len(too_large), len(cells))
        self.expect_marked(too_large, "m.mesh", "--size", "metric.sol")

    def test_gradation(self):
        vertices, cells = read_mesh(self.path / "m.mesh")
        h = [0.1 if x > 0.9 else 9.0 for x, y, z in (centroid(vertices, cell) for cell in cells)]
        (self.path / "h.sol").write_text(sol("SolAtTetrahedra", 1, [[s] for s in h]))
        for gradation in (1.3, 2.0):
            sizes = graded(vertices, cells, h, gradation)
            too_large = [n for n, cell in enumerate(cells) if longest(vertices, cell) > sizes[n]]
            self.assertGreater(len(too_large), sum(s < 9 for s in h))
            self.expect_marked(too_large, "m.mesh", "--size", "h.sol", "--gradation",
                               str(gradation))

    def test_sizes_hold_after_enough_levels(self):
        vertices, _ = read_mesh(self.path / "m.mesh")
        h = [0.12 + 0.1 * abs(x) for x, y, z in vertices]
        (self.path / "h.sol").write_text(sol("SolAtVertices", 1, [[s] for s in h]))
        one = self.written(1, "m.mesh", "--size", "h.sol", "--levels", "20", "--scheme", "2t")
        fine, cells = read_mesh(self.path / "out.mesh")
        # The sizes are interpolated within the cells of m.mesh, so they are between these bounds.
        for cell in cells:
            x = max(abs(fine[v][0]) for v in cell)
            self.assertLessEqual(longest(fine, cell), 0.12 + 0.1 * (x + 0.3))
        for ranks in (2, 4):
            self.assertEqual(
                self.written(ranks, "m.mesh", "--size", "h.sol", "--levels", "20", "--scheme", "2t"),
                one)
        # In a script of steps, the sizes are those of the mesh before the first step.
        (self.path / "steps.txt").write_text(
            "refine --size h.sol --levels 20 --scheme 2t\n"
            "refine --size h.sol --levels 20 --scheme 2t\n")
        self.run_octetra("adapt", "m.mesh", "--script", "steps.txt", "-o", "adapted.mesh")
        self.assertEqual((self.path / "adapted.mesh").read_bytes(), one)
        self.assertFalse((self.path / "adapted.sol").exists())

    def make_background(self, section, values):
        self.run_octetra("generate", "kuhn", "5", "-o", "unit.mesh")
        vertices, cells = read_mesh(self.path / "unit.mesh")
        # A cube around the gear.
        text = (self.path / "unit.mesh").read_text()
        lines = text.split("\n")
        begin = lines.index("Vertices") + 2
        vertices = [tuple(3 * x - 1.5 for x in v) for v in vertices]
        for k, v in enumerate(vertices):
            lines[begin + k] = " ".join([*map(repr, v), lines[begin + k].split()[3]])
        (self.path / "b.mesh").write_text("\n".join(lines))
        rows = [values(v) for v in vertices] if section == "SolAtVertices" else [
            values(centroid(vertices, cell)) for cell in cells]
        (self.path / "b.sol").write_text(sol(section, 1, [[row] for row in rows]))
        return vertices, cells, rows

    def test_background_mesh(self):
        background, around, values = self.make_background(
            "SolAtVertices", lambda p: 0.1 + 0.2 * abs(p[0]) + 0.1 * math.hypot(*p))
        vertices, cells = read_mesh(self.path / "m.mesh")
        sizes = [interpolated(centroid(vertices, cell), background, around, values)
                 for cell in cells]
        too_large = [n for n, cell in enumerate(cells) if longest(vertices, cell) > sizes[n]]
        self.assertLess(len(too_large), len(cells))
        self.expect_marked(too_large, "m.mesh", "--size", "b.mesh")
        words = ("m.mesh", "--size", "b.mesh", "--gradation", "1.4", "--levels", "4")
        one = self.written(1, *words)
        for ranks in (2, 4):
            self.assertEqual(self.written(ranks, *words), one)

    def test_background_mesh_of_gmsh(self):
        for section, data in (("SolAtVertices", "NodeData"), ("SolAtTetrahedra", "ElementData")):
            vertices, cells, values = self.make_background(section, lambda p: 0.1 + 0.2 * abs(p[0]))
            expected = self.written(1, "m.mesh", "--size", "b.mesh", "--levels", "2")
            first = 1
            if data == "ElementData":  # all elements are numbered together, the cells at the end
                self.run_octetra("convert", "b.mesh", "bare.msh", "--msh-format", "2.2-text")
                lines = (self.path / "bare.msh").read_text().split("\n")
                listed = lines[lines.index("$Elements") + 2:lines.index("$EndElements")]
                first = min(int(line.split()[0]) for line in listed if line.split()[1] == "4")
            for version in ("4.1", "4.1-text", "2.2", "2.2-text"):
                self.run_octetra("convert", "b.mesh", "bare.msh", "--msh-format", version)
                msh = (self.path / "bare.msh").read_bytes()
                rows = [(first + n, value) for n, value in enumerate(values)]
                (self.path / "b.msh").write_bytes(
                    with_data(msh, data, rows[::-1], version, not version.endswith("text")))
                for ranks in (1, 3):
                    found = self.written(ranks, "m.mesh", "--size", "b.msh", "--levels", "2")
                    self.assertEqual(found, expected, f"{data}, {version}, {ranks} ranks")

    def test_faulty_background_meshes_are_refused(self):
        vertices, _, values = self.make_background("SolAtVertices", lambda p: 1.0)
        bad = [[1.0 if n != 4 else 0.0] for n in range(len(values))]
        (self.path / "b.sol").write_text(sol("SolAtVertices", 1, bad))
        self.assertIn("size(b.sol): the size of vertex 5 is not above 0",
                      self.refused("--size", "b.mesh"))
        (self.path / "b.sol").write_text(sol("SolAtVertices", 2, [[1.0] * 3] * len(values)))
        self.assertIn("3 components", self.refused("--size", "b.mesh"))
        (self.path / "b.sol").unlink()
        self.assertIn("b.sol", self.refused("--size", "b.mesh"))
        self.run_octetra("convert", "b.mesh", "bare.msh", "--msh-format", "2.2-text")
        msh = (self.path / "bare.msh").read_bytes()
        rows = [(n + 1, 1.0) for n in range(len(values))]
        line = msh.count(b"\n") + 10  # of the first value

        def refused_rows(rows):
            (self.path / "b.msh").write_bytes(with_data(msh, "NodeData", rows, "2.2", False))
            return self.refused("--size", "b.msh")
        self.assertIn(f"b.msh:{line + 3}: a second value of node 1",
                      refused_rows([*rows[:3], rows[0], *rows[4:]]))
        self.assertIn(f"b.msh:{line + 3}: there is no node 99999",
                      refused_rows([*rows[:3], (99999, 1.0), *rows[4:]]))
        self.assertIn(f"b.msh:{line + 3}: ", refused_rows([*rows[:3], (4, math.inf), *rows[4:]]))
        self.assertIn("but the mesh has", refused_rows(rows[1:]))
        (self.path / "b.msh").write_bytes(msh)
        self.assertIn("--size takes a file with one field, and this has 0",
                      self.refused("--size", "b.msh"))

    def test_faults_are_refused(self):
        vertices, _ = read_mesh(self.path / "m.mesh")
        count = len(vertices)

        def refused_file(text, *words):
            (self.path / "bad.sol").write_text(text)
            return self.refused("--size", "bad.sol", *words)
        scalars = [[1.0] for _ in range(count)]
        scalars[41] = [-2.0]
        self.assertIn("size(bad.sol): the size of vertex 42 is not above 0",
                      refused_file(sol("SolAtVertices", 1, scalars)))
        scalars[41] = [math.nan]
        self.assertRegex(refused_file(sol("SolAtVertices", 1, scalars)), r"^bad\.sol:47: ")
        tensors = [[1.0, 0.0, 1.0, 0.0, 0.0, 1.0] for _ in range(count)]
        tensors[6] = [1.0, 2.0, 1.0, 0.0, 0.0, 1.0]
        self.assertIn("size(bad.sol): the metric of vertex 7 is not positive definite",
                      refused_file(sol("SolAtVertices", 3, tensors)))
        self.assertIn("size(bad.sol): the field has 3 components",
                      refused_file(sol("SolAtVertices", 2, [[1.0] * 3] * count)))
        self.assertRegex(refused_file(sol("SolAtVertices", 1, scalars[1:])), r"^bad\.sol:4: ")
        self.assertIn("--size takes a file with one field", refused_file(
            "MeshVersionFormatted 2\nDimension 3\nEnd\n"))
        self.assertIn("none.sol", self.refused("--size", "none.sol"))
        self.assertEqual(
            self.refused("--all", "--gradation", "1.3"),
            "--gradation requires --size, as in --size 0.05 --gradation 1.3")
        self.assertIn("--gradation takes a number above 1, not '1'",
                      self.refused("--size", "0.1", "--gradation", "1"))
        (self.path / "h.sol").write_text(sol("SolAtVertices", 1, [[1.0]] * count))
        self.assertIn("cannot be combined with --engine reference",
                      self.refused("--size", "h.sol", "--engine", "reference"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
