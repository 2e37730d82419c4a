#!/usr/bin/python3
"""Draws meshes side by side as a PNG picture. Needs no screen. Debian: python3-vtk9, xvfb."""

import argparse
import contextlib
import ctypes
import os
import shutil
import subprocess
import sys

try:
    from vtkmodules.vtkCommonCore import (vtkIdTypeArray, vtkLogger,
                                          vtkOutputWindow, vtkUnsignedCharArray)
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPlane
    from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkImagingCore import vtkImageShrink3D
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkLight,
                                             vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                             vtkTextActor, vtkWindowToImageFilter)
    import vtkmodules.vtkRenderingFreeType  # noqa: F401  (draws the text)
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (draws the rest)
except ImportError as error:
    sys.exit(f"render.py: VTK for Python is missing ({error}).\n"
             "On Debian: apt-get install python3-vtk9, and run this with /usr/bin/python3.")

SUPERSAMPLING = 2  # the picture is drawn this many times larger, then shrunk
CAPTION_SHARE = 0.09  # of the height
BAR_SHARE = 0.13  # of the height, where there is a colour bar

WHITE = (1.0, 1.0, 1.0)
INK = (0.13, 0.15, 0.2)
OUTSIDE = (168, 192, 216)  # faces of the mesh's own surface
INSIDE = (240, 205, 142)  # faces that a clip laid open
# Told apart by most eyes, also in grey (after Okabe and Ito), and light enough for dark edges.
PALETTE = [(134, 187, 222), (240, 190, 110), (120, 198, 164), (222, 150, 182), (244, 230, 130),
           (190, 190, 190), (226, 140, 100), (150, 160, 214)]
QUALITY_COLOURS = [(0.0, 0.55, 0.10, 0.16), (0.25, 0.84, 0.38, 0.27), (0.5, 0.97, 0.76, 0.46),
                   (0.75, 0.72, 0.85, 0.72), (1.0, 0.20, 0.50, 0.62)]


class Failure(Exception):
    """What the user is told before the program ends."""


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
        raise argparse.ArgumentTypeError(f"'{text}' should lean away from the z axis, which is up")
    return values


def clip_plane(text):
    values = numbers(6)(text)
    if values[3:] == [0, 0, 0]:
        raise argparse.ArgumentTypeError(f"'{text}' ends with the normal 0,0,0")
    return values


def picture_size(text):
    width, cross, height = text.partition("x")
    if not (cross and width.isdecimal() and height.isdecimal()
            and 16 <= int(width) <= 8000 and 16 <= int(height) <= 8000):
        raise argparse.ArgumentTypeError(f"'{text}' should be like 1600x900, at most 8000x8000")
    return int(width), int(height)


def joined(arguments):
    """With "--clip X" made "--clip=X", for argparse takes an X with a minus for an option."""
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
    parser.add_argument("meshes", metavar="MESH.vtu", nargs="+", help="or .pvtu")
    parser.add_argument("-o", "--output", metavar="PICTURE.png", required=True)
    parser.add_argument("--clip", metavar="X,Y,Z,NX,NY,NZ", type=clip_plane,
                        help="remove the cells that lie wholly on the side of the plane through "
                             "X,Y,Z that the normal NX,NY,NZ points to")
    parser.add_argument("--view", metavar="X,Y,Z", type=direction,
                        help="direction from the mesh to the eye; z is up in the picture. Without "
                             "it: half from above, on the open side of a clip")
    parser.add_argument("--size", metavar="WxH", type=picture_size, default=(1600, 900),
                        help="of the picture in pixels (1600x900)")
    parser.add_argument("--color", choices=["region", "rank", "parent", "quality", "none"],
                        help="colour cells by region tag; by the rank that has them (.pvtu); by "
                             "the cell that they descend from (the first mesh's own numbers); by "
                             "mean ratio, 1 for a regular cell; or tell the surface from the "
                             "inside only (none). Without it: region where every mesh has tags, "
                             "else none")
    return parser.parse_args(joined(sys.argv[1:]))


# --- reading


def read(path):
    if not os.path.isfile(path):
        raise Failure(f"{path}: no such file")
    complaints = []

    def note(source, event, text):
        complaints.append(text.strip().splitlines()[-1].split("): ")[-1])

    note.CallDataType = "string0"
    window = vtkOutputWindow.GetInstance()
    observer = window.AddObserver("ErrorEvent", note)
    in_pieces = path.endswith(".pvtu")
    reader = vtkXMLPUnstructuredGridReader() if in_pieces else vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", note)
    reader.SetFileName(path)
    reader.Update()
    window.RemoveObserver(observer)
    if complaints:
        raise Failure(f"{path}: not a file that VTK can read: {complaints[0]}")
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        raise Failure(f"{path}: has no cells to draw")
    if not (grid.IsHomogeneous() and grid.GetCellType(0) == VTK_TETRA):
        raise Failure(f"{path}: has cells that are not tetrahedra")
    return grid


# --- from a mesh to coloured triangles


def with_quality(grid):
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetTetQualityMeasureToShape()  # Verdict's name for the mean ratio
    quality.Update()
    return quality.GetOutput()


