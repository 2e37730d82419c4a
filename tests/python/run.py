"""run.py FILE...: runs these tests by pytest; exits with 77, which ctest takes for skipped, if a
package is missing. With --gtest_list_tests it prints the names of the cases for tools/claims.py,
like the other test programs."""

import ast
import importlib
import os
import pathlib
import sys

if sys.argv[-1] == "--gtest_list_tests":
    for path in map(pathlib.Path, sys.argv[1:-1]):
        print(path.stem.removeprefix("test_") + ".")
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                print("  " + node.name)
    sys.exit()

if not pathlib.Path(os.environ["PYTHONPATH"], "octetra").exists():
    print("skipped: the Python module is not built")
    sys.exit(77)
for package in ("pytest", "numpy", "mpi4py"):
    try:
        importlib.import_module(package)
    except ImportError:
        print(f"skipped: there is no {package} (Debian: python3-{package})")
        sys.exit(77)

import pytest

status = pytest.main(["-q", "-rs", "--color=no", "--tb=short", "-p", "no:cacheprovider",
                      *sys.argv[1:]])
sys.exit(77 if status == pytest.ExitCode.NO_TESTS_COLLECTED else status)
