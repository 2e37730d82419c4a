"""The packaging recipes agree with the build: Spack's and EasyBuild's, evaluated without these, those of
conda-forge and Debian, and the settings of the wheel."""

import importlib.util
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import types
import unittest
import unittest.mock
import urllib.parse

source = pathlib.Path(sys.argv[1])
lists = (source / "CMakeLists.txt").read_text()
version = re.search(r"project\(Octetra VERSION (\S+)", lists)[1]
sought = set(re.findall(r"find_package\((\w+)", lists))
options = set(re.findall(r"^option\((\w+)", lists, re.MULTILINE))
settings = tomllib.loads((source / "pyproject.toml").read_text())

# Spack's names of the packages sought by find_package().
SPACK_NAMES = {"fmt": "fmt", "ZLIB": "zlib-api", "SerialHDF5": "hdf5",
               "Boost": "boost", "xxHash": "xxhash", "muparser": "muparser", "MPI": "mpi", "METIS": "metis",
               "CGAL": "cgal", "CLI11": "cli11", "nlohmann_json": "nlohmann-json"}
# EasyBuild's names; MPI is part of its toolchain.
EASYBUILD_NAMES = {"fmt": "fmt", "ZLIB": "zlib", "SerialHDF5": "HDF5",
                   "Boost": "Boost", "xxHash": "xxHash", "muparser": "muParser", "METIS": "METIS",
                   "CGAL": "CGAL", "CLI11": "CLI11", "nlohmann_json": "nlohmann_json"}
# The names of conda-forge.
CONDA_NAMES = {"fmt": "fmt", "ZLIB": "zlib", "SerialHDF5": "hdf5",
               "Boost": "libboost-headers", "xxHash": "xxhash", "muparser": "muparser", "MPI": "openmpi", "METIS": "metis",
               "CGAL": "cgal-cpp", "CLI11": "cli11", "nlohmann_json": "nlohmann_json"}


def holds(condition, variants):
    """Returns whether `+this ~that` holds; false for conditions on compilers and other properties."""
    words = re.findall(r"([+~])(\w+)", condition)
    return bool(words) and all(variants[name] == (sign == "+") for sign, name in words)


class Recipe:
    """The relevant declarations of package.py."""

    def __init__(self, path):
        self.defaults, self.conflicts, self.dependencies = {}, [], []
        self.around = []  # conditions of `with when(...)`
        spack = types.ModuleType("spack.package")
        spack.CMakePackage = self.cmake_package()
        spack.variant = lambda name, default, description: self.defaults.update({name: default})
        spack.conflicts = lambda what, when=None, msg=None: self.conflicts.append((what, when))
        spack.depends_on = self.depends_on
        spack.when = self.when
        for name in ("version", "license", "generator"):
            setattr(spack, name, lambda *words, **options: None)
        modules = {"spack": types.ModuleType("spack"), "spack.package": spack}
        with unittest.mock.patch.dict(sys.modules, modules):
            specification = importlib.util.spec_from_file_location("recipe", path)
            module = importlib.util.module_from_spec(specification)
            specification.loader.exec_module(module)
        self.package = module.Octetra

    @staticmethod
    def cmake_package():
        class CMakePackage:
            def __init__(self, variants):
                self.variants = variants

            def define(self, option, value):
                return f"-D{option}:BOOL={'ON' if value else 'OFF'}"

            def define_from_variant(self, option, name):
                return self.define(option, self.variants[name])

        return CMakePackage

    def when(self, condition):
        class Around:
            def __enter__(_):
                self.around.append(condition)

            def __exit__(_, *error):
                self.around.pop()

        return Around()

    def depends_on(self, spec, when=None, type=None):
        conditions = [*self.around, *([when] if when else [])]
        self.dependencies.append((re.match(r"[\w-]+", spec)[0], conditions))

    def allowed(self):
        """All combinations of variants without conflicts."""
        for values in itertools.product((True, False), repeat=len(self.defaults)):
            variants = dict(zip(self.defaults, values))
            if not any(holds(what, variants) and holds(when, variants)
                       for what, when in self.conflicts if when):
                yield variants

    def dependencies_of(self, variants):
        return {name for name, conditions in self.dependencies
                if all(holds(condition, variants) for condition in conditions)}

    def options_of(self, variants):
        return self.package(variants).cmake_args()


