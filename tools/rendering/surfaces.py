"""From mesh files to coloured triangles."""

import os

from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkOutputWindow, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPlane
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from rendering.failure import Failure

OUTSIDE = (168, 192, 216)  # faces of the mesh's own surface
INSIDE = (240, 205, 142)  # faces exposed by a clip
# Distinguishable for most people, also in grey (after Okabe and Ito), and light enough for dark
# edges.
PALETTE = [(134, 187, 222), (240, 190, 110), (120, 198, 164), (222, 150, 182), (244, 230, 130),
           (190, 190, 190), (226, 140, 100), (150, 160, 214)]
QUALITY_COLOURS = [(0.0, 0.55, 0.10, 0.16), (0.25, 0.84, 0.38, 0.27), (0.5, 0.97, 0.76, 0.46),
                   (0.75, 0.72, 0.85, 0.72), (1.0, 0.20, 0.50, 0.62)]


def read(path):
    if not os.path.isfile(path):
        raise Failure(f"{path}: no such file")
    complaints = []

    def note(source, event, text):
        complaints.append(text.strip().splitlines()[-1].split("): ")[-1])

    note.CallDataType = "string0"
    window = vtkOutputWindow.GetInstance()
    observer = window.AddObserver("ErrorEvent", note)
    readers = {".pvtu": vtkXMLPUnstructuredGridReader, ".vtkhdf": vtkHDFReader}
    reader = readers.get(os.path.splitext(path)[1], vtkXMLUnstructuredGridReader)()
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


def with_quality(grid):
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetTetQualityMeasureToShape()  # Verdict's name for the mean ratio
    quality.Update()
    return quality.GetOutput()


def add_numbers(attributes, name, count):
    """Adds the number of every point or cell as an attribute, which filters preserve."""
    array = vtkIdTypeArray()
    array.SetName(name)
    array.SetNumberOfTuples(count)
    for i in range(count):
        array.SetValue(i, i)
    attributes.AddArray(array)


def crinkle_clip(grid, clip):
    """Removes whole cells; those that the plane intersects stay."""
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
    """The vertex numbers of each triangle in the whole mesh, in ascending order."""
    vertices = surface.GetPointData().GetArray("vertex")
    corners = memoryview(surface.GetPolys().GetConnectivityArray()).tolist()
    names = [vertices.GetValue(p) for p in corners]
    for first in range(0, len(names), 3):
        yield tuple(sorted(names[first:first + 3]))


def scattered(number):
    """A light colour that differs between adjacent numbers, and is the same in every call."""
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
