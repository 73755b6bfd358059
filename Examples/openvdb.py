#!/usr/bin/python3
"""A picture, with shadows, of the grids of an OpenVDB file, side by side. Without a file it writes one first: a ring
as a mask of its voxels, and as a level set."""
import argparse, os, tempfile, vtk, vtksvo
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("file", nargs="?", type=argparse.FileType(), help=".vdb")
parser.add_argument("--grid", action="append", help="its name; again for another (default: all)")
parser.add_argument("--threshold", type=float, default=0, help="values of fog above this are occupied")
parser.add_argument("--output", default="openvdb.png", help="the picture")
options = parser.parse_args()
folder = tempfile.TemporaryDirectory()
path = options.file.name if options.file else os.path.join(folder.name, "ring.vdb")
if not options.file:
    ring, convert, writer = vtk.vtkSuperquadricSource(), vtksvo.vtkPolyDataToSVO(), vtksvo.vtkSVOVDBWriter()
    ring.ToroidalOn(), ring.SetThetaResolution(100), ring.SetPhiResolution(100), ring.SetAxisOfSymmetry(2)
    convert.SetInputConnection(ring.GetOutputPort()), convert.SetMaximumLevel(6)
    writer.SetInputConnection(convert.GetOutputPort()), writer.SetFileName(path)
    writer.WriteLevelSetOn(), writer.Write()
names, at = vtksvo.vtkSVOVDBReader(), 0.0
names.SetFileName(path)
renderer, colors = vtk.vtkRenderer(), ((1, 0.5, 0.35), (0.4, 0.65, 0.9), (0.6, 0.8, 0.4))
for i, name in enumerate(options.grid or [names.GetGridName(k) for k in range(names.GetNumberOfGrids())]):
    reader, mapper, actor = vtksvo.vtkSVOVDBReader(), vtk.vtkPolyDataMapper(), vtk.vtkActor()
    reader.SetFileName(path), reader.SetGridName(name), reader.SetThreshold(options.threshold)
    mapper.SetInputConnection(reader.GetOutputPort()), reader.Update()
    if reader.GetNumberOfVoxels() == 0:
        continue  # the reader said why
    b = reader.GetOutput().GetBounds()
    actor.SetMapper(mapper), actor.SetPosition(at - b[0], -(b[2] + b[3]) / 2, -b[4])
    at += 1.2 * (b[1] - b[0])
    actor.GetProperty().SetColor(colors[i % 3]), actor.GetProperty().SetAmbient(0.2)
    renderer.AddActor(actor)
if at == 0:
    parser.exit(1, f"{path} has nothing to show\n")
size = max(renderer.ComputeVisiblePropBounds()[k + 1] - renderer.ComputeVisiblePropBounds()[k] for k in (0, 2, 4))
ground, mapper, actor, light = vtk.vtkCubeSource(), vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkLight()
ground.SetBounds(-5 * size, 5 * size, -5 * size, 5 * size, -size, -size / 100)
mapper.SetInputConnection(ground.GetOutputPort()), actor.SetMapper(mapper)
light.SetPositional(True), light.SetConeAngle(180), light.SetPosition(-size, -size, 1.5 * size)
renderer.AddLight(light), renderer.SetBackground(0.3, 0.35, 0.4)
renderer.GetActiveCamera().SetPosition(0.3, -1, 0.55), renderer.GetActiveCamera().SetViewUp(0, 0, 1)
renderer.ResetCamera(), renderer.GetActiveCamera().Zoom(1.4)
actor.GetProperty().SetColor(0.9, 0.86, 0.8), renderer.AddActor(actor), renderer.ResetCameraClippingRange()
renderer.SetPass(vtksvo.vtkSVORenderPass())
window, picture, writer = vtk.vtkRenderWindow(), vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
window.SetOffScreenRendering(True), window.SetSize(1280, 640), window.AddRenderer(renderer)
picture.SetInput(window), writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName(options.output), writer.Write()
