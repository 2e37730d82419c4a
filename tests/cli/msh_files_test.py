"""Compares the .msh files written by the program with what other readers find in them.

usage: msh_files_test.py OCTETRA CORPUS gmsh|meshio

Exits with 77 if Gmsh, or meshio, is not installed.
"""
import collections
import pathlib
import shutil
import subprocess
import sys
import unittest

from program_case import ProgramCase

corpus, reader = pathlib.Path(sys.argv[2]), sys.argv[3]
FORMATS = ["4.1", "4.1-text", "2.2", "2.2-text"]


def sections(path):
    """The lists of a Medit file: rows of words."""
    words = path.read_text().split()
    found = {}
    for name, columns in [("Vertices", 4), ("Tetrahedra", 5), ("Triangles", 4), ("Edges", 3)]:
        if name not in words:
            found[name] = []
            continue
        at = words.index(name) + 1
        flat = words[at + 1:at + 1 + int(words[at]) * columns]
        found[name] = [flat[k:k + columns] for k in range(0, len(flat), columns)]
    return found


def names_in(path):
    """The lines that name groups."""
    lines = path.read_bytes().split(b"\n")
    at = lines.index(b"$PhysicalNames") + 2
    return {line.decode() for line in lines[at:at + int(lines[at - 1])]}


def named_by_points(path):
    """The entities of a Medit file by the coordinates of their corners, each with its reference,
    counted."""
    lists = sections(path)
    points = [tuple(float(c) for c in row[:3]) for row in lists["Vertices"]]
    return {kind: collections.Counter((tuple(sorted(points[int(v) - 1] for v in row[:-1])), row[-1])
                                      for row in lists[kind])
            for kind in ["Tetrahedra", "Triangles", "Edges"]}


class Case(ProgramCase):
    def setUp(self):
        super().setUp()
        # Cells of two regions, one of them without a tag, facets of three groups, and two edges.
        text = (corpus / "meshes" / "gmsh-box-41b.msh").read_bytes()
        (self.path / "box.msh").write_bytes(text)
        self.run_octetra("convert", "box.msh", "box.mesh")
        whole = (self.path / "box.mesh").read_text().replace(" -3\n", " 3\n")
        (self.path / "box.mesh").write_text(whole)


