"""The wheel of the Python module: built by pip, installed into a clean virtual environment, and used on
one rank and on three. Exits with 77 if the tools are missing.

tests/package/wheel_test.py SOURCES BUILD
"""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

source, build = (pathlib.Path(argument) for argument in sys.argv[1:3])
mpirun = source / "tests/support/mpirun.sh"
version = re.search(r"project\(Octetra VERSION (\S+)", (source / "CMakeLists.txt").read_text())[1]

REFINE = """\
import sys
if sys.argv[1] == "alone":
    sys.modules["mpi4py"] = None  # an import of it fails
import octetra
mesh = octetra.read(sys.argv[2])
mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.5))
mesh.write(sys.argv[3])
"""

HAND_OVER = """\
import sys
import octetra.dolfinx
mesh = octetra.read(sys.argv[1])
domain = octetra.dolfinx.to_mesh(mesh).mesh
if domain.comm.rank == 0:
    print(domain.topology.index_map(3).size_global, "cells")
"""


def skip_unless_ready():
    words = []
    if not (build / "python/octetra").exists():
        words.append("the Python module is not built")
    for module, package in (("scikit_build_core", "python3-scikit-build-core, from Debian 13 on"),
                            ("pip", "python3-pip"), ("ensurepip", "python3-venv"),
                            ("numpy", "python3-numpy"), ("mpi4py", "python3-mpi4py")):
        if importlib.util.find_spec(module) is None:
            words.append(f"there is no {module} (Debian: {package})")
    if words:
        print("skipped:", "; ".join(words))
        sys.exit(77)


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="octetra-wheel-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # Without optimisation, because the wheel is used only on small meshes.
        cls.run_command(sys.executable, "-m", "pip", "wheel", source, "--no-deps", "--no-build-isolation",
                        "--config-settings=cmake.define.CMAKE_CXX_FLAGS_RELEASE=-O0", "--wheel-dir", cls.folder)
        cls.wheel, = cls.folder.glob("*.whl")
        cls.run_command(sys.executable, "-m", "venv", "--system-site-packages", cls.folder / "venv")
        cls.bin = cls.folder / "venv/bin"
        cls.run_command(cls.bin / "pip", "install", "--no-index", "--no-deps", cls.wheel)
        cls.mesh = cls.folder / "cube.mesh"
        cls.run_command(cls.bin / "octetra", "generate", "kuhn", "4", "-o", cls.mesh)
        cls.run_command(cls.bin / "octetra", "refine", cls.mesh, "--sphere", "0,0,0,0.5",
                        "-o", cls.folder / "expected.mesh")

    @classmethod
    def run_command(cls, *command, **variables):
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run([str(word) for word in command], cwd=cls.folder, env={**environment, **variables},
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_has_the_module_and_the_program_alone(self):
        names = zipfile.ZipFile(self.wheel).namelist()
        self.assertEqual({name.split("/")[0] for name in names}, {"octetra", f"octetra-{version}.dist-info"})
        libraries = [name for name in names if ".so" in name]
        self.assertEqual(len(libraries), 1, libraries)
        own = {f"octetra/{path.relative_to(folder)}"
               for folder in (source / "python/octetra", source / "adapters/dolfinx/python")
               for path in folder.rglob("*")
               if path.suffix in (".py", ".pyi", ".typed") and path.name != "_dolfinx.pyi"}
        expected = {*own, "octetra/_program.py", "octetra/bin/octetra", *libraries}
        self.assertEqual({name for name in names if name.startswith("octetra/")}, expected)
        self.assertIn(f"octetra-{version}.dist-info/licenses/LICENSE", names)

    def test_links_mpi_dynamically(self):
        module, = (self.folder / "venv").rglob("_octetra.*.so")
        self.assertRegex(self.run_command("ldd", module), r"libmpi\w*\.so")

    def test_refines_on_one_rank_without_mpirun_and_mpi4py(self):
        output = self.folder / "one.mesh"
        self.run_command(self.bin / "python", "-c", REFINE, "alone", self.mesh, output, PATH="/nowhere")
        self.assertEqual(output.read_bytes(), (self.folder / "expected.mesh").read_bytes())

    def test_refines_on_three_ranks(self):
        output = self.folder / "three.mesh"
        self.run_command(mpirun, 3, self.bin / "python", "-m", "mpi4py", "-c", REFINE, "mpi4py", self.mesh, output)
        self.assertEqual(output.read_bytes(), (self.folder / "expected.mesh").read_bytes())

    @unittest.skipUnless(importlib.util.find_spec("dolfinx"), "there is no dolfinx (Debian: python3-dolfinx-real)")
    def test_hands_meshes_over_to_dolfinx(self):
        for command in ((), (mpirun, 2)):
            printed = self.run_command(*command, self.bin / "python", "-m", "mpi4py", "-c", HAND_OVER, self.mesh)
            self.assertEqual(printed, "384 cells\n")

    def test_has_the_command_line(self):
        printed = self.run_command(self.bin / "python", "-m", "octetra", "--help", PATH="/nowhere")
        self.assertIn("refine", printed)
        self.assertEqual(printed, self.run_command(self.bin / "octetra", "--help"))
        self.assertEqual(self.run_command(self.bin / "octetra", "--version"), f"octetra {version}\n")


if __name__ == "__main__":
    skip_unless_ready()
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
