"""daylight.py films a day."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[1] / "daylight.py"


class TestDaylight(unittest.TestCase):
    def test_films_a_day(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        movie = folder / "day.ogv"
        done = subprocess.run(
            [sys.executable, SCRIPT, "--output", movie, "--frames", "3", "--samples", "4", "--size", "320", "180"],
            text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        written = movie.read_bytes()
        self.assertEqual(written[:4], b"OggS")
        self.assertGreater(len(written), 5000)


if __name__ == "__main__":
    unittest.main()
