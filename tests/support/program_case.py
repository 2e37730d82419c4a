"""Common parts of the tests of the program in Python."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

octetra = sys.argv[1]


class ProgramCase(unittest.TestCase):
    """Runs the program in a temporary folder, `self.path`."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def run_octetra(self, *words):
        subprocess.run([octetra, *words, "--quiet"], cwd=self.path, check=True,
                       stderr=subprocess.DEVNULL)
