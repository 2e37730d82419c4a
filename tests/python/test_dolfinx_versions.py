"""Versions of DOLFINx that octetra.dolfinx refuses, by packages that have nothing but a version."""

import importlib.util
import os
import subprocess
import sys

import pytest

if importlib.util.find_spec("octetra.dolfinx") is None:
    pytest.skip("octetra.dolfinx is not built", allow_module_level=True)


def refusal(folder, version, *, module="octetra.dolfinx"):
    """The last line of standard error of the import."""
    (folder / "dolfinx.py").write_text(f'__version__ = "{version}"\n')
    paths = os.pathsep.join([str(folder), os.environ["PYTHONPATH"]])
    done = subprocess.run([sys.executable, "-c", f"import {module}"], check=False, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": paths})
    assert done.returncode != 0
    return done.stderr.splitlines()[-1]


@pytest.mark.parametrize("version", ("0.6.0", "0.8.0", "0.12.0.0", "1.0.0"))
def test_a_version_that_is_not_supported_is_named_with_those_that_are(tmp_path, version):
    assert refusal(tmp_path, version) == (
        f"ImportError: octetra.dolfinx: DOLFINx {version} is installed; "
        "supported are 0.9, 0.10 and 0.11, and 0.5.2 by a compiled adapter")


@pytest.mark.parametrize("version", ("0.9.0", "0.10.0.post5", "0.11.0"))
def test_a_supported_version_is_taken(tmp_path, version):
    assert "DOLFINx" not in refusal(tmp_path, version)  # the package here has no more than the version


def test_without_the_compiled_adapter_its_version_is_refused(tmp_path):
    hide = "import sys; sys.modules['octetra._dolfinx'] = None; import octetra.dolfinx"
    (tmp_path / "hidden.py").write_text(hide)
    assert "built without the adapter" in refusal(tmp_path, "0.5.2", module="hidden")
