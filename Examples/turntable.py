#!/usr/bin/python3
"""Turns a mesh once around, with shadows: PNG frames and, where ffmpeg is found, an .mp4 movie."""
import argparse, os, shutil, subprocess, vtk, vtksvo
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("mesh", nargs="?", type=argparse.FileType(), help=".stl .ply .obj .vtk .vtp")
parser.add_argument("--output", default="turntable", help="folder for the frames and the movie")
parser.add_argument("--frames", type=int, default=100, help="frames of the turn, 25 a second")
options = parser.parse_args()
readers = {".stl": vtk.vtkSTLReader, ".ply": vtk.vtkPLYReader, ".obj": vtk.vtkOBJReader,
           ".vtk": vtk.vtkGenericDataObjectReader, "ring": vtk.vtkSuperquadricSource}
kind = os.path.splitext(options.mesh.name)[1].lower() if options.mesh else "ring"
source = readers.get(kind, vtk.vtkXMLGenericDataObjectReader)()
source.SetFileName(options.mesh.name) if options.mesh else source.ToroidalOn()
surface, ground = vtk.vtkGeometryFilter(), vtk.vtkCubeSource()
surface.SetInputConnection(source.GetOutputPort()), surface.Update()
mesh = surface.GetOutput()
(x, y, z), size, bottom = mesh.GetCenter(), mesh.GetLength(), mesh.GetBounds()[4]
ground.SetBounds(x - 8 * size, x + 8 * size, y - 8 * size, y + 8 * size, bottom - size, bottom)
renderer, camera, light = vtk.vtkRenderer(), vtk.vtkCamera(), vtk.vtkLight()
for shape, rgb in (ground, (0.9, 0.86, 0.8)), (surface, (1, 0.5, 0.35)):
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputConnection(shape.GetOutputPort()), renderer.AddActor(actor)
    actor.SetMapper(mapper), actor.GetProperty().SetColor(rgb), actor.GetProperty().SetAmbient(0.2)
light.SetPositional(True), light.SetConeAngle(180), light.SetPosition(x, y - size, z + size)
renderer.AddLight(light), renderer.SetActiveCamera(camera), renderer.SetBackground(0.3, 0.35, 0.4)
renderer.SetPass(vtksvo.vtkSVORenderPass())  # the one line that shadows take
camera.SetPosition(x + 0.7 * size, y - 1.6 * size, z + 0.8 * size)
camera.SetFocalPoint(x, y, z), camera.SetViewUp(0, 0, 1), renderer.ResetCameraClippingRange()
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(True), window.SetSize(1280, 720), window.AddRenderer(renderer)
os.makedirs(options.output, exist_ok=True)
for frame in range(options.frames):
    actor.SetOrigin(x, y, z), actor.RotateZ(360 / options.frames)
    picture, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    picture.SetInput(window), writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(f"{options.output}/{frame:04}.png"), writer.Write()
if shutil.which("ffmpeg"):
    movie = "ffmpeg -y -loglevel error -i %04d.png -pix_fmt yuv420p turntable.mp4"
    subprocess.run(movie.split(), cwd=options.output, check=True)