def add_numbers(attributes, name, count):
    """Gives every point or cell its number as an attribute, which filters then pass on."""
    array = vtkIdTypeArray()
    array.SetName(name)
    array.SetNumberOfTuples(count)
    for i in range(count):
        array.SetValue(i, i)
    attributes.AddArray(array)


def crinkle_clip(grid, clip):
    """Whole cells: those that the plane passes through stay."""
    plane = vtkPlane()
    plane.SetOrigin(clip[:3])
    plane.SetNormal(clip[3:])
    extract = vtkExtractGeometry()
    extract.SetInputData(grid)
    extract.SetImplicitFunction(plane)
    extract.ExtractInsideOn()
    extract.ExtractBoundaryCellsOn()
    extract.Update()
    return extract.GetOutput()


def surface_of(grid):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.Update()
    return surface.GetOutput()


def triangles(surface):
    """The vertex numbers of each triangle, as in the whole mesh, in ascending order."""
    vertices = surface.GetPointData().GetArray("vertex")
    corners = memoryview(surface.GetPolys().GetConnectivityArray()).tolist()
    names = [vertices.GetValue(p) for p in corners]
    for first in range(0, len(names), 3):
        yield tuple(sorted(names[first:first + 3]))


def scattered(number):
    """A light colour that differs between neighbouring numbers, the same at every call."""
    mixed = (number * 0x9E3779B97F4A7C15) & 0xFFFFFFFFFFFFFFFF
    base = PALETTE[(mixed >> 40) % len(PALETTE)]
    lightness = 0.82 + 0.18 * ((mixed >> 20) % 256) / 255
    return tuple(round(lightness * part) for part in base)


def quality_colours():
    colours = vtkColorTransferFunction()
    for value, red, green, blue in QUALITY_COLOURS:
        colours.AddRGBPoint(value, red, green, blue)
    return colours


def colours_of(surface, grid, color):
    """One colour for each triangle of the surface; `grid` is the whole mesh."""
    cell_data = surface.GetCellData()
    if color == "none":
        own = set(triangles(surface_of(grid)))
        return [OUTSIDE if triangle in own else INSIDE for triangle in triangles(surface)]
    if color == "quality":
        colours = quality_colours()
        return [[round(255 * part) for part in colours.GetColor(value)]
                for value in memoryview(cell_data.GetArray("Quality")).tolist()]
    if color in ("region", "rank"):
        array = cell_data.GetArray(color)
        return [PALETTE[int(array.GetTuple1(i)) % len(PALETTE)]
                for i in range(surface.GetNumberOfCells())]
    array = cell_data.GetArray("parent") or cell_data.GetArray("cell")
    return [scattered(int(array.GetTuple1(i))) for i in range(surface.GetNumberOfCells())]


def coloured_surface(grid, clip, color):
    if color == "quality":
        grid = with_quality(grid)
    add_numbers(grid.GetPointData(), "vertex", grid.GetNumberOfPoints())
    add_numbers(grid.GetCellData(), "cell", grid.GetNumberOfCells())
    surface = surface_of(crinkle_clip(grid, clip) if clip else grid)
    array = vtkUnsignedCharArray()
    array.SetName("colour")
    array.SetNumberOfComponents(3)
    for colour in colours_of(surface, grid, color):
        array.InsertNextTuple3(*colour)
    surface.GetCellData().SetScalars(array)
    return surface


# --- the picture


def actor_of(surface, edge_width):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetColorModeToDirectScalars()
    mapper.SetScalarModeToUseCellData()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetAmbient(0.5)
    look.SetDiffuse(0.6)
    look.EdgeVisibilityOn()
    look.SetEdgeColor(INK)
    look.SetLineWidth(edge_width)
    return actor


def caption(text, size):
    actor = vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(INK)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.5, 0.5)
    return actor


