"""From coloured triangles to a picture: light, camera, captions."""

import os

from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (draws the text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (draws the rest)

from rendering.failure import Failure
from rendering.surfaces import quality_colours

SUPERSAMPLING = 2  # the picture is drawn larger by this factor, then shrunk
CAPTION_SHARE = 0.09  # of the height
BAR_SHARE = 0.13  # of the height, if there is a colour bar

WHITE = (1.0, 1.0, 1.0)
INK = (0.13, 0.15, 0.2)


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
    """A light whose direction is fixed relative to the camera: x to the right, y up, z to the eye."""
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
    """The direction from the mesh to the eye: the requested one, else from obliquely above, on the
    open side of a clip."""
    if options.view:
        return unit(options.view)
    towards_eye = [0.6, -1.0, 0.55]
    if options.clip:
        towards_eye = [-d if d * n < 0 else d for d, n in zip(towards_eye, options.clip[3:])]
    return unit(towards_eye)


def aim(camera, surfaces, aspect, towards_eye):
    """Fits the surfaces into the picture, in parallel projection."""
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
    """Returns the picture as VTK image data, drawn without a visible window."""
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
