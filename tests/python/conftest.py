"""Common parts of the tests of the module. All ranks run the same cases in the same order; if one
fails, all end, because the others may be waiting for it."""

import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np
import pytest
from mpi4py import MPI

import octetra

PROGRAM = os.environ["OCTETRA_PROGRAM"]
world = MPI.COMM_WORLD


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    outcome = yield
    report = outcome.get_result()
    if report.failed and world.size > 1:
        print(f"rank {world.rank}: {item.nodeid}\n{report.longreprtext}", flush=True)
        world.Abort(1)


@pytest.fixture
def folder():
    """An empty folder for all ranks together."""
    made = world.bcast(tempfile.mkdtemp(prefix="octetra-python-") if world.rank == 0 else None)
    yield pathlib.Path(made)
    world.Barrier()
    if world.rank == 0:
        shutil.rmtree(made)


def run_alone(*words):
    """Runs a program outside the communicator of the ranks, which MPI's variables would make it
    join."""
    alone = {name: value for name, value in os.environ.items()
             if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
    done = subprocess.run([*map(str, words)], env=alone, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def command(*words):
    """Runs the program octetra on the first rank, while the others wait."""
    if world.rank == 0:
        run_alone(PROGRAM, *words)
    world.Barrier()


@pytest.fixture
def mpirun():
    """The command that runs a program on several ranks; for tests that one rank runs alone."""
    return os.environ["OCTETRA_MPIRUN"]


@pytest.fixture
def cube(folder):
    """The path of a small mesh with tagged facets."""
    path = folder / "cube.mesh"
    command("generate", "kuhn", "4", "-o", path)
    return path


@pytest.fixture
def mesh(cube):
    return octetra.read(cube)


@pytest.fixture
def composite(folder):
    """A mesh of two regions, with marked facets on its sides and between the regions."""
    command("generate", "two-material", "-o", folder / "composite.mesh")
    return octetra.read(folder / "composite.mesh")


def centroids(mesh):
    return mesh.points[mesh.cells].mean(axis=1)


def near(mesh, radius):
    """A boolean for each cell: whether its centroid is within the radius of the origin."""
    return np.linalg.norm(centroids(mesh), axis=1) < radius


def total(number):
    return world.allreduce(number)
