"""The scene and the pictures that the ParaView tests share.

VTKSVO_PLUGIN names the plugin's file, VTKSVO_OUTPUT a folder for pictures, VTKSVO_BASELINE that of
the pictures to compare with, VTKSVO_TEST_BACKEND the backend of views: OpenGL, or what they take by themselves.
"""

import os
import sys
import unittest

import numpy
import paraview.simple as pv
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from pictures import differing, read

CENTER = numpy.array([0.0, 0.0, 0.8])
RADIUS = 0.5
TO_LIGHT = numpy.array([3.0, -2.0, 5.0]) / numpy.linalg.norm([3.0, -2.0, 5.0])
# VTK draws all that has triangles then, nothing of it is traced for the eye, and octrees answer for the light.
OPENGL = os.environ.get("VTKSVO_TEST_BACKEND") == "OpenGL"


def load_plugin(remote=False):
    """Before the first view is made, so that it has the plugin's settings."""
    pv._DisableFirstRenderCameraReset()
    pv.LoadPlugin(os.environ["VTKSVO_PLUGIN"], remote=remote, ns=vars(pv))


def output(name):
    return os.path.join(os.environ["VTKSVO_OUTPUT"], name)


def make_view(size=(600, 400)):
    """A view without a light kit, at a place that sees the ball and the ground, in the colors that were ParaView's
    own before 6.0."""
    pv.LoadPalette("BlueGrayBackground")
    view = pv.CreateView("RenderView")
    view.ViewSize = list(size)
    view.OrientationAxesVisibility = 0
    view.UseLight = 0
    view.CameraPosition = [5.0, -6.0, 4.0]
    view.CameraFocalPoint = [0.0, 0.0, 0.3]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraViewAngle = 25.0
    if hasattr(view, "SVOShadowIntensity"):  # the plugin is loaded
        view.SVOShadowIntensity = 1.0  # black is told from dim most easily
        choose_backend(view)
    return view


def choose_backend(view):
    """The one that is tested."""
    if OPENGL:
        view.SVOBackend, view.SVOShadowTechnique = "OpenGL", "Automatic"


def make_parallel_view(port=None):
    """In the client of a server at this port of this machine, or without one: a view with a sun that the processes that
    have the data draw."""
    if port is not None:
        pv.Connect("localhost", port)
    load_plugin()
    if port is not None:
        load_plugin(remote=True)
    view = make_view((400, 300))
    view.RemoteRenderThreshold = 0.0
    add_sun(view)
    return view


def add_sun(view):
    """A directional light of the scene."""
    light = pv.AddLight(view=view)
    light.Coords = "Scene"
    light.Type = "Directional"
    light.Position = list(10.0 * TO_LIGHT)
    light.FocalPoint = [0.0, 0.0, 0.0]
    return light


def make_ball():
    return pv.Sphere(Center=list(CENTER), Radius=RADIUS, ThetaResolution=128, PhiResolution=128)


def make_ground():
    return pv.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0])


def show(source, view, kind="SVO"):
    display = pv.Show(source, view)
    display.Representation = kind
    return display


def reads_appended_data():
    """Whether ParaView reads what VTK's XML writers make by default. That of Debian 12 does not since its libexpat
    has the correction of CVE-2023-52425 (Debian bug 1114938)."""
    writer, reader = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader()
    source = vtkSphereSource()
    source.SetThetaResolution(100)
    writer.SetInputConnection(source.GetOutputPort())
    writer.WriteToOutputStringOn()
    writer.Write()
    reader.ReadFromInputStringOn()
    reader.SetInputString(writer.GetOutputString())
    display = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    reader.Update()
    vtkObject.SetGlobalWarningDisplay(display)
    return reader.GetOutput().GetNumberOfPolys() > 0


def position_name(display):
    """ParaView 5.13 renamed the property."""
    return "Translation" if "Translation" in display.ListProperties() else "Position"


