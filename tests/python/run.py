"""run.py FILE...: these tests by pytest; 77, for ctest to call it skipped, where a package is not there."""

import importlib
import sys

for package in ("pytest", "numpy", "mpi4py"):
    try:
        importlib.import_module(package)
    except ImportError:
        print(f"skipped: there is no {package} (Debian: python3-{package})")
        sys.exit(77)

import pytest

sys.exit(pytest.main(["-q", "--color=no", "--tb=short", "-p", "no:cacheprovider", *sys.argv[1:]]))
