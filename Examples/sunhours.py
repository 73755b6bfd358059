#!/usr/bin/python3
"""Hours of sun in a small city, and how much of the sky it sees: arrays on a mesh, and a picture."""
import argparse, math, vtk, vtksvo
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--date", type=int, nargs=3, default=(2024, 12, 21), metavar=("YEAR", "MONTH", "DAY"))
parser.add_argument("--latitude", type=float, default=48.1, help="degrees, north is positive")
parser.add_argument("--longitude", type=float, default=11.6, help="degrees, east is positive")
parser.add_argument("--timezone", type=float, default=1.0, help="hours ahead of UTC")
parser.add_argument("--sky", action="store_true", help="sky view factor instead of hours of sun")
parser.add_argument("--cell", type=float, default=2.0, help="edge of the mesh's cells, metres")
parser.add_argument("--output", default="sunhours", help=".png and .vtp are added to it")
options = parser.parse_args()

city = vtk.vtkAppendPolyData()
def rectangle(corner, u, v):
    """Cut into cells; it faces along u x v."""
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(corner)
    plane.SetPoint1([a + b for a, b in zip(corner, u)])
    plane.SetPoint2([a + b for a, b in zip(corner, v)])
    plane.SetResolution(*(max(1, round(math.hypot(*edge) / options.cell)) for edge in (u, v)))
    city.AddInputConnection(plane.GetOutputPort())
rectangle((-100, -100, 0), (200, 0, 0), (0, 200, 0))
for i in range(5):
    for j in range(5):
        x, y, height = -85 + 37 * i, -85 + 37 * j, 8 + (37 * i + 23 * j + 11 * i * j) % 41
        rectangle((x, y, height), (22, 0, 0), (0, 22, 0))
        rectangle((x, y, 0), (22, 0, 0), (0, 0, height))
        rectangle((x + 22, y, 0), (0, 22, 0), (0, 0, height))
        rectangle((x + 22, y + 22, 0), (-22, 0, 0), (0, 0, height))
        rectangle((x, y + 22, 0), (0, -22, 0), (0, 0, height))

exposure = vtksvo.vtkSVOShadowFilter()
exposure.SetInputConnection(city.GetOutputPort())
exposure.SetWriteShadow(False)  # the sum is enough
exposure.SetCosineWeighted(options.sky)
if options.sky:
    lights, title = vtksvo.vtkSVOSky(), "Sky view factor"
else:
    lights, title = vtksvo.vtkSVOSunPath(), "Hours of sun"
    lights.SetDate(*options.date)
    lights.SetLatitude(options.latitude)
    lights.SetLongitude(options.longitude)
    lights.SetTimeZone(options.timezone)
    lights.SetStep(10)
print(lights.AddLights(exposure), "lights")
exposure.Update()
result = exposure.GetOutput()
hours = result.GetCellData().GetArray("Exposure")
result.GetCellData().SetScalars(hours)
print(f"{result.GetNumberOfCells()} cells, {hours.GetRange()[0]:.2f} to {hours.GetRange()[1]:.2f}")
writer = vtk.vtkXMLPolyDataWriter()
writer.SetInputData(result), writer.SetFileName(options.output + ".vtp"), writer.Write()

table = vtk.vtkColorTransferFunction()
for at, color in (0, (0.10, 0.13, 0.35)), (0.35, (0.55, 0.25, 0.45)), (0.7, (0.95, 0.60, 0.25)), (1, (1, 0.97, 0.75)):
    table.AddRGBPoint(at * hours.GetRange()[1], *color)
mapper, actor, bar = vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkScalarBarActor()
mapper.SetInputData(result), mapper.SetLookupTable(table), mapper.UseLookupTableScalarRangeOn()
actor.SetMapper(mapper), actor.GetProperty().LightingOff()  # the numbers are the picture
bar.SetLookupTable(table), bar.SetTitle(title), bar.SetLabelFormat("%.2f"), bar.SetNumberOfLabels(5)
bar.SetPosition(0.87, 0.1), bar.SetWidth(0.11), bar.SetHeight(0.8), bar.UnconstrainedFontSizeOn(), bar.SetVerticalTitleSeparation(12)
for text in bar.GetTitleTextProperty(), bar.GetLabelTextProperty():
    text.SetFontSize(20), text.ItalicOff(), text.BoldOff(), text.ShadowOff()
renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
renderer.AddActor(actor), renderer.AddActor(bar), renderer.SetBackground(0.25, 0.28, 0.32)
camera = renderer.GetActiveCamera()  # from the south-west: north is y
camera.SetPosition(-215, -285, 235), camera.SetFocalPoint(12, -22, 0), camera.SetViewUp(0, 0, 1)
renderer.ResetCameraClippingRange()
window.SetOffScreenRendering(True), window.SetMultiSamples(8), window.SetSize(1280, 720)
window.AddRenderer(renderer), window.Render()
picture, png = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
picture.SetInput(window), png.SetInputConnection(picture.GetOutputPort())
png.SetFileName(options.output + ".png"), png.Write()
