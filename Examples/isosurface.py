#!/usr/bin/python3
"""Draws where a volume takes a value, with shadows and without triangles: one picture, or with --to
the frames from one value to the other."""
import argparse
import os
import sys

import vtk
import vtksvo


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("volume", nargs="?", help=".vti .mha .nrrd; without one: a volume of its own")
    parser.add_argument("--value", type=float, help="default: the middle of the range")
    parser.add_argument("--to", type=float, help="the last frame's value")
    parser.add_argument("--frames", type=int, default=25, help="from --value to --to")
    parser.add_argument("--level", type=int, help="of the octree; default: voxels as small as cells, at least 8")
    parser.add_argument("--output", default="isosurface", help="folder for the pictures")
    return parser.parse_args()


def read(path):
    """The image, or None."""
    if not path:
        wavelet = vtk.vtkRTAnalyticSource()
        wavelet.SetWholeExtent(-48, 48, -48, 48, -48, 48)
        wavelet.SetXFreq(24), wavelet.SetYFreq(16), wavelet.SetZFreq(19)
        wavelet.Update()
        return wavelet.GetOutput()
    readers = {".vti": vtk.vtkXMLImageDataReader, ".mha": vtk.vtkMetaImageReader,
               ".mhd": vtk.vtkMetaImageReader, ".nrrd": vtk.vtkNrrdReader}
    reader = readers.get(os.path.splitext(path)[1].lower())
    if not reader or not os.path.exists(path):
        return None
    reader = reader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput() if reader.GetOutput().GetPointData().GetScalars() else None


def add_actor(renderer, port, color):
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputConnection(port)
    mapper.ScalarVisibilityOff()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetAmbient(0.15)
    renderer.AddActor(actor)


def make_scene(image, surface):
    (x, y, z), size, bottom = image.GetCenter(), image.GetLength(), image.GetBounds()[4]
    ground = vtk.vtkPlaneSource()
    ground.SetOrigin(x - 3 * size, y - 3 * size, bottom)
    ground.SetPoint1(x + 3 * size, y - 3 * size, bottom)
    ground.SetPoint2(x - 3 * size, y + 3 * size, bottom)
    renderer, window, light = vtk.vtkRenderer(), vtk.vtkRenderWindow(), vtk.vtkLight()
    add_actor(renderer, surface.GetOutputPort(), (0.9, 0.62, 0.42))
    add_actor(renderer, ground.GetOutputPort(), (0.75, 0.76, 0.8))
    light.SetPosition(x + size, y - size, z + 1.4 * size)
    light.SetFocalPoint(x, y, z)
    renderer.AddLight(light)
    renderer.SetBackground(0.55, 0.62, 0.7)
    shadows = vtksvo.vtkSVORenderPass()
    shadows.SetAntiAliasing(True)
    renderer.SetPass(shadows)
    camera = vtk.vtkCamera()
    camera.SetPosition(x + 0.7 * size, y - 1.35 * size, z + 0.75 * size)
    camera.SetFocalPoint(x, y, z - 0.1 * size)
    camera.SetViewUp(0, 0, 1)
    renderer.SetActiveCamera(camera)
    renderer.ResetCameraClippingRange()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(1000, 700)
    window.AddRenderer(renderer)
    return window


def write(window, path):
    picture, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def main():
    options = arguments()
    image = read(options.volume)
    if image is None:
        sys.exit(f"isosurface.py: {options.volume} cannot be read as a volume with scalars")
    low, high = image.GetScalarRange()
    first = (low + high) / 2 if options.value is None else options.value
    surface = vtksvo.vtkImageToSVO()
    surface.SetInputData(image)
    surface.SetMaximumLevel(options.level or max(8, (max(image.GetDimensions()) - 2).bit_length()))
    surface.SetValue(first)
    window = make_scene(image, surface)
    os.makedirs(options.output, exist_ok=True)
    frames = 1 if options.to is None else max(options.frames, 2)
    for frame in range(frames):
        share = frame / (frames - 1) if frames > 1 else 0
        surface.SetValue(first + share * ((options.to or 0) - first))
        write(window, os.path.join(options.output, f"{frame:04}.png"))
        print(f"{surface.GetValue():.4g}: {surface.GetNumberOfVoxels()} voxels in "
              f"{1000 * surface.GetBuildTime():.0f} ms", flush=True)
    window.Finalize()


if __name__ == "__main__":
    main()
