"""Draws the pictures of Documentation/SoftLight.md, and the plot of error over samples.

    soft_light_pictures.py folder [softlight.json]

The JSON file is one of BenchmarkSoftLight; without it there is no plot. PYTHONPATH has to name the
built package. Pictures are drawn off screen: under xvfb-run where there is no screen.
"""
import math
import os
import random
import sys

import numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkGlyph3DMapper, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow)
from vtksvo import vtkSVORenderPass

PANEL = 280  # pixels, both ways
GAP = 6
MOST_BYTES = 150000  # of a picture; more of it gets 256 colours
FINE = 2  # pixels drawn for one, along each edge


def actor(mapper, colour):
    made = vtkActor()
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetInterpolationToPhong()
    look.SetColor(*colour)
    look.SetAmbient(0.2)
    look.SetDiffuse(0.8)
    return made


def surface(source, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    return actor(mapper, colour)


def ground(size, height, colour=(0.85, 0.83, 0.8)):
    plane = vtkPlaneSource()
    plane.SetOrigin(-size, -size, height)
    plane.SetPoint1(size, -size, height)
    plane.SetPoint2(-size, size, height)
    return surface(plane, colour)


def glyphs(places, shape, colour, scales=None):
    data, points, mapper = vtkPolyData(), vtkPoints(), vtkGlyph3DMapper()
    for place in places:
        points.InsertNextPoint(place)
    data.SetPoints(points)
    if scales is not None:
        array = numpy_to_vtk(numpy.array(scales, float), deep=True)
        array.SetName("scale")
        data.GetPointData().AddArray(array)
        mapper.SetScaleArray("scale")
        mapper.SetScaleModeToScaleByVectorComponents()
    else:
        mapper.ScalingOff()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(shape.GetOutputPort())
    mapper.ScalarVisibilityOff()
    made = actor(mapper, colour)
    made.data = data
    return made


def ball(radius):
    sphere = vtkSphereSource()
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(48)
    sphere.SetPhiResolution(48)
    return sphere


def molecule():
    """A double helix: balls that reach into each other, and sticks between them."""
    def strand(i, phase, radius=1.0):
        angle = math.radians(34.3) * i + phase
        return radius * math.cos(angle), radius * math.sin(angle), 0.34 * i - 2.4

    count, phases = 15, (0.0, 2.4)
    points, lines, sticks = vtkPoints(), vtkCellArray(), vtkPolyData()
    for i in range(count):
        lines.InsertNextCell(2)
        for phase in phases:
            lines.InsertCellPoint(points.InsertNextPoint(strand(i, phase)))
    sticks.SetPoints(points)
    sticks.SetLines(lines)
    tubes = vtkTubeFilter()
    tubes.SetInputData(sticks)
    tubes.SetRadius(0.1)
    tubes.SetNumberOfSides(32)
    halves = [[strand(i + h, phase) for i in range(count) for h in (0.0, 0.5)] for phase in phases]
    inner = [strand(i, phase, 0.45) for i in range(count) for phase in phases]
    return dict(
        actors=[glyphs(halves[0], ball(0.34), (0.86, 0.42, 0.32)),
                glyphs(halves[1], ball(0.34), (0.3, 0.52, 0.72)),
                glyphs(inner, ball(0.27), (0.9, 0.86, 0.72)), surface(tubes, (0.6, 0.6, 0.6))],
        light=(4.0, -5.0, 6.0), positional=True, size=2.0, camera=(7.0, -8.0, 2.5), up=(0, 0, 1),
        target=(0.0, 0.0, 0.0), angle=33.0)


def isosurface():
    """Where a density with waves all over takes a value, on a plane."""
    n = 160
    axis = numpy.linspace(-1.2, 1.2, n)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    waves = numpy.sin(9 * x) * numpy.sin(8 * y) + numpy.sin(7 * z + 1) * numpy.sin(6 * x)
    values = 1.0 - numpy.sqrt(x * x + y * y + z * z) + 0.12 * waves
    image = vtkImageData()
    image.SetDimensions(n, n, n)
    image.SetSpacing(3 * (axis[1] - axis[0],))
    image.SetOrigin(-1.2, -1.2, -1.2)
    array = numpy_to_vtk(values.ravel().astype("f"), deep=True)
    array.SetName("density")
    image.GetPointData().SetScalars(array)
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.12)
    return dict(
        actors=[surface(contour, (0.36, 0.64, 0.56)), ground(25.0, -1.1)],
        light=(3.0, -2.0, 5.0), positional=True, size=0.8, camera=(3.0, -5.0, 3.0), up=(0, 0, 1),
        target=(0.15, 0.1, -0.25), angle=32.0)


def city():
    """Boxes on a plane, in a low sun."""
    numbers = random.Random(4)
    places, scales = [], []
    for i in range(-8, 9):
        for j in range(-8, 9):
            height = 0.3 + 2.2 * numbers.random() ** 3 + 1.5 * math.exp(-0.1 * (i * i + j * j))
            places.append((i, j, 0.5 * height))
            scales.append((0.5 + 0.2 * numbers.random(), 0.5 + 0.2 * numbers.random(), height))
    return dict(
        actors=[glyphs(places, vtkCubeSource(), (0.82, 0.78, 0.72), scales), ground(30.0, 0.0)],
        light=(6.0, -3.0, 4.5), positional=False, size=4.0, camera=(7.0, -9.0, 8.0), up=(0, 0, 1),
        target=(0.0, 0.0, 0.3), angle=33.0, distance=3.0)


