#!/usr/bin/python3
"""Tens of thousands of balls ride on waves and cast shadows: one picture, or with --frames more a film.
Every ball is a copy of one sphere, made by a vtkGlyph3DMapper; only points, sizes and colours change."""
import argparse
import math
import os
import shutil
import subprocess
import time

import vtk
import vtksvo

GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))  # seeds of a sunflower: no rows, no gaps


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--glyphs", type=int, default=50000)
    parser.add_argument("--frames", type=int, default=1, help="of one period of the waves")
    parser.add_argument("--size", type=int, nargs=2, default=(1200, 750), help="of the pictures, pixels")
    parser.add_argument("--samples", type=int, default=1, help="along the edge of a pixel")
    parser.add_argument("--no-shadows", action="store_true")
    parser.add_argument("--output", default="glyphs", help="folder for the pictures and the movie")
    return parser.parse_args()


class Sea:
    """Balls, a unit apart and arranged as the seeds of a sunflower, on waves that meet."""

    def __init__(self, count):
        self.radius = math.sqrt(count)
        self.places = [(math.sqrt(i + 0.5) * math.cos(i * GOLDEN_ANGLE),
                        math.sqrt(i + 0.5) * math.sin(i * GOLDEN_ANGLE)) for i in range(count)]
        self.points, self.sizes, self.heights = vtk.vtkPoints(), vtk.vtkFloatArray(), vtk.vtkFloatArray()
        self.points.SetNumberOfPoints(count)
        for array, name in (self.sizes, "size"), (self.heights, "height"):
            array.SetName(name)
            array.SetNumberOfTuples(count)
        self.data = vtk.vtkPolyData()
        self.data.SetPoints(self.points)
        self.data.GetPointData().AddArray(self.sizes)
        self.data.GetPointData().SetScalars(self.heights)
        self.move(0)

    def move(self, phase):
        """Phase 0 to 1: one period."""
        r, turn = self.radius, 2 * math.pi * phase
        centres = [(-0.45 * r, 0.2 * r, 0.115 * r, 1.0), (0.55 * r, 0.5 * r, 0.16 * r, 0.7),
                   (0.15 * r, -0.75 * r, 0.09 * r, 0.55)]  # and lengths of waves, and their heights
        for i, (x, y) in enumerate(self.places):
            height = 0.0
            for cx, cy, length, amplitude in centres:
                way = math.hypot(x - cx, y - cy)
                height += amplitude * math.sin(way / length * 2 * math.pi / 2.5 - turn) / (1 + way / r)
            self.points.SetPoint(i, x, y, 0.034 * r * height)
            self.sizes.SetValue(i, 1.7 + 0.35 * height)
            self.heights.SetValue(i, height)
        self.points.Modified()
        self.sizes.Modified()
        self.heights.Modified()


def make_colors():
    colors = vtk.vtkColorTransferFunction()
    for height, color in ((-1.3, (0.03, 0.08, 0.27)), (-0.6, (0.05, 0.29, 0.55)), (0.0, (0.10, 0.58, 0.66)),
                          (0.45, (0.93, 0.84, 0.58)), (0.9, (0.98, 0.52, 0.25)), (1.4, (0.80, 0.16, 0.20))):
        colors.AddRGBPoint(height, *color)
    return colors


def make_scene(sea, options):
    ball, mapper, balls = vtk.vtkSphereSource(), vtk.vtkGlyph3DMapper(), vtk.vtkActor()
    ball.SetThetaResolution(20)
    ball.SetPhiResolution(14)
    mapper.SetInputData(sea.data)
    mapper.SetSourceConnection(ball.GetOutputPort())
    mapper.SetScaleArray("size")
    mapper.SetScaleModeToScaleByMagnitude()
    mapper.SetLookupTable(make_colors())
    mapper.UseLookupTableScalarRangeOn()
    balls.SetMapper(mapper)
    balls.GetProperty().SetAmbient(0.12)
    balls.GetProperty().SetSpecular(0.25)
    balls.GetProperty().SetSpecularPower(25)

    r = sea.radius
    ground, below, floor = vtk.vtkPlaneSource(), vtk.vtkPolyDataMapper(), vtk.vtkActor()
    ground.SetOrigin(-9 * r, -9 * r, -0.075 * r)
    ground.SetPoint1(9 * r, -9 * r, -0.075 * r)
    ground.SetPoint2(-9 * r, 9 * r, -0.075 * r)
    below.SetInputConnection(ground.GetOutputPort())
    floor.SetMapper(below)
    floor.GetProperty().SetColor(0.93, 0.94, 0.96)
    floor.GetProperty().SetAmbient(0.2)

    renderer, window, sun = vtk.vtkRenderer(), vtk.vtkRenderWindow(), vtk.vtkLight()
    renderer.AddActor(balls)
    renderer.AddActor(floor)
    sun.SetPosition(-2.0, 1.0, 1.3)  # low: crests throw their shadows into the troughs
    sun.SetColor(1.0, 0.94, 0.84)
    renderer.AddLight(sun)
    sky = vtk.vtkLight()
    sky.SetLightTypeToHeadlight()  # casts none
    sky.SetColor(0.75, 0.87, 1.0)
    sky.SetIntensity(0.45)
    renderer.AddLight(sky)
    renderer.SetBackground(0.80, 0.86, 0.93)
    shadows = vtksvo.vtkSVORenderPass()
    shadows.SetShadowBufferResolution(4096)
    if options.no_shadows:
        shadows.SetShadowTechniqueToNone()
    renderer.SetPass(shadows)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.75 * r, -2.05 * r, 1.25 * r)
    camera.SetFocalPoint(0, -0.14 * r, 0)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(32)
    renderer.ResetCameraClippingRange()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(*(options.samples * edge for edge in options.size))
    window.AddRenderer(renderer)
    return window, shadows


def write(window, samples, path):
    picture, mean, writer = vtk.vtkWindowToImageFilter(), vtk.vtkImageShrink3D(), vtk.vtkPNGWriter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.ShouldRerenderOff()
    mean.SetInputConnection(picture.GetOutputPort())
    mean.SetShrinkFactors(samples, samples, 1)
    mean.AveragingOn()
    writer.SetInputConnection(mean.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def main():
    options = arguments()
    sea = Sea(max(options.glyphs, 1))
    window, shadows = make_scene(sea, options)
    os.makedirs(options.output, exist_ok=True)
    for frame in range(max(options.frames, 1)):
        sea.move(frame / max(options.frames, 1))
        begin = time.perf_counter()
        window.Render()
        seconds = time.perf_counter() - begin
        write(window, options.samples, os.path.join(options.output, f"{frame:04}.png"))
        print(f"frame {frame}: {shadows.GetNumberOfInstances()} instances, {seconds:.2f} s, of these "
              f"collecting {shadows.GetCollectTime():.2f} s", flush=True)
    window.Finalize()
    if options.frames > 1 and shutil.which("ffmpeg"):
        movie = "ffmpeg -y -loglevel error -i %04d.png -pix_fmt yuv420p glyphs.mp4"
        subprocess.run(movie.split(), cwd=options.output, check=True)


if __name__ == "__main__":
    main()
