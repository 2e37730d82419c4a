"""Octetra compared with meshio, gmsh and DOLFINx: the same file is read, and its mesh written
again."""

import os

from measuring import Case, Figure, Run, median, script
from running import must, run

DRIVER = "bench/python/file_tools.py"


def name_of(tool, kind):
    return f"{tool}, .{kind}"


def through_python(tool, kind, shape, out=None):
    """Reading and writing measured separately within a running process."""
    out = out or kind

    def line(place):
        path = place.mesh(shape, f"tools.{kind}")
        return script("", DRIVER, f"{tool} {path} {os.path.join(place.folder, 'tools-out.' + out)}").line(place)
    return Run(name_of(tool, out), line, f"python3 {DRIVER} {tool} ({shape}).{kind} out.{out}")


def whole(tool, kind, shape):
    """Both together, including the start of the process."""
    def line(place):
        path = place.mesh(shape, f"tools.{kind}")
        out = os.path.join(place.folder, "tools-out." + kind)
        outcome = run(command(place, path, out), place.folder)
        if outcome.status != 0:
            must(command(place, path, out), place.folder)  # reports errors
        return {"seconds": outcome.seconds}

    def command(place, path, out):
        if tool == "gmsh":
            return ["gmsh", "-v", "0", path, "-save", "-setnumber", "Mesh.SaveAll", "1", "-bin", "-o", out]
        return [place.program("cli/octetra"), "convert", path, out, "--quiet"]
    words = {"gmsh": "gmsh ({}) -save -bin -o out", "octetra": "octetra convert ({}) out"}[tool]
    return Run(name_of(tool + " as a command", kind), line, words.format(shape) + "." + kind)


def beside(lines, ours, theirs, key, words):
    seconds = [median(lines[name], key) for name in (ours, theirs)]
    return [Figure(f"{words}: {ours}", seconds[0], "s"), Figure(f"{words}: {theirs}", seconds[1], "s"),
            Figure(f"{words}: times as fast as {theirs}", seconds[1] / seconds[0], "times")]


def figures(kinds):
    def made(lines):
        found = []
        for kind in kinds:
            for key, words in (("read_seconds", "reading"), ("write_seconds", "writing")):
                found += beside(lines, name_of("octetra", kind), name_of("meshio", kind), key, words)
        for kind in ("msh", "mesh"):
            found += beside(lines, name_of("octetra as a command", kind), name_of("gmsh as a command", kind),
                            "seconds", "both")
        return found + beside(lines, name_of("octetra", "xdmf"), name_of("dolfinx", "xdmf"), "write_seconds",
                              "writing")
    return made


def beside_others(shape):
    kinds = ("msh", "mesh", "meshb")
    return Case("files, beside meshio, gmsh and DOLFINx", [
        *(through_python(tool, kind, shape) for kind in kinds for tool in ("octetra", "meshio")),
        *(whole(tool, kind, shape) for kind in ("msh", "mesh") for tool in ("octetra", "gmsh")),
        through_python("octetra", "meshb", shape, "xdmf"), through_python("dolfinx", "xdmf", shape)],
        figures(kinds))
