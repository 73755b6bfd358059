"""mandelbulb.py draws one picture, and films another power in each frame."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "mandelbulb.py"


class TestMandelbulb(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_script(self, *arguments):
        done = subprocess.run(
            [sys.executable, SCRIPT, "--output", self.folder, "--level", "6", "--size", "120", "90",
             *map(str, arguments)], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_draws_a_picture(self):
        self.assertIn("voxels", self.run_script("--samples", 2))
        picture = Picture(self.folder / "mandelbulb.png")
        self.assertEqual(picture.size, (120, 90))
        # The bulb in the middle is lit in places and dark in others, the ground behind it is grey.
        rows = [picture.brightness(x, 45) for x in range(35, 85)]
        self.assertGreater(max(rows), 120)
        self.assertLess(min(rows), 70)
        self.assertAlmostEqual(picture.brightness(3, 80), 170, delta=30)

    def test_films_its_power(self):
        self.assertIn("power 9.00", self.run_script("--samples", 1, "--frames", 2))
        first, last = (Picture(self.folder / name) for name in ("0000.png", "0001.png"))
        self.assertGreater(first.differing_values(last), 2000)
        if shutil.which("ffmpeg"):
            self.assertGreater((self.folder / "mandelbulb.mp4").stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
