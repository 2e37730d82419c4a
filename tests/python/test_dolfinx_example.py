"""The example of adaptive finite elements in DOLFINx, and the tutorial of docs/dolfinx.md."""

import pathlib
import re
import sys

import pytest
from conftest import run_alone

pytest.importorskip("dolfinx", reason="there is no dolfinx (Debian: python3-dolfinx-real)")
pytest.importorskip("octetra.dolfinx", reason="the adapter to DOLFINx is not built")

source = pathlib.Path(__file__).resolve().parents[2]
example = source / "examples/dolfinx/adaptive_poisson.py"


def rows(mpirun, ranks, *words):
    told = run_alone(mpirun, ranks, sys.executable, example, *words)
    return [[float(word) for word in line.split()] for line in told.splitlines()[1:]]


def test_the_example_converges_and_refines_evenly_on_any_number_of_ranks(mpirun):
    for ranks in (1, 2, 4):
        table = rows(mpirun, ranks, "--refine", "octetra", "--steps", 5)
        assert len(table) == 6
        assert table[0][:2] == [144, 63]
        cells, unknowns, error, estimator, rate, most = table[-1][:6]
        assert 40_000 < cells < 80_000
        assert -0.36 < rate < -0.29  # in theory -1/3
        assert 2 < estimator / error < 3
        assert most < 1.3


def test_the_example_also_refines_by_dolfinx(mpirun):
    ours = rows(mpirun, 1, "--refine", "octetra", "--steps", 4)
    theirs = rows(mpirun, 1, "--refine", "dolfinx", "--steps", 4)
    for a, b in zip(ours, theirs):
        assert a[0] == pytest.approx(b[0], rel=0.2)
        assert a[2] == pytest.approx(b[2], rel=0.1)


def test_the_tutorial_prints_the_output_of_the_page(folder, mpirun):
    page = (source / "docs/dolfinx.md").read_text()
    program = re.search(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)[1]
    expected = re.search(r"^\$ python3 first.py\n(.*\n)", page, re.MULTILINE)[1]
    (folder / "first.py").write_text(program)
    for ranks in (1, 2):
        assert run_alone(mpirun, ranks, sys.executable, folder / "first.py") == expected
