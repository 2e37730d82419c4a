"""Compares the .xdmf files written by the program, and the .h5 files beside them, with what other
readers find in them.

usage: xdmf_files_test.py OCTETRA SOURCES h5py|meshio|dolfinx DOLFINX_READER

Exits with 77 if the reader is not installed.
"""
import importlib
import pathlib
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

octetra, sources, reader, dolfinx_reader = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]
GRIDS = {"cell_tags": ("Tetrahedra", 5), "facet_tags": ("Triangles", 4), "edge_tags": ("Edges", 3)}
REFINE = ["refine", "m.meshb", "--sphere", "0,0,0,0.6", "--levels", "2"]


def sections(path):
    """The lists of a Medit file: rows of numbers."""
    words = path.read_text().split()
    found = {}
    for name, columns in [("Vertices", 4), *GRIDS.values(), ("SolAtVertices", 3), ("SolAtTetrahedra", 1)]:
        if name in words:
            at = words.index(name) + 1
            begin = at + (3 if name.startswith("Sol") else 1)
            flat = [float(word) for word in words[begin:begin + int(words[at]) * columns]]
            found[name] = [flat[k:k + columns] for k in range(0, len(flat), columns)]
    return found


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        # Cells of two regions, tagged facets and edges; a vector on vertices, a scalar on cells.
        self.octetra("convert", str(sources / "corpus" / "meshes" / "gmsh-box-41b.msh"), "m.meshb")
        self.octetra("convert", "m.meshb", "m.mesh")
        self.mesh = sections(self.path / "m.mesh")
        rows = [f"{x} {y} {z}" for x, y, z, _ in self.mesh["Vertices"]]
        numbers = [str(k / 8) for k in range(len(self.mesh["Tetrahedra"]))]
        (self.path / "m.sol").write_text("\n".join(
            ["MeshVersionFormatted 2", "Dimension 3", "SolAtVertices", str(len(rows)), "1 2", *rows,
             "SolAtTetrahedra", str(len(numbers)), "1 1", *numbers, "End", ""]))
        self.octetra(*REFINE, "--fields", "m.sol", "-o", "a.mesh")
        self.octetra(*REFINE, "--fields", "m.sol", "-o", "a.xdmf")
        self.expected = sections(self.path / "a.mesh") | sections(self.path / "a.sol")

    def octetra(self, *words, ranks=0):
        many = [sources / "tests" / "support" / "mpirun.sh", str(ranks)] if ranks else []
        subprocess.run([*many, octetra, *words, "--quiet"], cwd=self.path, check=True, stderr=subprocess.DEVNULL)

    def vertices(self, name):
        return [[int(v) - 1 for v in row[:-1]] for row in self.expected[name]]

    def tags(self, name):
        return [int(row[-1]) for row in self.expected[name]]


class ByH5py(Case):
    """Follows the XML to the datasets, like readers of the format."""

    def grids(self, name):
        root = ElementTree.parse(self.path / name).getroot()
        return {grid.get("Name"): grid for grid in root.find("Domain")}

    def values(self, item):
        file, path = item.text.strip().split(":")
        with h5py.File(self.path / file, "r") as h5:
            values = h5[path][()]
            self.assertTrue(h5[path].chunks is None and h5[path].compression is None)
        self.assertEqual([int(n) for n in item.get("Dimensions").split()], list(values.shape))
        self.assertEqual(values.dtype.itemsize, int(item.get("Precision")))
        self.assertEqual({"i": "Int", "f": "Float"}[values.dtype.kind], item.get("NumberType"))
        return values

    def test_finds_mesh_tags_and_fields(self):
        grids = self.grids("a.xdmf")
        self.assertEqual(list(grids), ["mesh", *GRIDS])
        points = [row[:3] for row in self.expected["Vertices"]]
        for name, grid in grids.items():
            self.assertEqual(self.values(grid.find("Geometry/DataItem")).tolist(), points)
            section = GRIDS.get(name, GRIDS["cell_tags"])[0]
            topology = grid.find("Topology")
            self.assertEqual(self.values(topology.find("DataItem")).tolist(), self.vertices(section))
            self.assertEqual(int(topology.get("NumberOfElements")), len(self.expected[section]))
            if name != "mesh":
                attributes = grid.findall("Attribute")
                self.assertEqual([a.get("Name") for a in attributes], [name])
                self.assertEqual(self.values(attributes[0].find("DataItem")).tolist(), self.tags(section))
        found = {(a.get("Name"), a.get("Center")): self.values(a.find("DataItem")).tolist()
                 for a in grids["mesh"].findall("Attribute")}
        self.assertEqual(found["sol_1", "Node"], self.expected["SolAtVertices"])
        self.assertEqual(found["sol_1", "Cell"], [row[0] for row in self.expected["SolAtTetrahedra"]])
        self.assertEqual(found["region", "Cell"], self.tags("Tetrahedra"))
        self.assertEqual(len(found["parent", "Cell"]), len(self.expected["Tetrahedra"]))

    def test_finds_the_same_bytes_from_any_number_of_ranks(self):
        files = [(self.path / name).read_bytes() for name in ("a.xdmf", "a.h5")]
        for ranks in (2, 3, 7):
            self.octetra(*REFINE, "--fields", "m.sol", "-o", "a.xdmf", ranks=ranks)
            self.assertEqual([(self.path / name).read_bytes() for name in ("a.xdmf", "a.h5")], files)

    def test_finds_no_grid_of_missing_entities(self):
        self.octetra("generate", "kuhn", "2", "-o", "k.mesh")
        text = (self.path / "k.mesh").read_text()
        (self.path / "k.mesh").write_text(text[:text.index("Triangles")] + "End\n")
        self.octetra("convert", "k.mesh", "k & l.xdmf")
        grids = self.grids("k & l.xdmf")
        self.assertEqual(list(grids), ["mesh"])
        self.assertEqual(self.values(grids["mesh"].find("Geometry/DataItem")).shape, (27, 3))


    def test_finds_symmetric_tensors_in_the_order_of_rows(self):
        self.octetra("generate", "kuhn", "1", "-o", "k.mesh")
        (self.path / "t.sol").write_text("MeshVersionFormatted 2 Dimension 3 SolAtVertices 8 1 3\n" +
                                         "11 12 22 13 23 33\n" * 8 + "End\n")
        self.octetra("convert", "k.mesh", "k.xdmf", "--fields", "t.sol")
        attribute = self.grids("k.xdmf")["mesh"].find("Attribute[@Name='sol_1']")
        self.assertEqual(attribute.get("AttributeType"), "Tensor6")
        self.assertEqual(self.values(attribute.find("DataItem")).tolist(), [[11, 12, 13, 22, 23, 33]] * 8)


