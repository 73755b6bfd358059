"""ShadowedSphere's picture has the shadow where the light's ray says."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import vtk

from pictures import Picture

PROGRAM = sys.argv.pop(1)
LIGHT = (-1.5, -1.5, 3)
CENTER = (0, 0, 0.7)


def pixel(point, size):
    """Where the program's camera sees a point."""
    camera = vtk.vtkCamera()
    camera.SetPosition(1.5, -4, 2.2)
    camera.SetFocalPoint(0, 0, 0.4)
    camera.SetViewUp(0, 0, 1)
    matrix = camera.GetCompositeProjectionTransformMatrix(size[0] / size[1], -1, 1)
    x, y, _, w = matrix.MultiplyPoint((*point, 1))
    return tuple(int(0.5 * (c / w + 1) * n) for c, n in zip((x, y), size))


class TestShadowedSphere(unittest.TestCase):
    def test_shadow_lies_behind_the_sphere(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "sphere.png"
            subprocess.run([PROGRAM, str(path)], check=True)
            picture = Picture(path)
        along = LIGHT[2] / (LIGHT[2] - CENTER[2])
        shadow = [a + along * (b - a) for a, b in zip(LIGHT, CENTER)]
        self.assertAlmostEqual(shadow[2], 0)
        dark = picture.brightness(*pixel(shadow, picture.size))
        lit = picture.brightness(*pixel((shadow[0] + 1, shadow[1] - 1, 0), picture.size))
        self.assertGreater(lit, 120)
        self.assertLess(dark, 0.5 * lit)
        self.assertGreater(dark, 5, "the ambient light stays")

    def test_folder_that_is_not_there_fails(self):
        done = subprocess.run([PROGRAM, "/nonexistent/folder/sphere.png"], check=False,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
