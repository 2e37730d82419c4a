#!/usr/bin/env python3
"""Builds the Debian packages in a copy of the sources, checks their contents, and builds an example
with them. For ./dev campaign packages, because it takes minutes. Exits with 77 if the tools are
missing.

tests/package/debian_test.py SOURCES FOLDER MINUTES
"""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from manual_pages import manual_pages

source, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
end = time.monotonic() + 60 * float(sys.argv[3])
packages = ("octetra", "liboctetra0.1", "liboctetra-dev")
layers = ("core", "distributed", "quality", "reference", "verify")
stage = folder / "stage"


def finished(*command, cwd=None, env=None, status=0):
    """Returns the output of a command on both streams. Commands end at the time limit or at Ctrl-C."""
    process = subprocess.Popen([str(word) for word in command], cwd=cwd, env=env, text=True,
                               start_new_session=True, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        printed, _ = process.communicate(timeout=max(1, end - time.monotonic()))
    except BaseException:
        os.killpg(process.pid, signal.SIGTERM)
        process.communicate()
        raise
    if process.returncode != status:
        raise AssertionError(f"{command}: status {process.returncode}\n{printed[-20000:]}")
    return printed


def skip_unless_ready():
    words = []
    for tool in ("dpkg-buildpackage", "dh", "lintian", "apt-get", "mpirun"):
        if not shutil.which(tool):
            words.append(f"{tool} is not installed")
    if not words:
        done = subprocess.run(["dpkg-checkbuilddeps"], cwd=source, capture_output=True, text=True,
                              check=False)
        words += done.stderr.splitlines()
    if words:
        print("skipped:", "; ".join(words))
        sys.exit(77)


def copy_sources(target):
    """Lists the files known to git, in their state in the working tree; without git, all files
    except build products."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            cwd=source, capture_output=True, check=False)
    if listed.returncode != 0 or not (source / ".git").exists():
        shutil.copytree(source, target, symlinks=True, ignore=shutil.ignore_patterns(
            "build", "demo", "equivalence", "__pycache__", ".git"))
        return
    for name in listed.stdout.decode().split("\0"):
        if name and (source / name).exists():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source / name, target / name, follow_symlinks=False)


def build_packages():
    shutil.rmtree(folder, ignore_errors=True)
    copy_sources(folder / "octetra")
    log = finished("dpkg-buildpackage", "-us", "-uc", "-b", cwd=folder / "octetra")
    (folder / "build.log").write_text(log)
    for deb in folder.glob("*.deb"):
        if "-dbgsym_" not in deb.name:
            finished("dpkg-deb", "--extract", deb, stage)


def deb_of(package):
    found = list(folder.glob(f"{package}_*.deb"))
    assert len(found) == 1, found
    return found[0]


def files_of(package):
    """The files and symbolic links of a package, without documentation and lintian's files."""
    names = set()
    for line in finished("dpkg-deb", "--contents", deb_of(package)).splitlines():
        name = line.split(maxsplit=5)[5].split(" -> ")[0].removeprefix("./")
        if name and not name.endswith("/") and not name.startswith(("usr/share/doc/", "usr/share/lintian/")):
            names.add(name)
    return names


def depends_of(package):
    field = finished("dpkg-deb", "--field", deb_of(package), "Depends")
    return {entry.split()[0] for entry in re.split(r"[,|]", field)}


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build_packages()
        machine = finished("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()
        cls.libraries = f"usr/lib/{machine}"
        cls.version = re.search(r"project\(Octetra VERSION (\S+)",
                                (source / "CMakeLists.txt").read_text())[1]
        cls.soversion = cls.version.rpartition(".")[0]
        # As if they were installed; only the files of pkg-config that the packages require are
        # visible.
        known = folder / "pkgconfig"
        known.mkdir()
        for package in depends_of("liboctetra-dev") - set(packages):
            for file in finished("dpkg", "--listfiles", package).splitlines():
                if file.startswith(f"/{cls.libraries}/pkgconfig/"):
                    (known / pathlib.Path(file).name).symlink_to(file)
        cls.environment = {
            **os.environ,
            "PATH": f"{stage}/usr/bin:{os.environ['PATH']}",
            "LD_LIBRARY_PATH": str(stage / cls.libraries),
            "CMAKE_PREFIX_PATH": str(stage / "usr"),
            "PKG_CONFIG_LIBDIR": f"{stage / cls.libraries}/pkgconfig:{known}",
            "AUTOPKGTEST_TMP": str(folder / "autopkgtest")}

    def test_are_three(self):
        names = {deb.name.split("_")[0] for deb in folder.glob("*.deb")}
        self.assertEqual({name for name in names if not name.endswith("-dbgsym")}, set(packages))

    def test_of_libraries_have_nothing_else(self):
        self.assertEqual(files_of("liboctetra0.1"), {
            f"{self.libraries}/liboctetra_{layer}.so.{version}"
            for layer in layers for version in (self.version, self.soversion)})

    def test_for_development_have_all_headers_and_configuration_files(self):
        headers = {"usr/include/octetra/core/version.hpp"}
        for layer in layers:
            headers |= {f"usr/include/{header.relative_to(source / layer / 'include')}"
                        for header in (source / layer / "include").rglob("*.hpp")}
        cmake = f"{self.libraries}/cmake/Octetra"
        expected = headers | {f"{cmake}/OctetraConfig.cmake", f"{cmake}/OctetraConfigVersion.cmake",
                              f"{cmake}/FindMETIS.cmake", f"{cmake}/FindSerialHDF5.cmake"}
        for layer in layers:
            expected |= {f"{self.libraries}/liboctetra_{layer}.so",
                         f"{self.libraries}/pkgconfig/octetra-{layer}.pc",
                         f"{cmake}/Octetra-{layer}.cmake", f"{cmake}/Octetra-{layer}-none.cmake"}
        self.assertEqual(files_of("liboctetra-dev"), expected)

    def test_of_the_program_have_a_manual_page_for_each_subcommand(self):
        pages = manual_pages(finished("octetra", "--help", env=self.environment))
        self.assertEqual(files_of("octetra"),
                         {"usr/bin/octetra", *(f"usr/share/man/man1/{page}.1.gz" for page in pages)})

    def test_of_the_program_run_and_have_no_tetgen(self):
        self.assertEqual(finished("octetra", "--version", env=self.environment),
                         f"octetra {self.version}\n")
        linked = finished("ldd", stage / "usr/bin/octetra", env=self.environment)
        self.assertIn("liboctetra_core.so", linked)
        self.assertNotIn("not found", linked)
        self.assertNotIn("libtet", linked)
        refused = finished("octetra", "generate", "gear", "-o", folder / "gear.mesh",
                           env=self.environment, status=2)
        self.assertIn("this build has no TetGen", refused)

    def test_for_development_ask_for_mpi_alone(self):
        self.assertEqual(depends_of("liboctetra-dev"), {"liboctetra0.1", "libopenmpi-dev"})

    def test_can_be_installed_with_the_packages_of_the_system(self):
        planned = finished("apt-get", "--simulate", "--no-install-recommends", "install",
                           *(deb_of(package) for package in packages))
        for package in packages:
            self.assertRegex(planned, rf"(?m)^Conf {re.escape(package)} ")

    def test_build_and_run_an_example(self):
        (folder / "autopkgtest").mkdir()
        disabled = (f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON"
                    for name in ("fmt", "ZLIB", "SerialHDF5", "Boost", "METIS", "CGAL"))
        printed = finished("debian/tests/build-an-example", *disabled, cwd=folder / "octetra",
                           env=self.environment)
        self.assertIn("as a refinement of", printed)

    def test_have_nothing_that_lintian_warns_of(self):
        changes, = folder.glob("*.changes")
        finished("lintian", "--allow-root", "--fail-on", "error,warning", changes)


if __name__ == "__main__":
    skip_unless_ready()
    unittest.main(argv=sys.argv[:1], verbosity=2)
