"""isosurface.py draws its own volume and a file, and goes from one value to another."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import vtk

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "isosurface.py"


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class TestIsosurface(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def pictures(self, *options):
        done = run(*options, "--output", self.folder / "out")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.count(" voxels in "), len(done.stdout.splitlines()))
        return [Picture(path) for path in sorted((self.folder / "out").glob("*.png"))]

    def test_own_volume(self):
        pictures = self.pictures()
        self.assertEqual(len(pictures), 1)
        self.assertEqual(pictures[0].size, (1000, 700))

    def test_values_of_a_file(self):
        source, writer = vtk.vtkRTAnalyticSource(), vtk.vtkXMLImageDataWriter()
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(str(self.folder / "volume.vti"))
        writer.Write()
        pictures = self.pictures(self.folder / "volume.vti", "--value", 120, "--to", 180,
                                 "--frames", 3)
        self.assertEqual(len(pictures), 3)
        for a, b in ((0, 1), (1, 2), (0, 2)):
            self.assertGreater(pictures[a].differing_values(pictures[b]), 1000)
        # The last one is what the value alone gives.
        alone = self.pictures(self.folder / "volume.vti", "--value", 180)[0]
        self.assertEqual(alone.differing_values(pictures[2]), 0)

    def test_missing_file_is_one_clear_message(self):
        done = run(self.folder / "none.vti")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("none.vti", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
