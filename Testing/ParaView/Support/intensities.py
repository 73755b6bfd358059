"""Draws Documentation/Images/shadow-intensity.png, by hand: ten scenes with a shadow intensity of 1 (above) and of 0.7,
ParaView's default (below). Runs in pvbatch, as tests do (CMakeLists.txt has their environment).

usage: intensities.py picture.png
"""

import sys

import numpy
import paraview.simple as pv
import scene
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

SIZE = (170, 128)
COLUMNS = 5


def wavelet():
    return pv.Wavelet(WholeExtent=[-10, 10] * 3)


def contour():
    return [pv.Contour(Input=wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0, 200.0])]


def clip():
    return [pv.Clip(Input=wavelet())]


def slices():
    source = wavelet()
    made = []
    for normal in [1, 0, 0], [0, 1, 0], [0, 0, 1]:
        cut = pv.Slice(Input=source)
        cut.SliceType.Normal = normal
        made.append(cut)
    return made


def glyphs():
    return [pv.Glyph(Input=pv.Sphere(Radius=3), GlyphType="Cone", ScaleFactor=1.5)]


def warp():
    plane = pv.Plane(XResolution=60, YResolution=60, Origin=[-10, -10, 0], Point1=[10, -10, 0], Point2=[-10, 10, 0])
    waves = pv.Calculator(Input=plane, Function="1.5*sin(coordsX)*cos(coordsY)")
    return [pv.WarpByScalar(Input=waves, Scalars=["POINTS", "Result"])]


def row_of_balls():
    return [pv.Sphere(Center=[2.5 * i, 0, 0.2 * i], ThetaResolution=32, PhiResolution=32) for i in range(4)]


def tower():
    return [pv.Box(XLength=4, YLength=4, ZLength=0.5, Center=[0, 0, 1.5 * i]) for i in range(5)]


SCENES = [
    (lambda: [pv.Sphere(ThetaResolution=64, PhiResolution=64)], "Surface"),
    (lambda: [pv.Superquadric(Toroidal=1)], "Surface"),
    (contour, "Surface"),
    (clip, "Surface"),
    (slices, "Surface"),
    (glyphs, "Surface"),
    (warp, "Surface"),
    (row_of_balls, "Surface"),
    (tower, "Surface"),
    (lambda: [pv.ExtractSurface(Input=pv.Wavelet(WholeExtent=[-4, 4] * 3))], "Surface With Edges"),
]


def pair(number, make, kind):
    view = scene.make_view(SIZE)
    light = scene.add_sun(view)
    sources = make()
    for source in sources:
        display = scene.show(source, view, kind)
        if source.PointData.GetArray("RTData"):
            pv.ColorBy(display, ("POINTS", "RTData"))
            display.SetScalarBarVisibility(view, False)
    view.SVOShadowsForEverything = 1
    view.SVOShadowCatcher = "Below Z"
    view.SVOAntiAliasing = 1
    view.CameraPosition, view.CameraFocalPoint = [5, -6, 4], [0, 0, 0]
    pv.ResetCamera(view)
    light.Position = [3, -2, 5]
    made = []
    for intensity in 1.0, 0.7:
        view.SVOShadowIntensity = intensity
        made.append(scene.picture(view, f"intensity-{number}-{intensity}"))
    pv.ResetSession()
    return numpy.concatenate(made[::-1])  # rows are from below


scene.load_plugin()
pairs = [pair(i, *made) for i, made in enumerate(SCENES)]
rows = [numpy.concatenate(pairs[i:i + COLUMNS], axis=1) for i in range(0, len(pairs), COLUMNS)]
sheet = numpy.ascontiguousarray(numpy.concatenate(rows[::-1]).astype(numpy.uint8))
image = vtkImageData()
image.SetDimensions(sheet.shape[1], sheet.shape[0], 1)
image.GetPointData().SetScalars(numpy_to_vtk(sheet.reshape(-1, 3), deep=True, array_type=VTK_UNSIGNED_CHAR))
writer = vtkPNGWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputData(image)
writer.Write()