def colour_bar(font_size):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(quality_colours())
    bar.SetMaximumNumberOfColors(256)
    bar.SetOrientationToHorizontal()
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.2f")
    bar.SetTextPad(font_size // 4)
    bar.UnconstrainedFontSizeOn()
    style = bar.GetLabelTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(font_size)
    style.SetColor(INK)
    style.BoldOff()
    style.ItalicOff()
    style.ShadowOff()
    bar.SetPosition(0.3, 0.1)
    bar.SetWidth(0.4)
    bar.SetHeight(0.9)
    return bar


def light(towards, intensity):
    """Shines from a direction that goes with the camera: x to the right, y up, z to the eye."""
    lamp = vtkLight()
    lamp.SetLightTypeToCameraLight()
    lamp.SetPosition(towards)
    lamp.SetFocalPoint(0, 0, 0)
    lamp.SetIntensity(intensity)
    return lamp


def add_renderer(window, viewport, *props):
    renderer = vtkRenderer()
    renderer.SetBackground(WHITE)
    renderer.SetViewport(viewport)
    for lamp in (light((-0.4, 1.0, 0.6), 0.45), light((0.0, 0.0, 1.0), 0.75)):
        renderer.AddLight(lamp)
    for prop in props:
        renderer.AddViewProp(prop)
    window.AddRenderer(renderer)
    return renderer


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def unit(v):
    length = dot(v, v) ** 0.5
    return tuple(a / length for a in v)


def view_direction(options):
    """From the mesh to the eye: as asked, else half from above, on the open side of a clip."""
    if options.view:
        return unit(options.view)
    towards_eye = [0.6, -1.0, 0.55]
    if options.clip:
        towards_eye = [-d if d * n < 0 else d for d, n in zip(towards_eye, options.clip[3:])]
    return unit(towards_eye)


def aim(camera, surfaces, aspect, towards_eye):
    """Sees the surfaces as large as they fit, in parallel projection."""
    right = unit(cross((0, 0, 1), towards_eye))
    axes = (right, cross(towards_eye, right), towards_eye)  # of the picture: x, y, to the eye
    points = [surface.GetPoint(i) for surface in surfaces
              for i in range(surface.GetNumberOfPoints())]
    middle, half = [], []
    for axis in axes:
        places = [dot(axis, point) for point in points]
        middle.append((max(places) + min(places)) / 2)
        half.append((max(places) - min(places)) / 2)
    centre = [sum(m * axis[i] for m, axis in zip(middle, axes)) for i in range(3)]
    distance = 4 * dot(half, half) ** 0.5
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(centre)
    camera.SetPosition([c + distance * t for c, t in zip(centre, towards_eye)])
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(1.04 * max(half[1], half[0] / aspect))


def union_of(bounds):
    return [(min if i % 2 == 0 else max)(b[i] for b in bounds) for i in range(6)]


def draw(surfaces, captions, bounds, options, color):
    """The picture as VTK image data, drawn without a visible window."""
    width, height = (SUPERSAMPLING * side for side in options.size)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(width, height)

    bottom = BAR_SHARE if color == "quality" else 0
    columns = len(surfaces)
    font_size = max(8, min(height // 36, width // columns // 24))
    edge_width = max(1.0, height / 1000)
    aspect = width / columns / (height * (1 - bottom - CAPTION_SHARE))
    camera = None
    for i, (surface, text) in enumerate(zip(surfaces, captions)):
        left, right, middle = i / columns, (i + 1) / columns, bottom + CAPTION_SHARE
        renderer = add_renderer(window, (left, middle, right, 1), actor_of(surface, edge_width))
        if camera is None:
            camera = renderer.GetActiveCamera()
            aim(camera, surfaces, aspect, view_direction(options))
        renderer.SetActiveCamera(camera)
        renderer.ResetCameraClippingRange(bounds)
        add_renderer(window, (left, bottom, right, middle), caption(text, font_size))
    if bottom:
        small = font_size * 3 // 4
        add_renderer(window, (0, 0, 1, 0.4 * bottom), caption("mean ratio (regular: 1)", small))
        add_renderer(window, (0, 0.4 * bottom, 1, bottom), colour_bar(small))

    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    shrink = vtkImageShrink3D()
    shrink.SetInputConnection(grab.GetOutputPort())
    shrink.SetShrinkFactors(SUPERSAMPLING, SUPERSAMPLING, 1)
    shrink.MeanOn()
    shrink.Update()
    window.Finalize()
    return shrink.GetOutput()


def write_png(image, path):
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()
    if writer.GetErrorCode() != 0 or not os.path.isfile(path):
        raise Failure(f"{path}: cannot be written")


# --- a display for VTK


def can_open_display():
    """Tried beforehand, for VTK aborts where it cannot."""
    if not os.environ.get("DISPLAY"):
        return False
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return x11.XOpenDisplay(None) is not None


@contextlib.contextmanager
def display():
    """Debian's VTK draws through X only. An X server in memory (Xvfb) of our own is the same on
    every machine, so it is preferred to the display that the user may have."""
    xvfb = shutil.which("Xvfb")
    if xvfb is None:
        if not can_open_display():
            raise Failure("VTK needs an X server to draw, and DISPLAY names none.\n"
                          "On Debian: apt-get install xvfb; it is then started by itself.")
        yield
        return
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        [xvfb, "-displayfd", str(write_end), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        os.close(write_end)
        with os.fdopen(read_end) as chosen:
            number = chosen.readline().strip()  # once it is ready; nothing if it failed
        if not number:
            raise Failure("Xvfb, the X server that VTK would draw with, did not start")
        os.environ["DISPLAY"] = f":{number}"
        yield
    finally:
        server.terminate()
        server.wait()


# --- all of it


def chosen_color(grids, options):
    """The --color option, checked against what the files have."""
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
    color = chosen_color(grids, options)
    captions = [f"{os.path.splitext(os.path.basename(path))[0]}: {grid.GetNumberOfCells():,} cells"
                for path, grid in zip(options.meshes, grids)]
    surfaces = [coloured_surface(grid, options.clip, color) for grid in grids]
    for path, surface in zip(options.meshes, surfaces):
        if surface.GetNumberOfCells() == 0:
            raise Failure(f"{path}: the clip leaves no cell")
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
