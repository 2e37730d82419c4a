"""The package of MPI that octetra-distributed.pc requires is that of the MPI that was found, also where several are
installed side by side."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

source = pathlib.Path(sys.argv[1])

PROJECT = """\
cmake_minimum_required(VERSION 3.25)
project(Mpi NONE)
list(APPEND CMAKE_MODULE_PATH {source}/cmake)
include(OctetraMpi)
octetra_mpi_package(package)
octetra_mpi_flags(cflags libraries)
message(STATUS "package=${{package}} cflags=${{cflags}} libraries=${{libraries}}.")
"""


class MpiPackage(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="octetra-mpi-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "CMakeLists.txt").write_text(PROJECT.format(source=source))
        for package, mpi in (("ompi-cxx", "openmpi"), ("mpich", "mpich"), (None, "other")):
            (self.folder / mpi / "include").mkdir(parents=True)
            if package is not None:
                (self.folder / f"{package}.pc").write_text(
                    f"includedir={self.folder}/{mpi}/../{mpi}/include\n"
                    f"Name: {package}\nDescription: MPI\nVersion: 1\nLibs: -lmpi\n")

    def answer(self, *folders):
        listed = ";".join(str(self.folder / folder) for folder in folders)
        done = subprocess.run(
            ["cmake", "-G", "Ninja", "-S", self.folder, "-B", self.folder / "build",
             f"-DMPI_CXX_INCLUDE_DIRS={listed}", "-DMPI_CXX_LIBRARIES=/opt/libmpi.so"], check=True, capture_output=True, text=True,
            env={**os.environ, "PKG_CONFIG_LIBDIR": str(self.folder), "PKG_CONFIG_PATH": ""})
        return next(line for line in done.stdout.splitlines() if "package=" in line)

    def test_open_mpi_is_required_where_it_was_found(self):
        self.assertIn("package=ompi-cxx ", self.answer("openmpi/include", "openmpi/include/openmpi"))

    def test_mpich_is_required_where_it_was_found_beside_open_mpi(self):
        self.assertIn("package=mpich ", self.answer("mpich/include"))

    def test_an_mpi_without_a_package_is_given_by_its_flags(self):
        folder = f"{self.folder}/other/include"
        self.assertIn(f"package= cflags=-I{folder} libraries=/opt/libmpi.so.", self.answer("other/include"))

    def test_a_compiler_that_knows_mpi_needs_neither(self):
        self.assertIn("package= cflags= ", self.answer())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
