"""The type stubs agree with the module: checked by stubtest, which cannot see the parameters of
compiled functions, and with the signatures that pybind11 puts into their docstrings; mypy checks
uses of them."""

import ast
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
    # Few classes have a constructor; that which pybind11 adds to the others raises an error. The
    # imports of octetra.petsc are not its own.
    names = [r"octetra\.(\w+\.)?\w+\.__init__", r"octetra\.petsc\.NamedTuple"]
    if (package / "dolfinx.py").exists() and importlib.util.find_spec("dolfinx") is None:
        names.append(r"octetra\.dolfinx")  # built with headers only: nothing to import
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


def functions_of_stub(path):
    """{name, or Class.name: its parameters} of a stub."""
    found = {}

    def visit(body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                visit(node.body, node.name + ".")
            elif isinstance(node, ast.FunctionDef) and not node.decorator_list:
                found[prefix + node.name] = node.args

    visit(ast.parse(path.read_text()).body, "")
    return found


def parameters_of_stub(args):
    optional = [False] * (len(args.args) - len(args.defaults)) + [True] * len(args.defaults)
    return ([(a.arg, o, False) for a, o in zip(args.args, optional)] +
            [(a.arg, d is not None, True) for a, d in zip(args.kwonlyargs, args.kw_defaults)])


def parameters_of_docstring(doc):
    """The parameters in `name(self: Mesh, marks: object = None, *, scheme: str = '8t') -> ...`."""
    inside = re.match(r"\w+\((.*)\) -> .*", doc.splitlines()[0])[1]
    inside = re.sub(r"\[[^]]*\]", "", re.sub(r"\[[^][]*\]", "", inside))
    found, only_keyword = [], False
    for word in filter(None, inside.split(", ")):
        if word == "*":
            only_keyword = True
        else:
            found.append((word.split(":")[0], " = " in word, only_keyword))
    return found


@pytest.mark.parametrize("name, stub", [("_octetra", "__init__"), ("_octetra.mark", "mark"),
                                        ("_octetra.quality", "quality")])
def test_parameters_of_the_stubs_are_those_of_the_functions(name, stub):
    module = importlib.import_module(f"octetra.{name}")
    functions = functions_of_stub(package / "_octetra" / f"{stub}.pyi")
    assert len(functions) > 3
    for path, args in functions.items():
        function = module
        for part in path.split("."):
            function = getattr(function, part)
        if not path.endswith("__"):
            assert parameters_of_stub(args) == parameters_of_docstring(function.__doc__), path


def test_everything_has_a_docstring():
    for name in (n for n in dir(octetra) if not n.startswith("_")):
        thing = getattr(octetra, name)
        assert inspect.getdoc(thing), name
        if not inspect.isclass(thing) or issubclass(thing, Exception):
            continue
        for member in (m for m in vars(thing) if not m.startswith("_")):
            assert len((getattr(thing, member).__doc__ or "").strip()) > 0, f"{name}.{member}"
