"""examples/python/moving_front.py: the same meshes on any number of ranks, and conservation of
heat."""

import os
import pathlib
import sys

import numpy as np
import pytest
from conftest import PROGRAM, run_alone

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/python/moving_front.py"
MPIRUN = os.environ["OCTETRA_MPIRUN"]
CYCLES = 5


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """{ranks: (output, folder of its files)}"""
    pytest.importorskip("matplotlib", reason="there is no matplotlib (Debian: python3-matplotlib)")
    folder = tmp_path_factory.mktemp("front")
    run_alone(PROGRAM, "generate", "kuhn", "4", "-o", folder / "cube.mesh")
    made = {}
    for ranks in (1, 2, 4):
        (folder / str(ranks)).mkdir()
        said = run_alone("sh", "-c", 'cd "$0" && exec "$@"', folder / str(ranks), MPIRUN, ranks,
                         sys.executable, EXAMPLE, "../cube.mesh", CYCLES, "front")
        made[ranks] = said.splitlines(), folder / str(ranks)
    return made


def test_the_meshes_are_the_same_on_any_number_of_ranks(runs):
    cells = {ranks: [line.split()[:2] for line in said] for ranks, (said, _) in runs.items()}
    assert len(cells[1]) == CYCLES + 2
    assert cells[2] == cells[1] and cells[4] == cells[1]
    last = [(folder / "front.mesh").read_bytes() for _, folder in runs.values()]
    assert last == [last[0]] * 3


def test_most_ranks_have_few_cells_more_than_the_mean(runs):
    for ranks, (said, _) in runs.items():
        assert all(float(line.split()[2]) <= (1.0 if ranks == 1 else 1.3) for line in said[1:-1])


def test_the_bottom_is_drawn(runs):
    image = pytest.importorskip("matplotlib.image")
    for _, folder in runs.values():
        pixels = image.imread(folder / "front.png")
        assert pixels.shape[1] > 900 and pixels[..., :3].std() > 0.05  # not blank


def volumes_of(corners):
    a, b, c, d = np.moveaxis(corners, 1, 0)
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def test_heat_grows_behind_the_front_and_cells_are_small_there(runs):
    h5py = pytest.importorskip("h5py", reason="there is no h5py (Debian: python3-h5py)")
    for said, folder in runs.values():
        assert said[-1] == "heat is conserved up to rounding"
        assert all(float(line.split()[-1]) < 1e-12 for line in said[1:-1])
        with h5py.File(folder / "front.vtkhdf") as file:
            root, heat = file["VTKHDF"], 0.0
            points, cells = root["NumberOfPoints"][:], root["NumberOfCells"][:]
            assert cells.tolist() == [int(line.split()[1]) for line in said[1:-1]]
            all_points = np.split(root["Points"][:], np.cumsum(points)[:-1])
            all_corners = np.split(root["Connectivity"][:].reshape(-1, 4), np.cumsum(cells)[:-1])
            densities = np.split(root["CellData/density"][:], np.cumsum(cells)[:-1])
        for step, (point, corner, density) in enumerate(zip(all_points, all_corners, densities)):
            volumes, middles = volumes_of(point[corner]), point[corner].mean(axis=1)
            centre = [0.2 + 0.6 * (step + 1) / CYCLES, 0.5, 0]
            depth = np.abs(np.linalg.norm(middles - centre, axis=1) - 0.2) / 0.01
            before, heat = heat, density @ volumes
            left = volumes @ np.exp(-depth**2)
            assert abs(heat - before - left) < 1e-12 * heat and left > 0
            assert np.cbrt(volumes[depth < 1].max()) < 0.01
            assert np.cbrt(volumes.max()) > 0.03  # far from the front
