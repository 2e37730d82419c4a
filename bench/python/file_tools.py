"""Reads a mesh file and writes its mesh to another: file_tools.py octetra|meshio|dolfinx IN OUT
[--json]

Prints the seconds of reading and of writing. DOLFINx, which reads and writes .xdmf, makes a mesh
from the file, with numbering and neighbours. PYTHONPATH must contain octetra.
"""

import argparse
import json
import pathlib
import time


def octetra_way():
    from mpi4py import MPI  # starts MPI, before timing starts
    import octetra
    del MPI
    return octetra.read, lambda mesh, path: mesh.write(path)


def meshio_way():
    import meshio
    # In version 4.1 it cannot write a mesh with several blocks of one entity, although it reads
    # such files.
    formats = {".msh": {"file_format": "gmsh22", "binary": True}, ".mesh": {"file_format": "medit"},
               ".meshb": {"file_format": "medit"}}
    return meshio.read, lambda mesh, path: meshio.write(path, mesh, **formats[pathlib.Path(path).suffix])


def dolfinx_way():
    import dolfinx.io
    from mpi4py import MPI

    def read(path):
        with dolfinx.io.XDMFFile(MPI.COMM_WORLD, path, "r") as file:
            return file.read_mesh(name="mesh")

    def write(mesh, path):
        with dolfinx.io.XDMFFile(MPI.COMM_WORLD, path, "w") as file:
            file.write_mesh(mesh)
    return read, write


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("way", choices=["octetra", "meshio", "dolfinx"])
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    read, write = {"octetra": octetra_way, "meshio": meshio_way, "dolfinx": dolfinx_way}[arguments.way]()
    begin = time.perf_counter()
    mesh = read(arguments.input)
    have = time.perf_counter()
    write(mesh, arguments.output)
    seconds = {"read_seconds": have - begin, "write_seconds": time.perf_counter() - have}
    if arguments.json:
        print(json.dumps(seconds))
    else:
        print(f"read in {seconds['read_seconds']:.3f} s, written in {seconds['write_seconds']:.3f} s")


main()
