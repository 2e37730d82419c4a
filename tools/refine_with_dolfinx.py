#!/usr/bin/python3
"""Refines a mesh with DOLFINx, for tests of the verifier: refine_with_dolfinx.py IN.mesh OUT.mesh
[LEVELS].

Reads and writes Medit files in the form written by `octetra convert`. Refines uniformly. DOLFINx
does not keep cells positively oriented: `octetra convert --fix-orientation` corrects them. Requires
Debian's python3-dolfinx-real.
"""

import sys

import dolfinx.mesh
import numpy
import ufl
from mpi4py import MPI


def read_section(words, keyword, width, kind):
    """The entries of a section, without their references."""
    at = words.index(keyword) + 1
    count = int(words[at])
    entries = words[at + 1 : at + 1 + count * width]
    return numpy.array(entries, dtype=kind).reshape(count, width)[:, :-1]


def read(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    points = read_section(words, "Vertices", 4, numpy.float64)
    cells = read_section(words, "Tetrahedra", 5, numpy.int64) - 1
    return points, cells


def write(path, points, cells):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        for x, y, z in points:
            # repr() gives the fewest digits that are read back to the same bits.
            file.write(f"{float(x)!r} {float(y)!r} {float(z)!r} 0\n")
        file.write(f"Tetrahedra\n{len(cells)}\n")
        for corners in cells + 1:
            file.write(" ".join(str(corner) for corner in corners) + " 0\n")
        file.write("End\n")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    points, cells = read(sys.argv[1])
    shape = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
    mesh = dolfinx.mesh.create_mesh(MPI.COMM_WORLD, cells, points, shape)
    for _ in range(int(sys.argv[3]) if len(sys.argv) == 4 else 1):
        mesh.topology.create_entities(1)
        mesh = dolfinx.mesh.refine(mesh, redistribute=False)
    corners = mesh.geometry.dofmap.array.reshape(-1, 4)
    write(sys.argv[2], mesh.geometry.x, corners)


if __name__ == "__main__":
    main()
