#!/usr/bin/python3
"""Writes the sample Medit solution files in this folder, without Octetra: for a mesh of two cells, with
the field x + 2 y + 4 z, its gradient and a tensor on vertices, and numbers on cells.

usage: write_fields.py FOLDER
"""
import struct
import sys
from pathlib import Path

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
CELLS = [(1, 2, 3, 4), (2, 3, 4, 5)]
TYPES = (1, 2, 3)
VERTICES = [(x + 2 * y + 4 * z, 1, 2, 4, 1 + x, 0.5 * y, 2, 0, -0.25 * z, 3) for x, y, z in POINTS]
NUMBERS = [(10.5,), (-11.25,)]


def text():
    rows = ["MeshVersionFormatted 2", "Dimension", "3", ""]
    for keyword, types, values in (("SolAtVertices", TYPES, VERTICES), ("SolAtTetrahedra", (1,), NUMBERS)):
        rows += [keyword, str(len(values)), f"{len(types)} " + " ".join(map(str, types))]
        rows += [" ".join(map(repr, row)) for row in values] + [""]
    return "\n".join(rows) + "End\n"


def binary(version, order):
    position, count, real = ("i" if version < 3 else "q"), ("i" if version < 4 else "q"), ("f" if version < 2 else "d")
    data = struct.pack(order + "ii", 1, version)

    def section(code, body):
        following = len(data) + struct.calcsize("=i" + position) + len(body)
        return data + struct.pack(order + "i" + position, code, following) + body

    data = section(3, struct.pack(order + "i", 3))
    for code, types, values in ((62, TYPES, VERTICES), (66, (1,), NUMBERS)):
        body = struct.pack(order + count, len(values)) + struct.pack(f"{order}{1 + len(types)}i", len(types), *types)
        data = section(code, body + b"".join(struct.pack(f"{order}{len(row)}{real}", *row) for row in values))
    return data + struct.pack(order + "i" + position, 54, 0)


def mesh():
    points = [f"{x} {y} {z} 0" for x, y, z in POINTS]
    cells = [" ".join(map(str, cell)) + " 0" for cell in CELLS]
    return "\n".join(["MeshVersionFormatted 2", "Dimension 3", "Vertices", "5", *points, "Tetrahedra", "2", *cells, "End", ""])


def main():
    folder = Path(sys.argv[1])
    (folder / "two-cells.mesh").write_text(mesh())
    (folder / "two-cells.sol").write_text(text())
    for version in (1, 2, 3, 4):
        for name, order in (("little", "<"), ("big", ">")):
            (folder / f"two-cells-{version}-{name}.solb").write_bytes(binary(version, order))


if __name__ == "__main__":
    main()
