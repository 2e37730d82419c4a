#!/usr/bin/python3
"""Reads a .vtu, .pvtu or .vtkhdf file with VTK, independently of Octetra, and prints its contents as JSON.

    points, cells     their numbers
    cell_types        {VTK cell type number: number of cells}; a tetrahedron is 10
    signed_volume     the sum over all tetrahedra, correctly rounded from the volumes of each
    min_signed_volume the smallest of them, or null; negative for an inverted cell
    point_data,       [{name, type, components, range}, ...] in the file's order; range has one
    cell_data         [smallest, largest] for each component, or is null for an array without values
    global_ids        the name of the point array with global numbers, or null
    coordinates_type  of the points: "double" unless the writer lost precision

--values prints the arrays instead, sorted by name: for each array a line with its name and a line
with its values, reals as hexadecimal floats. --points prints the coordinates, one vertex per line,
as hexadecimal floats; --cells prints the vertex numbers, one cell per line. Both are exact, to be
compared as text. --by-number requires global numbers of the points in the point data `vertex`; it
prints a line "p number x y z marker" for each distinct point, and a line "c number number number
number" for each cell, in ascending order of the lines.

Exit status: 0 read without any message; 1 VTK reported an error, or a cell has a vertex number out
of range; 2 wrong usage.
"""

import argparse
import collections
import json
import math
import os
import sys

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import VTK_TETRA
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader


def read(path):
    """Returns the grid of the file, and the messages of VTK."""
    complaints = []

    def note(source, event, text):
        complaints.append(text.strip())

    note.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        vtkOutputWindow.GetInstance().AddObserver(event, note)
    vtkOutputWindow.GetInstance().SetDisplayModeToNever()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)

    readers = {".vtu": vtkXMLUnstructuredGridReader, ".pvtu": vtkXMLPUnstructuredGridReader, ".vtkhdf": vtkHDFReader}
    extension = os.path.splitext(path)[1]
    reader = readers[extension]()
    # The parser and other parts of the reader report errors through the output window; the reader
    # itself reports them to observers.
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, note)
    if not os.path.isfile(path):
        return None, [f"{path}: no such file"]
    if not reader.CanReadFile(path):
        return None, [f"{path}: VTK does not recognise it as a {extension} file"]
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode() != 0:
        complaints.append(f"{path}: VTK error code {reader.GetErrorCode()}")
    return reader.GetOutput(), complaints


def connectivity(grid):
    """For each cell, its vertex numbers."""
    if grid.GetNumberOfCells() == 0:
        return
    vertices = memoryview(grid.GetCells().GetConnectivityArray()).tolist()
    ends = memoryview(grid.GetCells().GetOffsetsArray()).tolist()
    for begin, end in zip(ends, ends[1:]):
        yield vertices[begin:end]


def strays(grid):
    """Returns a message about the first cell with a vertex number out of range. (VTK gives none.)"""
    last = grid.GetNumberOfPoints() - 1
    for i, vertices in enumerate(connectivity(grid)):
        if min(vertices) < 0 or max(vertices) > last:
            return [f"cell {i} has vertices {vertices}, but the last vertex is {last}"]
    return []


def coordinates(grid):
    if grid.GetNumberOfPoints() == 0:
        return []
    return memoryview(grid.GetPoints().GetData()).tolist()


def by_number(grid):
    """The mesh that the pieces form, as lines."""
    numbers = memoryview(grid.GetPointData().GetArray("vertex")).tolist()
    marker = grid.GetPointData().GetArray("marker")
    markers = memoryview(marker).tolist() if marker else [None] * len(numbers)
    points = {f"p {n} {' '.join(map(float.hex, p))} {m}"
              for n, p, m in zip(numbers, coordinates(grid), markers)}
    cells = [f"c {' '.join(str(numbers[v]) for v in cell)}" for cell in connectivity(grid)]
    return sorted(points) + sorted(cells)


def cell_types(grid):
    counts = collections.Counter(grid.GetCellType(i) for i in range(grid.GetNumberOfCells()))
    return {str(kind): counts[kind] for kind in sorted(counts)}


def signed_volumes(grid):
    points = coordinates(grid)
    for i, vertices in enumerate(connectivity(grid)):
        if grid.GetCellType(i) != VTK_TETRA:
            continue
        a, *others = (points[v] for v in vertices)
        u, v, w = ([q - p for p, q in zip(a, other)] for other in others)
        yield (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
               + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


def arrays(data):
    described = []
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        components = array.GetNumberOfComponents()
        has_range = array.GetNumberOfTuples() > 0 and hasattr(array, "GetRange")
        described.append({
            "name": array.GetName(),
            "type": array.GetDataTypeAsString(),
            "components": components,
            "range": [array.GetRange(c) for c in range(components)] if has_range else None,
        })
    return described


def name_of(array):
    return array.GetName() if array else None


def values(data):
    """The arrays as lines, independent of their order in the file."""
    lines = []
    found = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    for array in sorted(found, key=lambda array: array.GetName()):
        # Readers choose different ones of two equivalent 64-bit types.
        lines.append(f"{array.GetName()} {array.GetDataTypeSize()} {array.GetNumberOfComponents()}")
        rows = memoryview(array).tolist()
        flat = [x for row in rows for x in (row if isinstance(row, list) else [row])]
        lines.append(" ".join(x.hex() if isinstance(x, float) else str(x) for x in flat))
    return lines


def summary(grid):
    volumes = list(signed_volumes(grid))
    return {
        "points": grid.GetNumberOfPoints(),
        "cells": grid.GetNumberOfCells(),
        "cell_types": cell_types(grid),
        "signed_volume": math.fsum(volumes),
        "min_signed_volume": min(volumes, default=None),
        "point_data": arrays(grid.GetPointData()),
        "cell_data": arrays(grid.GetCellData()),
        "global_ids": name_of(grid.GetPointData().GetGlobalIds()),
        "coordinates_type": grid.GetPoints().GetData().GetDataTypeAsString() if grid.GetPoints() else None,
    }


def main():
    parser = argparse.ArgumentParser(
        description="Print what VTK reads in a .vtu or .vtkhdf file, as JSON.",
        epilog="example: check_vtu.py fine.vtu --points | sha256sum")
    parser.add_argument("file", metavar="FILE.vtu")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--points", action="store_true", help="coordinates, as hexadecimal floats")
    what.add_argument("--cells", action="store_true", help="vertex numbers of the cells")
    what.add_argument("--values", action="store_true", help="values of the arrays of points and cells")
    what.add_argument("--by-number", action="store_true", help="points and cells by global numbers")
    options = parser.parse_args()

    grid, complaints = read(options.file)
    complaints = complaints or strays(grid)
    if complaints:
        print("\n".join(complaints), file=sys.stderr)
        return 1
    if options.points:
        for point in coordinates(grid):
            print(*map(float.hex, point))
    elif options.cells:
        for vertices in connectivity(grid):
            print(*vertices)
    elif options.values:
        print(*values(grid.GetPointData()), *values(grid.GetCellData()), sep="\n")
    elif options.by_number:
        print(*by_number(grid), sep="\n")
    else:
        print(json.dumps(summary(grid), indent=2))
    return 0


if __name__ == "__main__":
    sys.exit(main())