class ByMeshio(Case):
    def test_finds_points_cells_and_fields(self):
        """meshio reads one grid."""
        tree = ElementTree.parse(self.path / "a.xdmf")
        domain = tree.getroot().find("Domain")
        for grid in list(domain)[1:]:
            domain.remove(grid)
        tree.write(self.path / "one.xdmf")
        mesh = meshio.read(self.path / "one.xdmf")
        self.assertEqual(mesh.points.tolist(), [row[:3] for row in self.expected["Vertices"]])
        self.assertEqual(mesh.cells_dict["tetra"].tolist(), self.vertices("Tetrahedra"))
        self.assertEqual(mesh.point_data["sol_1"].tolist(), self.expected["SolAtVertices"])
        self.assertEqual(mesh.cell_data["region"][0].tolist(), self.tags("Tetrahedra"))


class ByDolfinx(Case):
    def of_places(self, name, tagged):
        """The tag and corners of each entity."""
        points = [tuple(row[:3]) for row in self.expected["Vertices"]]
        return sorted((tag if tagged else 0, *sorted(points[v] for v in vertices))
                      for vertices, tag in zip(self.vertices(name), self.tags(name)))

    def test_finds_mesh_and_tags_on_any_number_of_ranks(self):
        for ranks in (1, 2, 3):
            with self.subTest(ranks=ranks):
                subprocess.run([sources / "tests" / "support" / "mpirun.sh", str(ranks), dolfinx_reader,
                                "a.xdmf", *GRIDS], cwd=self.path, check=True)
                lines = [line for rank in range(ranks)
                         for line in (self.path / f"found.{rank}").read_text().splitlines()]
                found = {"mesh": set()} | {grid: set() for grid in GRIDS}
                for line in lines:
                    grid, tag, *corners = line.split()
                    places = sorted(tuple(float.fromhex(c) for c in corner.split(",")) for corner in corners)
                    found[grid].add((int(tag), *places))
                self.assertEqual(sorted(found["mesh"]), self.of_places("Tetrahedra", False))
                for grid, (name, _) in GRIDS.items():
                    self.assertEqual(sorted(found[grid]), self.of_places(name, True), grid)


if reader == "dolfinx":
    if dolfinx_reader == "none":
        print("skipped: no DOLFINx 0.5 (Debian 12: libdolfinx-real-dev), or a build with sanitizers")
        sys.exit(77)
else:
    try:
        globals()[reader] = importlib.import_module(reader)
        importlib.import_module("h5py")  # which meshio requires for .h5 files
    except ImportError as error:
        print(f"skipped: there is no module {error.name}")
        sys.exit(77)
suite = unittest.defaultTestLoader.loadTestsFromTestCase(
    {"h5py": ByH5py, "meshio": ByMeshio, "dolfinx": ByDolfinx}[reader])
result = unittest.TextTestRunner(verbosity=2).run(suite)
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
