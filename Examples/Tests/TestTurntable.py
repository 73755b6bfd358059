"""turntable.py films its own shape and a mesh file, and turns them."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import vtk

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "turntable.py"


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class TestTurntable(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def check_turn(self, *mesh):
        done = run(*mesh, "--output", self.folder / "out", "--frames", 3)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        frames = sorted((self.folder / "out").glob("*.png"))
        self.assertEqual([frame.name for frame in frames], ["0000.png", "0001.png", "0002.png"])
        first, second = map(Picture, frames[:2])
        self.assertEqual(first.size, (1280, 720))
        self.assertGreater(first.differing_values(second), 0)
        if shutil.which("ffmpeg"):
            self.assertGreater((self.folder / "out" / "turntable.mp4").stat().st_size, 1000)

    def test_films_its_own_shape(self):
        self.check_turn()

    def test_films_an_stl_file(self):
        cone = vtk.vtkConeSource()
        writer = vtk.vtkSTLWriter()
        writer.SetInputConnection(cone.GetOutputPort())
        writer.SetFileName(str(self.folder / "cone.stl"))
        writer.Write()
        self.check_turn(self.folder / "cone.stl")

    def test_missing_file_is_one_clear_message(self):
        done = run(self.folder / "none.stl")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("none.stl", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_is_under_forty_lines(self):
        self.assertLess(len(SCRIPT.read_text().splitlines()), 40)


if __name__ == "__main__":
    unittest.main()
