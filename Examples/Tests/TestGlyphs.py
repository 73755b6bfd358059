"""glyphs.py draws as many balls as it is told to, with shadows, and moves them from frame to frame."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "glyphs.py"


class TestGlyphs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_script(self, *arguments):
        done = subprocess.run(
            [sys.executable, SCRIPT, "--output", self.folder, "--size", "160", "100", "--glyphs", "400",
             *map(str, arguments)], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_draws_copies_with_shadows(self):
        self.assertIn("401 instances", self.run_script("--samples", 2))  # with the ground
        shadowed = Picture(self.folder / "0000.png")
        self.assertEqual(shadowed.size, (160, 100))
        self.run_script("--samples", 2, "--no-shadows")
        lit = Picture(self.folder / "0000.png")
        darker = sum(shadowed.brightness(x, y) < lit.brightness(x, y) - 15
                     for x in range(160) for y in range(100))
        self.assertGreater(darker, 300)
        self.assertAlmostEqual(shadowed.brightness(5, 95), lit.brightness(5, 95), delta=1)

    def test_moves_them(self):
        self.assertIn("frame 1", self.run_script("--frames", 2))
        first, last = (Picture(self.folder / name) for name in ("0000.png", "0001.png"))
        self.assertGreater(first.differing_values(last), 2000)
        if shutil.which("ffmpeg"):
            self.assertGreater((self.folder / "glyphs.mp4").stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