def move(display, position):
    setattr(display, position_name(display), position)


def apply_preset(table, name):
    """ParaView 6 left out the origin, which is in parentheses."""
    presets = pv.servermanager.vtkSMTransferFunctionPresets.GetInstance()
    table.ApplyPreset(name if presets.HasPreset(name) else name.split(" (")[0], True)


def statistic(proxy, name):
    """A property that is there for information only, which ParaView makes no attribute."""
    proxy.UpdatePropertyInformation()
    return proxy.GetPropertyValue(name)


def traced(meshes, others=0):
    """How many of a view's surfaces are traced for the eye, of meshes and of others."""
    return others + (0 if OPENGL else meshes)


def casts_nothing(reason):
    """What is said of a surface that the rasteriser draws and that casts nothing, for the same reason. Where OpenGL draws
    all of them there is no reason for that."""
    return ("" if OPENGL else f"Left to the rasteriser: it {reason}. ") + f"Casts no shadow: it {reason}."


def picture(view, name, **options):
    """Renders, saves the picture and returns it: rows from below, columns, 3 or 4 channels."""
    path = output(name + ".png")
    options.setdefault("ImageResolution", list(view.ViewSize))
    pv.SaveScreenshot(path, view, **options)
    return read(path)


def baseline_difference(actual, name):
    return differing(actual, read(os.path.join(os.environ["VTKSVO_BASELINE"], name + ".png")))


def ground_points(view, size):
    """For each pixel the way of its ray, and where that meets the ground's plane, and how far away in such ways."""
    width, height = size
    eye = numpy.array(view.CameraPosition)
    ahead = numpy.array(view.CameraFocalPoint) - eye
    ahead /= numpy.linalg.norm(ahead)
    right = numpy.cross(ahead, view.CameraViewUp)
    right /= numpy.linalg.norm(right)
    above = numpy.cross(right, ahead)
    slope = numpy.tan(numpy.radians(view.CameraViewAngle) / 2)
    x = ((numpy.arange(width) + 0.5) / width * 2 - 1) * slope * width / height
    y = ((numpy.arange(height) + 0.5) / height * 2 - 1) * slope
    rays = ahead + x[None, :, None] * right + y[:, None, None] * above
    t = -eye[2] / rays[..., 2]
    return rays, eye + t[..., None] * rays, t


def exact_shadow(view, size):
    """What the scene's ball does to the ground, by arithmetic: for each pixel whether it shows the
    ground, and whether the ball is between that place and the light."""
    eye = numpy.array(view.CameraPosition)
    rays, points, t = ground_points(view, size)

    def meets_ball(origins, directions):
        to_center = CENTER - origins
        along = (to_center * directions).sum(axis=-1) / (directions ** 2).sum(axis=-1)
        nearest = origins + along[..., None] * directions
        return (along > 0) & (((nearest - CENTER) ** 2).sum(axis=-1) < RADIUS ** 2)

    ground = (t > 0) & (abs(points[..., :2]) < 2).all(axis=-1)
    ground &= ~meets_ball(numpy.broadcast_to(eye, rays.shape), rays)
    dark = ground & meets_ball(points, numpy.broadcast_to(TO_LIGHT, points.shape))
    return ground, dark


def border(mask, distance=1):
    """Pixels with one on the other side of the mask no farther than `distance` rows and columns."""
    near = numpy.zeros_like(mask)
    steps = range(-distance, distance + 1)
    for dy in steps:
        for dx in steps:
            near |= numpy.roll(mask, (dy, dx), (0, 1)) != mask
    return near


def run_tests():
    """Runs the test cases of the main module. A failure ends the program on the spot: ParaView crashes where a
    script calls sys.exit() while there are views. From ParaView 5.13 on what was printed to its own stream
    would then be lost."""
    sys.stdout = open(1, "w", buffering=1, closefd=False)
    tests = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(tests)
    if not result.wasSuccessful():
        os._exit(1)
    pv.ResetSession()
