#!/usr/bin/python3
"""Compares the fields that VTK finds in files with those that tools/read_checkpoint.py finds in a
checkpoint of the same mesh.

usage: check_fields.py TOOLS STATE.octetra FILE...

A field has its own name, followed by `_field` if an array of the mesh has this name; in .vtkhdf
files | replaces /. Exit status: 0 all files have all fields with the same values; 1 a file has not,
which is reported.
"""
import sys
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, sys.argv[1])
import check_vtu  # noqa: E402
import read_checkpoint  # noqa: E402

def array_of(path, data, name):
    """The name of the field's array, which differs from those of the mesh's own arrays."""
    if path.endswith(".vtkhdf"):
        name = name.replace("/", "|")
    return data.GetArray(name + "_field") or data.GetArray(name)


def places_of_cells(grid, numbers, cells):
    """For each cell of the grid, its number in the checkpoint."""
    number_of = {tuple(sorted(cell)): c for c, cell in enumerate(cells.tolist())}
    return [number_of[tuple(sorted(numbers[cell].tolist()))] for cell in check_vtu.connectivity(grid)]


def differences(path, cells, on_vertices, on_cells):
    grid, complaints = check_vtu.read(path)
    if complaints:
        return complaints
    if path.endswith(".pvtu"):
        # Numbers are relative to the least one, which is the index base of the mesh.
        numbers = vtk_to_numpy(grid.GetPointData().GetArray("vertex"))
        numbers = numbers - numbers.min()
        rows = {"vertices": numbers, "cells": places_of_cells(grid, numbers, cells)}
    else:
        rows = {"vertices": slice(None), "cells": slice(None)}
    wrong = []
    for on, data, fields in (("vertices", grid.GetPointData(), on_vertices),
                             ("cells", grid.GetCellData(), on_cells)):
        for name, values in fields.items():
            array = array_of(path, data, name)
            if array is None:
                wrong.append(f"{path} has no array {name}")
                continue
            found = vtk_to_numpy(array)
            expected = values.reshape(len(values), -1)[rows[on]]
            same = found.dtype == expected.dtype and numpy.array_equal(found.reshape(len(found), -1), expected)
            if not same:
                wrong.append(f"{path}: {name} on {on} differs")
    return wrong


def main():
    _, *rest = read_checkpoint.read(sys.argv[2])
    assert any(rest[1:])
    wrong = [what for path in sys.argv[3:] for what in differences(path, *rest)]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
