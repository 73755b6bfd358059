"""openvdb.py shows its own ring, and the grids of a file."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import vtk
import vtksvo

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "openvdb.py"


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class TestOpenVDB(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.picture = self.folder / "out.png"

    def show(self, *arguments):
        done = run(*arguments, "--output", self.picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        picture = Picture(self.picture)
        self.assertEqual(picture.size, (1280, 640))
        return picture

    def test_shows_its_own_ring(self):
        self.show()

    def test_shows_the_grids_that_are_named(self):
        ball, convert, writer = vtk.vtkSphereSource(), vtksvo.vtkPolyDataToSVO(), vtksvo.vtkSVOVDBWriter()
        ball.SetThetaResolution(40)
        ball.SetPhiResolution(40)
        convert.SetInputConnection(ball.GetOutputPort())
        convert.SetMaximumLevel(7)
        writer.SetInputConnection(convert.GetOutputPort())
        writer.WriteLevelSetOn()
        writer.SetFileName(str(self.folder / "ball.vdb"))
        writer.Write()
        both = self.show(self.folder / "ball.vdb")
        one = self.show(self.folder / "ball.vdb", "--grid", "surface")
        self.assertGreater(both.differing_values(one), 10000)

    def test_missing_file_is_one_clear_message(self):
        done = run(self.folder / "none.vdb")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("none.vdb", done.stderr)
        self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
