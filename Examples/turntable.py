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
surface, ground = vtk.vtkGeometryFilter(), vtk.vtkRegularPolygonSource()
surface.SetInputConnection(source.GetOutputPort()), surface.Update()
(x, y, z), size = surface.GetOutput().GetCenter(), surface.GetOutput().GetLength()
ground.SetCenter(x, y, surface.GetOutput().GetBounds()[4]), ground.SetRadius(5 * size)
renderer, window, light = vtk.vtkRenderer(), vtk.vtkRenderWindow(), vtk.vtkLight()
for shape in ground, surface:
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputConnection(shape.GetOutputPort())
    actor.SetMapper(mapper), actor.SetOrigin(x, y, z), renderer.AddActor(actor)
light.SetPositional(True), light.SetConeAngle(180), light.SetPosition(x, y - size, z + 2 * size)
renderer.AddLight(light), renderer.SetPass(vtksvo.vtkSVORenderPass())
camera = renderer.GetActiveCamera()
camera.SetPosition(x + size, y - 2 * size, z + size)
camera.SetFocalPoint(x, y, z), camera.SetViewUp(0, 0, 1), renderer.ResetCameraClippingRange()
window.SetOffScreenRendering(True), window.SetSize(1280, 720), window.AddRenderer(renderer)
os.makedirs(options.output, exist_ok=True)
for frame in range(options.frames):
    actor.RotateZ(360 / options.frames)
    window.Render()
    picture, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    picture.SetInput(window), writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(f"{options.output}/{frame:04}.png"), writer.Write()
if shutil.which("ffmpeg"):
    movie = "ffmpeg -y -loglevel error -i %04d.png -pix_fmt yuv420p turntable.mp4"
    subprocess.run(movie.split(), cwd=options.output, check=True)
