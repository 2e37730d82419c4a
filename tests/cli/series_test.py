"""Compares the series of meshes that octetra adapt writes with the single files of its steps, by
the offsets defined in VTKHDF's specification of version 2.0.

usage: series_test.py OCTETRA SOURCES

Exits with 77 if h5py is not installed.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    print("skipped: there is no module h5py")
    sys.exit(77)

octetra, sources = sys.argv[1], pathlib.Path(sys.argv[2])
# The mesh after each step is also written to a single file; a step without changes is a step, too.
SCRIPT = """refine --sphere 0,0,0,0.5 --levels 2
write 1.vtkhdf
rebalance
coarsen --sphere 0,0,0,0.3
write 2.vtkhdf
refine --sphere 9,9,9,0.1
write 3.vtkhdf
refine --box 0,0,0,1,1,0.4
"""


def step_of(root, step):
    """Returns the data of a step that a reader finds through the offsets of the group Steps."""
    steps = root["Steps"]
    part = steps["PartOffsets"][step]
    assert steps["NumberOfParts"][step] == 1
    points, cells = root["NumberOfPoints"][part], root["NumberOfCells"][part]
    ids = root["NumberOfConnectivityIds"][part]
    first_point, first_cell = steps["PointOffsets"][step], steps["CellOffsets"][step, 0]
    first_id = steps["ConnectivityIdOffsets"][step, 0]
    found = {"Points": root["Points"][first_point:first_point + points],
             "Types": root["Types"][first_cell:first_cell + cells],
             # Each part has one offset more than cells.
             "Offsets": root["Offsets"][first_cell + part:first_cell + part + cells + 1],
             "Connectivity": root["Connectivity"][first_id:first_id + ids]}
    for group, count in (("PointData", points), ("CellData", cells)):
        for name, values in root[group].items():
            first = steps[group + "Offsets"][name][step]
            found[f"{group}/{name}"] = values[first:first + count]
    return found


class Series(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.octetra("generate", "kuhn", "4", "-o", "m.mesh")
        self.octetra("convert", "m.mesh", "0.octetra")
        words = (self.path / "m.mesh").read_text().split()
        (self.path / "m.sol").write_text("\n".join(
            ["MeshVersionFormatted 2", "Dimension 3", "SolAtVertices", words[words.index("Vertices") + 1], "2 1 2",
             *(f"{k / 4} {-k} {2 * k} 0.5" for k in range(125)), "SolAtTetrahedra", "384", "1 1",
             *map(str, range(384)), "End", ""]))
        (self.path / "s.txt").write_text(SCRIPT)

    def octetra(self, *words, ranks=0, status=0):
        many = [sources / "tests" / "support" / "mpirun.sh", str(ranks)] if ranks else []
        run = subprocess.run([*many, octetra, *words], cwd=self.path, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE)
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stderr

    def adapt(self, *more, ranks=0, status=0):
        return self.octetra("adapt", "m.mesh", "--fields", "m.sol", "--script", "s.txt", "-o", "4.vtkhdf", "--series",
                            "all.vtkhdf", *more, ranks=ranks, status=status)

    def test_has_every_step_as_its_own_file_has_it(self):
        self.octetra("convert", "m.mesh", "--fields", "m.sol", "0.vtkhdf")
        self.adapt()
        with h5py.File(self.path / "all.vtkhdf") as series:
            root = series["VTKHDF"]
            self.assertEqual(list(root.attrs["Version"]), [2, 0])
            self.assertEqual(root.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(root["Steps"].attrs["NSteps"], 5)
            self.assertEqual(root["Steps/Values"][()].tolist(), [0, 1, 2, 3, 4])
            sizes = set()
            for step in range(5):
                found = step_of(root, step)
                with h5py.File(self.path / f"{step}.vtkhdf") as one:
                    for name, values in found.items():
                        expected = one["VTKHDF"][name]
                        self.assertEqual(values.dtype, expected.dtype, name)
                        self.assertTrue((values == expected[()]).all() and values.shape == expected.shape, name)
                    for group in ("PointData", "CellData"):
                        self.assertEqual(set(one["VTKHDF"][group]), set(root[group]))
                sizes.add(len(found["Types"]))
            self.assertEqual(len(sizes), 4)

    def test_is_the_same_bytes_on_any_number_of_ranks(self):
        self.adapt()
        alone = (self.path / "all.vtkhdf").read_bytes()
        for ranks in (2, 3, 7):
            self.adapt(ranks=ranks)
            self.assertTrue((self.path / "all.vtkhdf").read_bytes() == alone, ranks)

    def test_is_refused_before_the_work(self):
        for name, words in (("all.vtu", "--series: all.vtu: a series is a .vtkhdf file"),
                            ("4.vtkhdf", "-o and --series name the same file, 4.vtkhdf"),
                            ("2.vtkhdf", "--series and write name the same file, 2.vtkhdf"),
                            ("no/all.vtkhdf", "there is no directory no; create it first")):
            said = self.octetra("adapt", "m.mesh", "--script", "s.txt", "-o", "4.vtkhdf", "--series", name, status=2)
            self.assertIn(words, said)
        self.assertFalse(list(self.path.glob("*.vtkhdf*")))

    def test_leaves_nothing_where_the_disk_is_full(self):
        """The disk is full while the parts of the series are written, or when they are assembled, which
        takes slightly more space."""
        self.octetra("adapt", "m.mesh", "--script", "s.txt", "-o", "e.octetra", "--series", "all.vtkhdf")
        size = (self.path / "all.vtkhdf").stat().st_size
        for file in self.path.glob("*.vtkhdf"):
            file.unlink()
        for blocks in (50, size // 1024 - 4):
            for ranks in (0, 3):
                many = f"{sources}/tests/support/mpirun.sh {ranks} " if ranks else ""
                run = subprocess.run(
                    ["bash", "-c", f"{many}bash -c 'ulimit -f {blocks}; exec {octetra} adapt m.mesh --script s.txt "
                     "-o e.octetra --series all.vtkhdf --quiet'"], cwd=self.path, text=True, stderr=subprocess.PIPE)
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertEqual(run.stderr.count("writing failed: File too large"), 1, run.stderr)
                self.assertIn("all.vtkhdf:" if blocks > 50 else ".vtkhdf", run.stderr)
                self.assertFalse(list(self.path.glob("all*")))
                for file in self.path.glob("*.vtkhdf"):
                    file.unlink()


if __name__ == "__main__":
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(Series))
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
