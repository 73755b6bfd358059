#!/usr/bin/python3
"""Draws the Mandelbulb, an octree of an implicit function, with shadows: one picture, or with --frames a
movie of its power going from 3 to 9."""
import argparse
import os
import shutil
import subprocess

import vtk
import vtksvo


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", default="mandelbulb", help="folder for the picture, or for frames and movie")
    parser.add_argument("--level", type=int, default=9, help="of the octree; 10 takes four times as long")
    parser.add_argument("--power", type=float, default=8.0)
    parser.add_argument("--iterations", type=int, default=3, help="more of them: finer detail")
    parser.add_argument("--size", type=int, nargs=2, default=(1200, 900), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--samples", type=int, default=3, help="across a pixel; their mean is taken")
    parser.add_argument("--frames", type=int, default=0, help="of the movie, 25 a second")
    return parser.parse_args()


def set_power(bulb, octree, power):
    bulb.SetPower(power)
    reach = 1.01 * 2 ** (1 / (power - 1))  # nothing of it is further from the origin
    octree.SetModelBounds(-reach, reach, -reach, reach, -reach, reach)


def add_actor(renderer, port, color, ambient):
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputConnection(port)
    mapper.ScalarVisibilityOff()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetAmbient(ambient)
    renderer.AddActor(actor)


def add_light(renderer, position, intensity, color):
    light = vtk.vtkLight()
    light.SetPosition(position)
    light.SetIntensity(intensity)
    light.SetColor(color)
    renderer.AddLight(light)


def make_scene(octree, pixels):
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    add_actor(renderer, octree.GetOutputPort(), (0.93, 0.78, 0.55), 0.16)
    ground = vtk.vtkPlaneSource()
    ground.SetOrigin(-200, -200, -1.3)
    ground.SetPoint1(200, -200, -1.3)
    ground.SetPoint2(-200, 200, -1.3)
    add_actor(renderer, ground.GetOutputPort(), (0.62, 0.64, 0.68), 0.3)
    add_light(renderer, (1.2, -2.6, 2.6), 0.85, (1.0, 0.93, 0.8))
    add_light(renderer, (-3.0, -1.5, 1.5), 0.28, (0.55, 0.7, 1.0))
    add_light(renderer, (0.0, 0.0, 3.0), 0.2, (0.8, 0.85, 1.0))
    shadows = vtksvo.vtkSVORenderPass()
    shadows.SetShadowBufferResolution(4096)
    renderer.SetPass(shadows)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(2.6, -2.3, 1.35)
    camera.SetFocalPoint(0.0, 0.0, -0.12)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(38.0)
    camera.SetClippingRange(0.5, 400.0)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(*pixels)
    window.AddRenderer(renderer)
    return window


def save(window, samples, name):
    picture, mean, writer = vtk.vtkWindowToImageFilter(), vtk.vtkImageShrink3D(), vtk.vtkPNGWriter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    mean.SetInputConnection(picture.GetOutputPort())
    mean.SetShrinkFactors(samples, samples, 1)
    mean.AveragingOn()
    writer.SetInputConnection(mean.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()


def main():
    options = arguments()
    bulb, octree = vtksvo.vtkMandelbulbFunction(), vtksvo.vtkImplicitFunctionToSVO()
    bulb.SetNumberOfIterations(options.iterations)
    octree.SetImplicitFunction(bulb)
    octree.SetMaximumLevel(options.level)
    set_power(bulb, octree, options.power)
    window = make_scene(octree, [options.samples * edge for edge in options.size])
    os.makedirs(options.output, exist_ok=True)
    if options.frames == 0:
        save(window, options.samples, f"{options.output}/mandelbulb.png")
        print(f"{octree.GetNumberOfVoxels()} voxels in {octree.GetBuildTime():.1f} s: "
              f"{options.output}/mandelbulb.png")
        return
    for frame in range(options.frames):
        set_power(bulb, octree, 3.0 + 6.0 * frame / max(options.frames - 1, 1))
        save(window, options.samples, f"{options.output}/{frame:04}.png")
        print(f"{frame + 1} of {options.frames}: power {bulb.GetPower():.2f}, "
              f"{octree.GetNumberOfVoxels()} voxels in {octree.GetBuildTime():.1f} s", flush=True)
    if shutil.which("ffmpeg"):
        movie = "ffmpeg -y -loglevel error -i %04d.png -pix_fmt yuv420p mandelbulb.mp4"
        subprocess.run(movie.split(), cwd=options.output, check=True)


if __name__ == "__main__":
    main()
