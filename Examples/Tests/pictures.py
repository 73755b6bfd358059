"""Reads pictures for the tests of the examples."""

import vtk


class Picture:
    """A PNG file's pixels."""

    def __init__(self, path):
        reader = vtk.vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        self.image = reader.GetOutput()
        self.size = self.image.GetDimensions()[:2]

    def brightness(self, x, y):
        """Mean of the three channels at a pixel counted from the lower left, 0 to 255."""
        return sum(self.image.GetScalarComponentAsDouble(x, y, 0, c) for c in range(3)) / 3

    def differing_values(self, other):
        """How many channel values differ between two pictures of one size."""
        ours, theirs = (bytes(memoryview(picture.image.GetPointData().GetScalars()))
                        for picture in (self, other))
        return sum(map(int.__ne__, ours, theirs))
