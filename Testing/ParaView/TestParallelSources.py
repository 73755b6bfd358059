"""Images, functions and OpenVDB's files on one process, on several, and on servers: the same pictures, the same file
and no message.

usage: TestParallelSources.py folder of ParaView's programs
"""

import glob
import os
import re
import unittest

import pictures
from processes import MPIRUN, file_of, program, run, run_with_server, script

SCRIPT = script("sources_in_parallel.py")
# The largest difference that is none. Normals are means of voxels of one part, so where parts meet they are a little
# different, the more the wider voxels look: in most pictures they are a pixel.
TOLERANCES = {"image": 8, "coarse-image": 24, "small-image": 8, "function": 2, "vdb": 2, "cells": 2}
REFUSED = ("ERR|", "WARN|")


def figures(output):
    """What the script says of files and arrays."""
    return re.findall(r"^(?:leaves|function's|exposure).*$", output, re.MULTILINE)


class TestParallelSources(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for old in glob.glob(os.path.join(os.environ["VTKSVO_OUTPUT"], "*")):
            os.remove(old)
        cls.figures = figures(run([program("pvbatch"), SCRIPT, "one"], REFUSED))

    def check(self, prefix, output):
        self.assertEqual(figures(output), self.figures)
        self.assertEqual(len(self.figures), 3)
        for name, tolerance in TOLERANCES.items():
            with self.subTest(picture=name):
                one = pictures.read(file_of("one", name))
                # They show something.
                self.assertGreater(pictures.differing(one, one[:1, :1] + 0 * one), 0.01)
                difference = pictures.differing(pictures.read(file_of(prefix, name)), one, tolerance)
                print(f"{prefix}-{name}: {difference:.6f} of the pixels differ")
                self.assertLess(difference, 1e-4)

    def test_two_processes(self):
        self.check("two", run(MPIRUN + ["2", program("pvbatch"), SCRIPT, "two"], REFUSED))

    def test_three_processes(self):
        self.check("three", run(MPIRUN + ["3", program("pvbatch"), SCRIPT, "three"], REFUSED))

    def test_server_of_two_processes(self):
        client = [program("pvpython"), SCRIPT, "server2"]
        self.check("server2", run_with_server(MPIRUN + ["2", program("pvserver")], client, 21114, REFUSED))


if __name__ == "__main__":
    unittest.main(verbosity=2)
