"""The installed python3-vtksvo, as a user meets it: the README's scene has a shadow.

usage: check_vtk.py folder for pictures
"""

import os
import sys

import vtk
import vtksvo
from judge import check_shadow

print("vtksvo", vtksvo.__version__, "in", os.path.dirname(vtksvo.__file__), "with VTK", vtk.VTK_VERSION)
assert vtksvo.__file__.startswith("/usr/lib/python3/dist-packages/"), vtksvo.__file__

sphere = vtk.vtkSphereSource()
sphere.SetCenter(0, 0, 1)
plane = vtk.vtkPlaneSource()
plane.SetOrigin(-2, -2, 0)
plane.SetPoint1(2, -2, 0)
plane.SetPoint2(-2, 2, 0)
renderer = vtk.vtkRenderer()
for source in (sphere, plane):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
light = vtk.vtkLight()
light.SetLightTypeToSceneLight()
light.SetPosition(3, -2, 5)
renderer.AddLight(light)
camera = renderer.GetActiveCamera()
camera.SetPosition(0, -6, 6)
camera.SetFocalPoint(0, 0, 0.5)
camera.SetViewUp(0, 0, 1)

window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetMultiSamples(0)
window.SetSize(400, 300)
window.AddRenderer(renderer)


def write(file):
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()
    return file


svo = vtksvo.vtkSVORenderPass()
renderer.SetPass(svo)
shadowed = write(os.path.join(sys.argv[1], "vtk-shadowed.png"))
svo.SetShadowTechniqueToNone()
plain = write(os.path.join(sys.argv[1], "vtk-plain.png"))
window.Finalize()
assert svo.GetNumberOfTracedActors() == 2, svo.GetNumberOfTracedActors()
check_shadow(shadowed, plain)
