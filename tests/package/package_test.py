"""Programs built with Octetra in the usual ways: by find_package() and by pkg-config from an
installation that was moved, shared and static, and with Octetra as a subdirectory."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from manual_pages import manual_pages

source, build = (pathlib.Path(argument) for argument in sys.argv[1:3])
mpirun = source / "tests/support/mpirun.sh"

# The programs compiled here run only on small meshes.
QUICKLY = ("-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32", "-DCMAKE_CXX_FLAGS_RELEASE=-O0")

PART_OF_A_PROGRAM = """\
cmake_minimum_required(VERSION 3.25)
project(Program LANGUAGES CXX)
{how}
add_executable(program {source}/examples/read_refine_write.cpp)
find_package(MPI REQUIRED COMPONENTS CXX)
target_link_libraries(program PRIVATE Octetra::distributed MPI::MPI_CXX)
if(TARGET octetra OR TARGET test_core OR TARGET octetra_verify)
  message(FATAL_ERROR "Octetra as a subdirectory builds more than libraries by default")
endif()
"""


def blocks_of_tutorial():
    """Returns the text blocks of the page about the library, by their first words."""
    page = (source / "docs/library.md").read_text()
    blocks = re.findall(r"^```text\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    return lambda start: next(block for block in blocks if block.startswith(start))


def run(*command, cwd=None, env=None):
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=env, capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="octetra-package-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.mesh = self.folder / "cube.mesh"
        run(build / "cli/octetra", "generate", "kuhn", "4", "-o", self.mesh, "--quiet")

    def configure(self, project, folder, *options):
        run("cmake", "-G", "Ninja", "-S", project, "-B", folder, *options)

    def installed(self, built):
        """The folder to which the installed build was moved."""
        run("cmake", "--install", built, "--prefix", self.folder / "first")
        return self.moved(self.folder / "first")

    def moved(self, prefix):
        prefix.rename(self.folder / "moved")
        for path in (self.folder / "moved").rglob("*"):
            if path.suffix in (".cmake", ".pc", ".hpp"):
                text = path.read_text()
                self.assertNotIn(str(self.folder), text, path)
                self.assertNotIn(str(source), text, path)
        return self.folder / "moved"

    def check_manual_pages(self, prefix):
        """They are installed if the tool for them is available."""
        expected = set()
        if shutil.which("help2man"):
            names = manual_pages(run(prefix / "bin/octetra", "--help"))
            expected = {f"share/man/man1/{name}.1" for name in names}
        found = {str(path.relative_to(prefix)) for path in (prefix / "share").rglob("*.1")}
        self.assertEqual(found, expected)

    def check_missing_component(self, prefix):
        project = self.folder / "missing"
        project.mkdir()
        (project / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(Missing LANGUAGES CXX)\n"
            "find_package(Octetra REQUIRED COMPONENTS distributed gmsh)\n")
        with self.assertRaisesRegex(AssertionError, "without the component gmsh"):
            self.configure(project, project / "build", f"-DCMAKE_PREFIX_PATH={prefix}")

    def check_refined(self, program, ranks=(1, 2, 4)):
        """The program's file is the same on any number of ranks, and equals that of the command."""
        files = set()
        for n in ranks:
            output = self.folder / f"refined.{n}.mesh"
            run(mpirun, n, program, self.mesh, output)
            files.add(output.read_bytes())
        self.assertEqual(len(files), 1)
        once, twice = self.folder / "once.mesh", self.folder / "twice.mesh"
        refine = (build / "cli/octetra", "refine", "--quiet")
        run(*refine, self.mesh, "--sphere", "0,0,0,0.5", "-o", once)
        run(*refine, once, "--sphere", "0,0,0,0.25", "-o", twice)
        self.assertEqual(files.pop(), twice.read_bytes())

    def build_and_run_examples(self, prefix, *options, ranks=(1, 2, 4)):
        built = self.folder / "examples"
        self.configure(source / "examples", built, f"-DCMAKE_PREFIX_PATH={prefix}", *options)
        run("cmake", "--build", built)
        self.check_refined(built / "read_refine_write", ranks)
        for n in ranks:
            self.assertIn(f"mass {n} of {n}", run(mpirun, n, built / "from_solver_parts"))
            self.assertIn("exact:", run(mpirun, n, built / "quadratic_transfer", self.mesh))
        loops = [run(mpirun, n, built / "adaptive_loop", self.mesh, 3, self.folder / "front.mesh")
                 + (self.folder / "front.mesh").read_text() for n in ranks]
        self.assertEqual(loops, [loops[0]] * len(ranks))
        self.check_fronts(built / "moving_front", ranks)
        if (built / "petsc_plex").exists():  # if PETSc is installed
            self.check_solutions(built / "petsc_plex", ranks)
        if (built / "adaptive_poisson").exists():  # if PETSc is installed
            self.check_rates(built / "adaptive_poisson", [n for n in ranks if n < 4])
        if (built / "multigrid_poisson").exists():  # if PETSc is installed
            self.check_iterations(built / "multigrid_poisson", [n for n in ranks if n < 4])

    def check_fronts(self, program, ranks):
        """The meshes are the same on any number of ranks and in the Python example; heat is
        conserved."""
        runs = [(f"cpp.{n}", (mpirun, n, program)) for n in ranks]
        if (build / "python/octetra").exists():
            runs.append(("python", ("/usr/bin/env", f"PYTHONPATH={build / 'python'}", sys.executable,
                                    source / "examples/python/moving_front.py")))
        cells, meshes = [], []
        for name, command in runs:
            lines = run(*command, self.mesh, 4, name, cwd=self.folder).splitlines()
            self.assertEqual(len(lines), 6)
            self.assertEqual(lines[-1], "heat is conserved up to rounding")
            self.assertTrue(all(float(line.split()[-1]) < 1e-12 for line in lines[1:-1]), lines)
            self.assertTrue((self.folder / f"{name}.vtkhdf").exists())
            cells.append([line.split()[:2] for line in lines])
            meshes.append((self.folder / f"{name}.mesh").read_bytes())
        self.assertEqual(cells, [cells[0]] * len(runs))
        self.assertEqual(meshes, [meshes[0]] * len(runs))

    def check_solutions(self, program, ranks):
        """The table is the same on any number of ranks; every mesh has all functions of the
        previous ones."""
        tables = [run(mpirun, n, program, self.mesh, 2) for n in ranks]
        self.assertEqual(tables, [tables[0]] * len(tables))
        rows = [line.split() for line in tables[0].splitlines()[1:]]
        self.assertEqual(rows[0][:2], ["384", "27"])
        integrals = [float(row[2]) for row in rows]
        self.assertEqual(integrals, sorted(set(integrals)))

    def check_rates(self, program, ranks):
        """The theoretical rates of the error against unknowns are -2/9 on uniform meshes and -1/3
        on adaptive ones."""
        for kind, steps, low, high in (("uniform", 3, -0.24, -0.18), ("adaptive", 5, -0.36, -0.29)):
            for n in ranks:
                rows = [line.split() for line in run(mpirun, n, program, kind, steps).splitlines()]
                self.assertEqual(len(rows), steps + 2)
                self.assertTrue(low < float(rows[-1][4]) < high, rows)
                # A solver's rounding differs with the number of ranks, and so may adaptive meshes.
                if kind == "uniform":
                    self.assertEqual(rows[-1][:2], ["73728", "14161"])

    def check_iterations(self, program, ranks):
        """Multigrid on the levels of the mesh takes at most 20 iterations, and hardly more as the
        mesh grows."""
        for closure in ("longest-edge", "regular"):
            for n in ranks:
                rows = [line.split() for line in run(mpirun, n, program, closure, 20_000).splitlines()]
                iterations = [int(row[3]) for row in rows[2:] if int(row[1]) >= 1000]
                self.assertGreaterEqual(len(iterations), 4)
                self.assertLessEqual(max(iterations), 15, rows)
                self.assertLessEqual(iterations[-1], 1.5 * iterations[0], rows)

    def test_static_libraries_are_found_where_they_were_moved_to(self):
        prefix = self.installed(build)
        self.assertIn("octetra 0.", run(prefix / "bin/octetra", "--version"))
        self.check_manual_pages(prefix)
        self.assertEqual((prefix / "share/doc/octetra/LICENSE").read_text(),
                         (source / "LICENSE").read_text())
        self.check_missing_component(prefix)
        self.build_and_run_examples(prefix)

        folders = [str(path.parent) for path in prefix.rglob("octetra-core.pc")]
        flags = run("pkg-config", "--cflags", "--libs", "octetra-distributed",
                    env={**os.environ, "PKG_CONFIG_PATH": ":".join(folders)}).split()
        program = self.folder / "by_pkg_config"
        run("c++", "-std=c++20", source / "examples/read_refine_write.cpp", *flags, "-o", program)
        self.check_refined(program, ranks=(2,))

    def cached(self, variable):
        """The value of a variable in the cache of our build."""
        return re.search(rf"^{variable}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)[1]

    def commands(self, folder, target, part):
        """The commands that make a target, as if the part of the folder in which Octetra is built
        were our build."""
        lines = run("ninja", "--quiet", "-C", folder, "-t", "commands", target)
        lines = lines.replace(str(folder / part), str(build)).replace(f" {part}/", " ")
        return re.sub("^[^ ]*ccache ", "", lines, flags=re.MULTILINE).splitlines()

    def test_a_program_has_octetra_as_a_part_of_itself(self):
        """The commands for our libraries are those of our build. Therefore linking these libraries
        gives the same result in a tenth of the time."""
        ours = set(self.commands(build, "octetra_distributed", "."))
        for part, how in (("octetra", f"add_subdirectory({source} octetra)"),
                          ("_deps/octetra-build", "include(FetchContent)\n"
                                                  f"FetchContent_Declare(Octetra SOURCE_DIR {source})\n"
                                                  "FetchContent_MakeAvailable(Octetra)")):
            project = self.folder / part
            project.mkdir(parents=True)
            (project / "CMakeLists.txt").write_text(PART_OF_A_PROGRAM.format(how=how, source=source))
            built = project / "build"
            self.configure(project, built, *(f"-D{variable}={self.cached(variable)}" for variable in (
                "CMAKE_BUILD_TYPE", "CMAKE_CXX_COMPILER", "CMAKE_CXX_FLAGS", "OCTETRA_WARNINGS_AS_ERRORS")))
            commands = self.commands(built, "program", part)
            own = [command for command in commands if "program.dir/" in command]
            self.assertEqual(len(own), 2, commands)
            libraries = [command for command in commands if command not in own]
            self.assertGreater(len(libraries), 2)
            self.assertEqual([command for command in libraries if command not in ours], [])
            for command in own:
                run("sh", "-c", re.sub(r" (core|distributed)/lib", rf" {build}/\1/lib", command), cwd=built)
            self.check_refined(built / "program", ranks=(2,))

    def test_the_tutorial_leads_to_shared_libraries_and_a_loop(self):
        home = self.folder / "home"
        loop = home / "loop"
        loop.mkdir(parents=True)
        environment = {**os.environ, "HOME": str(home)}
        settings = f"set -a; . {source}/tools/mpi.env; set +a\n"
        block = blocks_of_tutorial()

        def follow(commands, folder):
            return run("bash", "-e", "-c", settings + commands, cwd=folder, env=environment)

        # The checkout stays unchanged, and the existing program is used, because an optimised build
        # takes longer.
        install = block("cmake -S .").replace("build/mine", str(self.folder / "mine")).replace(
            "cmake -S .",
            f"cmake -S . -DOCTETRA_VERIFY=OFF -DOCTETRA_CLI=OFF {' '.join(QUICKLY)}")
        follow(install, source)
        prefix, = home.glob("octetra*")
        (prefix / "bin").mkdir()
        (prefix / "bin/octetra").symlink_to(build / "cli/octetra")

        (loop / "CMakeLists.txt").write_text(block("cmake_minimum_required"))
        shutil.copy(source / "examples/adaptive_loop.cpp", loop)
        follow(block("cmake -B build"), loop)
        by_cmake = (loop / "front.vtu").read_bytes()
        (loop / "front.vtu").unlink()
        follow(block("export PKG_CONFIG_PATH") + "./loop cube.mesh 5 front.vtu", loop)
        self.assertEqual((loop / "front.vtu").read_bytes(), by_cmake)

        # Shared libraries require only MPI of their users, and the one for PETSc also PETSc. They
        # compute the same as static ones, so one number of ranks is enough.
        prefix = self.moved(prefix)
        for file in prefix.rglob("*.pc"):
            for kind in ("--print-requires", "--print-requires-private"):
                for package in run("pkg-config", kind, file).split():
                    self.assertRegex(package, "^(octetra-.*|ompi-cxx|mpich|PETSc|dolfinx_real)$", file)
        self.build_and_run_examples(
            prefix, "-DCMAKE_BUILD_TYPE=Release",
            *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{p}=ON" for p in ("fmt", "ZLIB", "SerialHDF5", "METIS")),
            ranks=(2,))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
