"""The type stubs match the module, signatures included, by stubtest; and mypy checks uses of them."""

import importlib.util
import inspect
import pathlib
import re
import subprocess
import sys

import pytest

import octetra

package = pathlib.Path(octetra.__file__).parent
pytest.importorskip("mypy", reason="there is no mypy (Debian: mypy)")


def run(*words, cwd):
    done = subprocess.run(words, capture_output=True, text=True, cwd=cwd, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_of_what_is_there(tmp_path):
    allowed = tmp_path / "allowed.txt"
    # Few classes have a constructor; those of the others raise an error. What octetra.petsc imports is not
    # its own.
    names = [r"octetra\.(\w+\.)?\w+\.__(init|new)__", r"octetra\.petsc\.NamedTuple"]
    names.append(r"octetra\.dolfinx\._(compiled|from_mesh|to_mesh)")  # for some versions of DOLFINx each
    if importlib.util.find_spec("dolfinx") is None:
        names.append(r"octetra\.dolfinx(\.\w+)?")
    allowed.write_text("\n".join(names) + "\n")
    run(sys.executable, "-m", "mypy.stubtest", "octetra", "--allowlist", str(allowed),
        "--ignore-unused-allowlist", cwd=tmp_path)


USES = """
import numpy as np
import octetra

mesh: octetra.Mesh = octetra.read("cube.mesh", None, partition="rcb")
step: octetra.Adaptation = mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.5), scheme="8t")
u = step.transfer_vertices(mesh.points[:, 0])
mesh.refine([True, False])
mesh.refine(cells=np.arange(3))
move, step = mesh.refine_evenly(np.zeros(3, np.int8))
reveal_type(mesh.cells)
reveal_type(mesh.number_edges().sharing.owners)
if mesh.verify():
    mesh.save("state.octetra", vertex_fields={"u": u})
"""


def test_uses_of_the_module_are_checked_by_mypy(tmp_path):
    (tmp_path / "uses.py").write_text(USES)
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "uses.py"], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    assert "signedinteger" in done.stdout and "unsignedinteger" not in done.stdout
    (tmp_path / "uses.py").write_text(USES + "mesh.refine(marks=mesh)\nmesh.cell\n")
    done = subprocess.run([sys.executable, "-m", "mypy", "uses.py"], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert len(re.findall("error:", done.stdout)) == 2


def test_everything_has_a_docstring():
    for name in (n for n in dir(octetra) if not n.startswith("_")):
        thing = getattr(octetra, name)
        assert inspect.getdoc(thing), name
        if not inspect.isclass(thing) or issubclass(thing, Exception):
            continue
        for member in (m for m in vars(thing) if not m.startswith("_")):
            assert len((getattr(thing, member).__doc__ or "").strip()) > 0, f"{name}.{member}"
