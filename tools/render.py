#!/usr/bin/python3
"""Draws meshes side by side as a PNG picture. Requires no screen. Debian: python3-vtk9, xvfb."""

import argparse
import os
import sys

try:
    from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow

    from rendering.display import display
    from rendering.failure import Failure
    from rendering.picture import draw, union_of, write_png
    from rendering.surfaces import coloured_surface, read
except ImportError as error:
    sys.exit(f"render.py: VTK for Python is missing ({error}).\n"
             "On Debian: apt-get install python3-vtk9, and run this with /usr/bin/python3.")


# --- the command line


def numbers(count):
    def parse(text):
        try:
            values = [float(field) for field in text.split(",")]
        except ValueError:
            values = []
        if len(values) != count:
            raise argparse.ArgumentTypeError(f"'{text}' should be {count} numbers, comma between")
        return values
    return parse


def direction(text):
    values = numbers(3)(text)
    if values[:2] == [0, 0]:
        raise argparse.ArgumentTypeError(f"'{text}' must not be parallel to the z axis, which is up")
    return values


def clip_plane(text):
    values = numbers(6)(text)
    if values[3:] == [0, 0, 0]:
        raise argparse.ArgumentTypeError(f"'{text}' has the normal 0,0,0")
    return values


def picture_size(text):
    width, cross, height = text.partition("x")
    if not (cross and width.isdecimal() and height.isdecimal()
            and 16 <= int(width) <= 8000 and 16 <= int(height) <= 8000):
        raise argparse.ArgumentTypeError(f"'{text}' should be like 1600x900, at most 8000x8000")
    return int(width), int(height)


def joined(arguments):
    """Replaces "--clip X" by "--clip=X", because argparse takes an X that begins with a minus sign
    for an option."""
    out = []
    for argument in arguments:
        if out and out[-1] in ("--clip", "--view"):
            out[-1] += "=" + argument
        else:
            out.append(argument)
    return out


def parse_command_line():
    parser = argparse.ArgumentParser(
        prog="render.py", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Draw meshes side by side, from the same point of view, as a PNG picture.",
        epilog="example, cut open in the middle to show the inside:\n"
               "  tools/render.py coarse.vtu fine.vtu -o picture.png --clip 0.5,0.5,0.5,0,-1,0")
    parser.add_argument("meshes", metavar="MESH.vtu", nargs="+", help="or .pvtu, .vtkhdf")
    parser.add_argument("-o", "--output", metavar="PICTURE.png", required=True)
    parser.add_argument("--clip", metavar="X,Y,Z,NX,NY,NZ", type=clip_plane,
                        help="remove the cells that lie entirely on the side of the plane through "
                             "X,Y,Z that the normal NX,NY,NZ points to")
    parser.add_argument("--view", metavar="X,Y,Z", type=direction,
                        help="direction from the mesh to the eye; z is up in the picture. Without "
                             "it: from obliquely above, on the open side of a clip")
    parser.add_argument("--size", metavar="WxH", type=picture_size, default=(1600, 900),
                        help="size of the picture in pixels (1600x900)")
    parser.add_argument("--color", choices=["region", "rank", "parent", "quality", "none"],
                        help="colour cells by region tag; by the rank that has them (.pvtu); by "
                             "the cell that they descend from (the first mesh's own numbers); by "
                             "mean ratio, 1 for a regular cell; or tell the surface from the "
                             "inside only (none). Without it: region where every mesh has tags, "
                             "else none")
    return parser.parse_args(joined(sys.argv[1:]))


# --- all of it


def checked_color(grids, options):
    """Returns the --color option, after checking it against the contents of the files."""
    if options.color is None:
        return "region" if all(have(grids, "region")) else "none"
    if options.color in ("region", "rank") and not all(have(grids, options.color)):
        without = options.meshes[have(grids, options.color).index(False)]
        raise Failure(f"{without}: has no {options.color} of cells to colour by")
    return options.color


def have(grids, name):
    return [grid.GetCellData().HasArray(name) == 1 for grid in grids]


def render(options):
    if os.path.splitext(options.output)[1] != ".png":
        raise Failure(f"{options.output}: the name of the picture should end in .png")
    grids = [read(path) for path in options.meshes]
    color = checked_color(grids, options)
    captions = [f"{os.path.splitext(os.path.basename(path))[0]}: {grid.GetNumberOfCells():,} cells"
                for path, grid in zip(options.meshes, grids)]
    surfaces = [coloured_surface(grid, options.clip, color) for grid in grids]
    for path, surface in zip(options.meshes, surfaces):
        if surface.GetNumberOfCells() == 0:
            raise Failure(f"{path}: the clip removes all cells")
    bounds = union_of([surface.GetBounds() for surface in surfaces])
    with display():
        image = draw(surfaces, captions, bounds, options, color)
    write_png(image, options.output)


def main():
    options = parse_command_line()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    vtkOutputWindow.GetInstance().SetDisplayModeToNever()
    try:
        render(options)
    except Failure as failure:
        print(f"render.py: {failure}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
