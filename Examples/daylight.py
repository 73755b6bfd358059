#!/usr/bin/python3
"""A day over a city, as a movie: a sun of half a degree, a sky, and what lies between."""
import argparse
import math

import vtk
from vtksvo.vtkSVOPass import vtkSVORenderPass

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--output", default="daylight.ogv", help="the movie")
parser.add_argument("--frames", type=int, default=120, help="frames of the day, 24 a second")
parser.add_argument("--samples", type=int, default=16, help="of the sun and of the sky, a pixel")
parser.add_argument("--size", type=int, nargs=2, default=(1280, 720), help="pixels")
options = parser.parse_args()

renderer = vtk.vtkRenderer()
random = vtk.vtkMinimalStandardRandomSequence()
houses = vtk.vtkAppendPolyData()
for i in range(17 * 17):
    house, height = vtk.vtkCubeSource(), 0.2 + 2 * random.GetValue() ** 3
    house.SetXLength(0.7), house.SetYLength(0.7), house.SetZLength(height)
    house.SetCenter(i % 17 - 8, i // 17 - 8, height / 2)
    houses.AddInputConnection(house.GetOutputPort())
    random.Next()
ground = vtk.vtkPlaneSource()
ground.SetOrigin(-20, -20, 0), ground.SetPoint1(20, -20, 0), ground.SetPoint2(-20, 20, 0)
for shape, color in (houses, (0.85, 0.8, 0.72)), (ground, (0.55, 0.6, 0.5)):
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputConnection(shape.GetOutputPort()), actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color), renderer.AddActor(actor)

sun = vtk.vtkLight()
sun.SetLightTypeToSceneLight(), renderer.AddLight(sun)
svo = vtkSVORenderPass()
svo.SetLightSize(0.533, sun)
svo.SetSkyLight(True), svo.SetMaximumLightSamples(options.samples)
renderer.SetPass(svo)
camera = renderer.GetActiveCamera()
camera.SetPosition(9, -12, 8), camera.SetFocalPoint(0, 0, 0), camera.SetViewUp(0, 0, 1)
camera.SetViewAngle(40), renderer.ResetCameraClippingRange()
window, picture, movie = vtk.vtkRenderWindow(), vtk.vtkWindowToImageFilter(), vtk.vtkOggTheoraWriter()
window.SetOffScreenRendering(True), window.SetSize(options.size), window.AddRenderer(renderer)
picture.SetInput(window), picture.ReadFrontBufferOff()
movie.SetInputConnection(picture.GetOutputPort()), movie.SetRate(24)
movie.SetFileName(options.output), movie.Start()
for frame in range(options.frames):
    hour = math.pi * (frame + 0.5) / options.frames  # from sunrise to sunset
    high = math.sin(hour)
    sun.SetPosition(10 * math.cos(hour), -6, 8 * high)
    sun.SetColor(1, 0.6 + 0.35 * high, 0.3 + 0.6 * high), sun.SetIntensity(min(2 * high, 0.9))
    svo.SetSkyStrength(0.2 + 0.5 * high), renderer.SetBackground(0.5 * high, 0.6 * high, 0.8 * high)
    picture.Modified(), movie.Write()
movie.End()
