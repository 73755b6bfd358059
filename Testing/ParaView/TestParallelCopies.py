"""Copies of glyphs and balls of splats on one process, on several, and on servers: the same pictures, the same
shadows and no message.

usage: TestParallelCopies.py folder of ParaView's programs
"""

import glob
import os
import unittest

import pictures
from processes import MPIRUN, file_of, program, run, run_with_server, script

SCRIPT = script("copies_in_parallel.py")
NAMES = "glyphs", "larger", "turned", "splats"
REFUSED = ("ERR|", "WARN|")


class TestParallelCopies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for old in glob.glob(os.path.join(os.environ["VTKSVO_OUTPUT"], "*")):
            os.remove(old)
        run([program("pvbatch"), SCRIPT, "one"], REFUSED)

    def check(self, prefix):
        for name in NAMES:
            with self.subTest(picture=name):
                one = pictures.read(file_of("one", name))
                # They show something, and shadows on the ground.
                self.assertGreater(pictures.differing(one, one[:1, :1] + 0 * one), 0.01)
                self.assertGreater((one[: one.shape[0] // 2].max(axis=2) < 60).mean(), 0.003)
                difference = pictures.differing(pictures.read(file_of(prefix, name)), one, 2)
                print(f"{prefix}-{name}: {difference:.6f} of the pixels differ")
                self.assertLess(difference, 1e-3)

    def test_two_processes(self):
        run(MPIRUN + ["2", program("pvbatch"), SCRIPT, "two"], REFUSED)
        self.check("two")

    def test_server_of_two_processes(self):
        client = [program("pvpython"), SCRIPT, "copies2"]
        run_with_server(MPIRUN + ["2", program("pvserver")], client, 21117, REFUSED)
        self.check("copies2")


if __name__ == "__main__":
    unittest.main(verbosity=2)
