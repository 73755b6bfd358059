"""Reads and compares pictures. It needs VTK's Python package, but not ParaView's."""

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def differing(a, b, tolerance=8):
    """Share of the pixels with a channel that differs by more than `tolerance` of 255."""
    return float((abs(a - b).max(axis=2) > tolerance).mean())
