"""python3 -m octetra is the command line, from the build tree and installed; the tutorial runs."""

import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from conftest import PROGRAM, run_alone

import octetra

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = (SOURCE / "docs/python.md").read_text()
BUILD = pathlib.Path(octetra.__file__).resolve().parents[2]


def run(*words, **options):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True,
                          check=False, **options)


def test_the_command_line_is_that_of_the_program(tmp_path):
    for words in (["--help"], ["refine", "--all"], ["info", "no.mesh"], ["generate", "kuhn", "2", "-o",
                  tmp_path / "cube.mesh"], ["verify", tmp_path / "cube.mesh", "--fast"]):
        by_module, itself = run(sys.executable, "-m", "octetra", *words), run(PROGRAM, *words)
        assert by_module.returncode == itself.returncode, words
        if "verify" not in words:  # its output contains times
            assert (by_module.stdout, by_module.stderr) == (itself.stdout, itself.stderr), words


def test_the_command_line_runs_on_several_ranks(tmp_path, mpirun):
    run_alone(PROGRAM, "generate", "kuhn", "4", "-o", tmp_path / "cube.mesh")
    words = ["refine", tmp_path / "cube.mesh", "--sphere", "0,0,0,0.5", "-o"]
    said = run_alone(mpirun, 2, sys.executable, "-m", "octetra", *words, tmp_path / "two.mesh")
    assert "2 ranks" in said
    run_alone(PROGRAM, *words, tmp_path / "one.mesh")
    assert (tmp_path / "one.mesh").read_bytes() == (tmp_path / "two.mesh").read_bytes()


@pytest.fixture
def site(tmp_path):
    """The installed module, below tmp_path/prefix."""
    run_alone("cmake", "--install", BUILD, "--prefix", tmp_path / "prefix", "--component", "python")
    found = list((tmp_path / "prefix").rglob("octetra/__init__.py"))
    assert len(found) == 1
    return found[0].parents[1]


def test_the_module_works_where_it_is_installed(site, tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(site)}
    test = "import octetra; print(octetra.__file__)"
    assert run(sys.executable, "-c", test, env=environment).stdout.startswith(str(site))
    assert {path.name for path in (site / "octetra").iterdir()} >= {"py.typed", "_octetra", "mark.py"}
    version = [sys.executable, "-m", "octetra", "--version"]
    nowhere = run(*version, env={**environment, "PATH": "/nowhere"})
    assert nowhere.returncode == 1 and "no program" in nowhere.stderr
    (tmp_path / "prefix/bin").mkdir()
    shutil.copy(PROGRAM, tmp_path / "prefix/bin/octetra")
    beside = run(*version, env={**environment, "PATH": "/nowhere"})
    assert beside.stdout == run(PROGRAM, "--version").stdout


def test_the_tutorial_makes_the_same_files_on_any_number_of_ranks(tmp_path, mpirun):
    pytest.importorskip("matplotlib", reason="there is no matplotlib (Debian: python3-matplotlib)")
    image = pytest.importorskip("matplotlib.image")
    run_alone(sys.executable, "-m", "octetra", "generate", "gear", "-o", tmp_path / "gear.mesh")
    tutorial = [sys.executable, SOURCE / "examples/python/tutorial.py", tmp_path / "gear.mesh"]
    said, files = [], []
    for ranks in (1, 2):
        folder = tmp_path / str(ranks)
        folder.mkdir()
        words = tutorial if ranks == 1 else [mpirun, ranks, *tutorial]
        said.append(run_alone("sh", "-c", 'cd "$0" && exec "$@"', folder, *words))
        files.append([(folder / name).read_bytes() for name in ("tutorial.vtu", "tutorial.octetra")])
        pixels = image.imread(folder / "angles.png")
        assert min(pixels.shape[:2]) > 300 and pixels[..., :3].std() > 0.05  # not blank
    assert (tmp_path / "1/surface.png").stat().st_size > 10_000
    assert f"```text\n{said[0]}```" in PAGE and said[0] == said[1]
    assert files[0] == files[1]


def test_the_heart_of_the_tutorial_runs_as_the_page_shows_it(tmp_path, monkeypatch):
    run_alone(PROGRAM, "generate", "gear", "-o", tmp_path / "gear.mesh")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(SOURCE / "examples/python")
    names = {"octetra": octetra, "np": np, "front": importlib.import_module("tutorial").front}
    step, going_on, conditions = re.findall("```python\n(.*?)```", PAGE, re.DOTALL)
    exec(step, names)
    finer = len(names["mesh"].cells)
    assert len(names["u"]) == len(names["mesh"].points) > 1026
    assert (tmp_path / "tutorial.vtu").exists() and (tmp_path / "tutorial.octetra").exists()
    exec(conditions, names)
    low = names["mesh"].points[:, 2] < 0.1
    assert low.any() and np.all(low[names["wet"]]) and names["wet"].any()
    marked = names["mesh"].vertices_of(3)
    assert marked.any() and np.all(names["u"][marked] == 1)
    exec(going_on, names)
    assert len(names["volumes"]) == len(names["mesh"].cells) < finer
    assert np.allclose(names["volumes"], octetra.quality.volume(names["mesh"]), rtol=1e-12)
    assert (tmp_path / "coarser.octetra").exists()
