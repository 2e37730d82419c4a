"""Octetra for Spack, 0.23 or later: `spack repo add packaging/spack`, then `spack install octetra`."""

import pathlib

from spack.package import *

try:  # from Spack 1.0 on; spack.package provides it before
    from spack_repo.builtin.build_systems.cmake import CMakePackage
except ImportError:
    pass


class Octetra(CMakePackage):
    """Parallel refinement of tetrahedral meshes by longest-edge bisection (8T-LE), the same on any number
    of MPI ranks, with a verifier that decides by exact arithmetic."""

    # Builds the repository that contains this recipe: its branch main, as committed.
    git = pathlib.Path(__file__).resolve().parents[4].as_uri()

    license("BSD-3-Clause", when="~tetgen")
    license("AGPL-3.0-or-later", when="+tetgen")

    version("main", branch="main")

    variant("shared", default=True, description="Build shared libraries")
    variant("distributed", default=True, description="Build the distributed engine")
    variant("verify", default=True, description="Build the verifier")
    variant("cli", default=True, description="Build the program octetra and its manual pages")
    variant("tetgen", default=False,
            description="Generate solids and Delaunay meshes; the program is then under the AGPL")

    conflicts("+cli", when="~distributed", msg="the program requires all layers: ~distributed requires ~cli")
    conflicts("+cli", when="~verify", msg="the program requires all layers: ~verify requires ~cli")
    conflicts("+tetgen", when="~cli", msg="only the program generates meshes: ~cli requires ~tetgen")
    conflicts("%gcc@:9", msg="Octetra is C++20")

    generator("ninja")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("fmt")
    depends_on("zlib-api")
    depends_on("hdf5~mpi")
    depends_on("boost")  # headers only
    depends_on("xxhash")  # headers only
    depends_on("muparser")
    with when("+distributed"):
        depends_on("mpi")
        depends_on("metis@5:~int64")
        depends_on("pkgconfig", type="build")
    with when("+verify"):
        depends_on("cgal@5.5:6")
    with when("+cli"):
        depends_on("cli11")
        depends_on("nlohmann-json")
        depends_on("help2man", type="build")
        depends_on("python@3:", type="build")
    depends_on("tetgen@1.5:1.5", when="+tetgen")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("OCTETRA_DISTRIBUTED", "distributed"),
            self.define_from_variant("OCTETRA_VERIFY", "verify"),
            self.define_from_variant("OCTETRA_CLI", "cli"),
            self.define_from_variant("OCTETRA_TETGEN", "tetgen"),
            self.define("OCTETRA_PYTHON_MODULE", False),
            self.define("OCTETRA_DOLFINX", False),
            self.define("OCTETRA_PETSC", False),
            self.define("OCTETRA_TESTS", False),  # require RapidCheck, which Spack does not provide
            self.define("OCTETRA_BENCH", False),
        ]