class ByGmsh(Case):
    def gmsh(self, *words):
        run = subprocess.run(["gmsh", *words], cwd=self.path, check=True, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for word in ["Warning", "Error"]:
            self.assertNotIn(word, run.stdout)

    def test_finds_nothing_wrong(self):
        for form in FORMATS:
            with self.subTest(form):
                self.run_octetra("convert", "box.mesh", "a.msh", "--msh-format", form)
                self.gmsh("-check", "a.msh")

    def test_saves_the_same_mesh_with_the_same_groups(self):
        expected = named_by_points(self.path / "box.mesh")
        for form in FORMATS:
            for again in ["msh41", "msh22"]:
                with self.subTest(form + " as " + again):
                    self.run_octetra("convert", "box.mesh", "a.msh", "--msh-format", form)
                    self.gmsh("a.msh", "-save", "-bin", "-format", again, "-o", "b.msh")
                    self.run_octetra("convert", "b.msh", "b.mesh")
                    self.assertEqual(named_by_points(self.path / "b.mesh"), expected)

    def test_saves_refined_meshes(self):
        self.run_octetra("refine", "box.mesh", "--sphere", "0,0,0,0.6", "-o", "a.msh")
        self.run_octetra("refine", "box.mesh", "--sphere", "0,0,0,0.6", "-o", "a.mesh")
        self.gmsh("-check", "a.msh")
        self.gmsh("a.msh", "-save", "-bin", "-format", "msh41", "-o", "b.msh")
        self.run_octetra("convert", "b.msh", "b.mesh")
        self.assertEqual(named_by_points(self.path / "b.mesh"), named_by_points(self.path / "a.mesh"))

    def test_saves_and_refines_cells_without_a_tag(self):
        """With markers on facets: Gmsh saves only elements of groups, if there are any."""
        self.run_octetra("generate", "gear", "-o", "gear.1.ele")
        self.run_octetra("convert", "gear.1.ele", "gear.mesh")
        expected = named_by_points(self.path / "gear.mesh")
        for form in FORMATS:
            for again in ["msh41", "msh22"]:
                with self.subTest(form + " as " + again):
                    self.run_octetra("convert", "gear.mesh", "a.msh", "--msh-format", form)
                    self.gmsh("a.msh", "-save", "-bin", "-format", again, "-o", "b.msh")
                    self.run_octetra("convert", "b.msh", "b.mesh")
                    self.assertTrue(named_by_points(self.path / "b.mesh") == expected)
                    self.gmsh("a.msh", "-refine", "-format", again, "-o", "c.msh")
                    self.run_octetra("convert", "c.msh", "c.mesh")
                    fine, coarse = sections(self.path / "c.mesh"), sections(self.path / "gear.mesh")
                    self.assertEqual(len(fine["Tetrahedra"]), 8 * len(coarse["Tetrahedra"]))
                    self.assertEqual({row[-1] for row in fine["Tetrahedra"]}, {"0"})

    def test_keeps_the_names_of_groups(self):
        """Names of groups are in the written file and in the file that Gmsh makes of it."""
        expected = names_in(self.path / "box.msh")
        self.assertEqual(len(expected), 7)
        self.run_octetra("refine", "box.msh", "--sphere", "0,0,0,0.6", "-o", "fine.octetra")
        for form in FORMATS:
            for again in ["msh41", "msh22"]:
                with self.subTest(form + " as " + again):
                    self.run_octetra("convert", "fine.octetra", "a.msh", "--msh-format", form)
                    self.assertEqual(names_in(self.path / "a.msh"), expected)
                    self.gmsh("a.msh", "-save", "-format", again, "-o", "b.msh")
                    self.assertEqual(names_in(self.path / "b.msh"), expected)


class ByMeshio(Case):
    def test_finds_cells_without_a_tag_in_a_group_of_their_own(self):
        self.run_octetra("generate", "gear", "-o", "gear.1.ele")
        for form in FORMATS:
            with self.subTest(form):
                self.run_octetra("convert", "gear.1.ele", "a.msh", "--msh-format", form)
                mesh = meshio.read(self.path / "a.msh")
                tag, dimension = mesh.field_data["octetra:untagged"]
                self.assertEqual(dimension, 3)
                groups = [set(tags) for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"])
                          if block.type == "tetra"]
                self.assertEqual(groups, [{tag}])

    def test_finds_the_same_points_and_elements_with_the_same_groups(self):
        import numpy
        lists = sections(self.path / "box.mesh")
        for form in FORMATS:
            with self.subTest(form):
                self.run_octetra("convert", "box.mesh", "a.msh", "--msh-format", form)
                mesh = meshio.read(self.path / "a.msh")
                points = numpy.array([row[:3] for row in lists["Vertices"]], dtype=float)
                self.assertTrue((mesh.points == points).all())
                groups = mesh.cell_data["gmsh:physical"]
                for kind, name in [("tetra", "Tetrahedra"), ("triangle", "Triangles"), ("line", "Edges")]:
                    rows = []
                    for block, tags in zip(mesh.cells, groups):
                        if block.type == kind:
                            rows += [[*nodes, tag] for nodes, tag in zip(block.data, tags)]
                    expected = [[*(int(v) - 1 for v in row[:-1]), int(row[-1])] for row in lists[name]]
                    self.assertTrue(numpy.array_equal(rows, expected), name)


if reader == "gmsh":
    if shutil.which("gmsh") is None:
        print("skipped: there is no program gmsh")
        sys.exit(77)
else:
    try:
        import meshio
    except ImportError:
        print("skipped: there is no module meshio")
        sys.exit(77)
case = {"gmsh": ByGmsh, "meshio": ByMeshio}[reader]
unittest.main(argv=sys.argv[:1], defaultTest=case.__name__, verbosity=2)