class Spack(unittest.TestCase):
    def setUp(self):
        self.recipe = Recipe(source / "packaging/spack/packages/octetra/package.py")

    def test_recipe_builds_its_own_repository(self):
        url = urllib.parse.urlparse(self.recipe.package.git)
        self.assertEqual(url.scheme, "file")
        self.assertTrue(source.samefile(urllib.parse.unquote(url.path)))

    def test_recipe_sets_options_that_there_are(self):
        known = options | {"BUILD_SHARED_LIBS"}
        set_options = {re.match(r"-D(\w+):BOOL=(?:ON|OFF)$", option)[1]
                       for option in self.recipe.options_of(self.recipe.defaults)}
        self.assertLessEqual(set_options, known)

    def test_recipe_depends_on_all_packages_sought_by_cmake(self):
        """CMake itself reports which packages it needs when the others are declared missing."""
        self.assertEqual(sought, set(SPACK_NAMES))
        combinations = list(self.recipe.allowed())
        self.assertIn(self.recipe.defaults, combinations)
        for variants in combinations:
            if variants["shared"]:
                continue  # does not affect this
            needed = self.recipe.dependencies_of(variants)
            self.assertEqual("tetgen" in needed, variants["tetgen"])
            others = (f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON"
                      for name, spack_name in SPACK_NAMES.items() if spack_name not in needed)
            with self.subTest(**variants), tempfile.TemporaryDirectory(prefix="octetra-spack-") as folder:
                done = subprocess.run(["cmake", "-G", "Ninja", "-S", source, "-B", folder,
                                       *self.recipe.options_of(variants), *others],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)


class EasyBuild(unittest.TestCase):
    def setUp(self):
        self.path, = (source / "packaging/easybuild").glob("*.eb")
        self.recipe = {"SOURCELOWER_TAR_GZ": "", "SHLIB_EXT": "so"}
        exec(self.path.read_text(), self.recipe)

    def test_file_is_named_after_its_contents(self):
        self.assertEqual(self.recipe["version"], version)
        chain = self.recipe["toolchain"]
        self.assertEqual(self.path.stem, f"octetra-{version}-{chain['name']}-{chain['version']}")

    def test_recipe_depends_on_all_packages_sought_by_cmake(self):
        self.assertEqual(sought, set(EASYBUILD_NAMES) | {"MPI"})
        needed = {entry[0] for entry in self.recipe["dependencies"] + self.recipe["builddependencies"]}
        self.assertLessEqual({*EASYBUILD_NAMES.values(), "Python", "pybind11"}, needed)

    def test_recipe_sets_options_that_there_are(self):
        self.assertLessEqual(set(re.findall(r"-D(OCTETRA_\w+)", self.recipe["configopts"])), options)


class Wheel(unittest.TestCase):
    def test_settings_are_options_that_there_are(self):
        defined = settings["tool"]["scikit-build"]["cmake"]["define"]
        own = {name for name in defined if name.startswith("OCTETRA_")}
        self.assertLessEqual(own, options | {"OCTETRA_PYTHON_SITE"})


class CondaForge(unittest.TestCase):
    def test_recipe_depends_on_all_packages_sought_by_cmake_and_pip(self):
        text = (source / "packaging/conda-forge/recipe.yaml").read_text()
        self.assertIn(f'version: "{version}"', text)
        host = re.search(r"^  host:\n((?:    - .*\n)+)", text, re.MULTILINE)[1]
        needed = set(re.findall(r"- ([\w.-]+)", host))
        self.assertEqual(sought, set(CONDA_NAMES))
        by_pip = {re.match(r"[\w-]+", name)[0] for name in settings["build-system"]["requires"]}
        self.assertLessEqual({*CONDA_NAMES.values(), *by_pip}, needed)


class Debian(unittest.TestCase):
    """Checks that need no package to be built."""

    control = (source / "debian/control").read_text()

    def test_version_is_that_of_the_sources(self):
        changelog = (source / "debian/changelog").read_text()
        self.assertEqual(re.match(r"octetra \(([\d.]+)", changelog)[1], version)
        named = set(re.findall(r"liboctetra(\d[\d.]*)", self.control))
        self.assertEqual(named, {version.rpartition(".")[0]})

    def test_packages_to_build_with_are_those_that_dev_installs(self):
        field = re.search(r"^Build-Depends:\n((?: .*\n)+)", self.control, re.MULTILINE)[1]
        wanted = set(re.findall(r"^ ([\w.+-]+)", field, re.MULTILINE))
        sections = re.split(r"^\[(.+)\]$", (source / "packages.txt").read_text(), flags=re.MULTILINE)
        installed = {name for section, names in zip(sections[1::2], sections[2::2])
                     if section in ("build", "packages") for name in names.split()}
        self.assertLessEqual({name.replace("debhelper-compat", "debhelper") for name in wanted}, installed)
        self.assertNotIn("libtet1.5-dev", wanted)

    def test_licence_is_the_text_of_the_file(self):
        text = (source / "debian/copyright").read_text().partition("License: BSD-3-Clause\n")[2]
        words = [word for word in text.split() if word != "."]
        self.assertEqual(words, (source / "LICENSE").read_text().partition("developers\n")[2].split())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
