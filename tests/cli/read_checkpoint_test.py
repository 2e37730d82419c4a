"""Compares tools/read_checkpoint.py with the program.

usage: read_checkpoint_test.py OCTETRA TOOLS
"""
import pathlib
import sys
import unittest

import numpy

from program_case import ProgramCase

sys.path.insert(0, sys.argv[2])
import read_checkpoint  # noqa: E402


def mesh_of(path):
    """Points and cells of a Medit file."""
    words = path.read_text().split()

    def section(name, columns):
        at = words.index(name) + 1
        rows = words[at + 1:at + 1 + int(words[at]) * (columns + 1)]
        return numpy.array(rows).reshape(-1, columns + 1)[:, :columns]
    return section("Vertices", 3).astype(float), section("Tetrahedra", 4).astype(int) - 1


class ReadCheckpoint(ProgramCase):
    def test_finds_the_mesh_that_the_program_finds(self):
        # More than one block of cells, and steps that bisect few and many edges.
        (self.path / "steps.txt").write_text("refine --random 0.2 --seed 3\n"
                                             "refine --sphere 0.5,0.5,0.5,0.1 --scheme 2t\n"
                                             "coarsen --random 0.9 --seed 5\n"
                                             "refine --sphere 0.2,0.2,0.2,0.1 --levels 2\n"
                                             "save a.octetra\n")
        self.run_octetra("generate", "kuhn", "9", "-o", "cube.mesh")
        self.run_octetra("adapt", "cube.mesh", "--script", "steps.txt", "-o", "a.mesh")
        points, cells, on_vertices, on_cells = read_checkpoint.read(self.path / "a.octetra")
        expected_points, expected_cells = mesh_of(self.path / "a.mesh")
        numpy.testing.assert_array_equal(points, expected_points)
        numpy.testing.assert_array_equal(cells, expected_cells)
        self.assertEqual((on_vertices, on_cells), ({}, {}))

    def test_finds_the_names_of_groups(self):
        box = pathlib.Path(__file__).parents[2] / "corpus" / "meshes" / "gmsh-box-22.msh"
        text = box.read_text().replace('2 9 "floor and roof"', '2 -9 "St\u00e4be"')
        (self.path / "box.msh").write_text(text)
        self.run_octetra("refine", "box.msh", "--all", "-o", "a.octetra")
        found = read_checkpoint.File(self.path / "a.octetra")
        self.assertEqual(found.group_names, [(0, 6, "corner"), (1, 5, "ridge"), (2, 3, "floor #1"),
                                             (2, 4, "interface"), (2, -9, "St\u00e4be"), (3, 2, "air above"), (3, 7, "steel")])
        self.run_octetra("refine", "box.msh", "--all", "-o", "a.mesh")
        points, cells, *_ = read_checkpoint.read(self.path / "a.octetra")
        expected_points, expected_cells = mesh_of(self.path / "a.mesh")
        numpy.testing.assert_array_equal(points, expected_points)
        numpy.testing.assert_array_equal(cells, expected_cells)

    def test_finds_the_mesh_at_any_scale(self):
        self.run_octetra("generate", "random", "60", "-o", "a.mesh")
        words = (self.path / "a.mesh").read_text().split()
        at = words.index("Vertices") + 2
        count = int(words[at - 1])
        for scale in (1e-300, 1e-160, 1e150):
            scaled = list(words)
            for k in range(at, at + 4 * count):
                if (k - at) % 4 != 3:
                    scaled[k] = repr(float(words[k]) * scale)
            (self.path / "b.mesh").write_text("\n".join(scaled) + "\n")
            self.run_octetra("refine", "b.mesh", "--random", "0.3", "--levels", "2", "-o", "b.octetra")
            self.run_octetra("convert", "b.octetra", "c.mesh")
            points, cells, *_ = read_checkpoint.read(self.path / "b.octetra")
            expected_points, expected_cells = mesh_of(self.path / "c.mesh")
            numpy.testing.assert_array_equal(points, expected_points)
            numpy.testing.assert_array_equal(cells, expected_cells)

    def test_refuses_a_file_that_is_cut_off(self):
        self.run_octetra("generate", "kuhn", "2", "-o", "cube.mesh")
        self.run_octetra("refine", "cube.mesh", "--all", "-o", "a.octetra")
        whole = (self.path / "a.octetra").read_bytes()
        (self.path / "b.octetra").write_bytes(whole[:-1])
        with self.assertRaises(ValueError):
            read_checkpoint.read(self.path / "b.octetra")


unittest.main(argv=sys.argv[:1])