class Shown:
    """A scene in a window."""

    def __init__(self, scene, size):
        self.renderer, self.window, self.svo = vtkRenderer(), vtkRenderWindow(), vtkSVORenderPass()
        self.scene = scene
        self.svo.SetBackendToCPU()
        self.svo.SetAmbientOcclusionDistance(scene.get("distance", 0.0))
        self.renderer.SetPass(self.svo)
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)
        for each in scene["actors"]:
            self.renderer.AddActor(each)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(*scene["camera"])
        camera.SetFocalPoint(*scene["target"])
        camera.SetViewUp(*scene["up"])
        camera.SetViewAngle(scene["angle"])
        self.renderer.ResetCameraClippingRange()
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPositional(scene["positional"])
        self.light.SetConeAngle(180.0)
        self.light.SetPosition(*scene["light"])
        self.light.SetFocalPoint(0.0, 0.0, 0.0)

    def picture(self, soft=False, occlusion=False, samples=64):
        """By its light, or, for occlusion, by VTK's own at the camera."""
        self.renderer.RemoveAllLights()
        self.renderer.SetAutomaticLightCreation(occlusion)
        if not occlusion:
            self.renderer.AddLight(self.light)
        vtkSVORenderPass.SetLightSize(self.scene["size"] if soft else 0.0, self.light)
        self.svo.SetAmbientOcclusion(occlusion)
        self.svo.SetMaximumLightSamples(samples)
        self.window.Render()
        if self.svo.GetNumberOfRasterizedActors():
            sys.exit("the rasteriser drew something")
        width, height = self.window.GetSize()
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
        return Image.fromarray(vtk_to_numpy(pixels).reshape(height, width, 3)[::-1].copy())

    def close(self):
        self.window.Finalize()


def side_by_side(pictures):
    width, height = pictures[0].size
    whole = Image.new("RGB", (len(pictures) * (width + GAP) - GAP, height), (255, 255, 255))
    for i, picture in enumerate(pictures):
        whole.paste(picture, (i * (width + GAP), 0))
    return whole


def save(picture, folder, name):
    path = os.path.join(folder, name)
    picture.save(path, optimize=True)
    if os.path.getsize(path) > MOST_BYTES:
        picture.quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path, os.path.getsize(path) // 1024, "KiB")


def looks(scene, folder, name):
    """Hard, soft, occlusion."""
    shown = Shown(scene(), (FINE * PANEL, FINE * PANEL))
    pictures = [shown.picture(), shown.picture(soft=True), shown.picture(occlusion=True)]
    shown.close()
    save(side_by_side([p.resize((PANEL, PANEL), Image.LANCZOS) for p in pictures]), folder, name)


def detail(folder):
    """A penumbra and a fold, with 1, 16 and 256 samples, not filtered; each pixel is nine."""
    shown = Shown(isosurface(), (480, 480))
    shown.svo.SetFilterLightSamples(False)
    box = (290, 290, 380, 360)
    rows = []
    for how in dict(soft=True), dict(occlusion=True):
        rows.append(side_by_side([
            shown.picture(samples=n, **how).crop(box).resize((270, 210), Image.NEAREST)
            for n in (1, 16, 256)]))
    shown.close()
    whole = Image.new("RGB", (rows[0].width, 2 * rows[0].height + GAP), (255, 255, 255))
    for i, row in enumerate(rows):
        whole.paste(row, (0, i * (row.height + GAP)))
    save(whole, folder, "soft-light-samples.png")


def plot(file, folder):
    import json

    import figures  # wants matplotlib
    with open(file, encoding="utf-8") as text:
        rows = [r for r in json.load(text) if r["experiment"] == "error" and "samples" in r]
    figure, (axis,) = figures.panels(
        ["paper4, colours of 0..255, against 2048 samples"], "Error over samples a pixel", 3.4)
    for kind, colour in ("soft light", "#1b6ca8"), ("occlusion", "#d9a400"):
        some = [r for r in rows if r["method"] == kind]
        x = [r["samples"] for r in some]
        axis.plot(x, [r["betweenError"] for r in some], "o-", color=colour, markersize=3.5,
                  label=f"{kind}, between the extremes")
        axis.plot(x, [r["error"] for r in some], "o--", color=colour, markersize=2.5, linewidth=0.8,
                  label=f"{kind}, all pixels")
    first = max(r["betweenError"] for r in rows)
    for power, style in (-0.5, ":"), (-0.7, "-."):
        axis.plot(x, [first * n ** power for n in x], style, color="#888888", linewidth=0.8,
                  label=f"N^{power}")
    axis.set_xscale("log", base=2)
    axis.set_yscale("log")
    axis.set_xticks(x, [str(n) for n in x])
    ticks = [t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50)]
    axis.set_yticks(ticks, [f"{t:g}" for t in ticks])
    axis.minorticks_off()
    figures.label(axis, "samples", "RMS error, grey levels")
    figures.save(figure, folder, "soft-light-error.png")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    looks(molecule, folder, "soft-light-molecule.png")
    looks(isosurface, folder, "soft-light-isosurface.png")
    looks(city, folder, "soft-light-city.png")
    detail(folder)
    if len(sys.argv) == 3:
        plot(sys.argv[2], folder)


if __name__ == "__main__":
    main()
