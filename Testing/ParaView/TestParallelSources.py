"""Images, functions and OpenVDB's files on one process, on several, and on servers: the same pictures, the same file
and no message.

usage: TestParallelSources.py folder of ParaView's programs
"""

import glob
import os
import re
import subprocess
import sys
import unittest

import pictures

PROGRAMS = sys.argv.pop(1)
SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "sources_in_parallel.py")
# The largest difference that is none. Normals are means of voxels of one part, so where parts meet they are a little
# different, the more the wider voxels look: in most pictures they are a pixel.
TOLERANCES = {"image": 8, "coarse-image": 24, "small-image": 8, "function": 2, "vdb": 2, "cells": 2}
# Open MPI refuses to run as root, and more processes than cores, unless told to.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
MPIRUN = ["mpirun", "--map-by", ":OVERSUBSCRIBE", "-np"]


def program(name):
    return os.path.join(PROGRAMS, name)


def file_of(prefix, name):
    return os.path.join(os.environ["VTKSVO_OUTPUT"], f"{prefix}-{name}.png")


def run(command):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240)
    print(result.stdout)
    if result.returncode != 0 or "ERR|" in result.stdout or "WARN|" in result.stdout:
        raise AssertionError(f"{command} ended with {result.returncode}")
    return result.stdout


def figures(output):
    """What the script says of files and arrays."""
    return re.findall(r"^(?:leaves|function's|exposure).*$", output, re.MULTILINE)


class TestParallelSources(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for old in glob.glob(os.path.join(os.environ["VTKSVO_OUTPUT"], "*")):
            os.remove(old)
        cls.figures = figures(run([program("pvbatch"), SCRIPT, "one"]))

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
        self.check("two", run(MPIRUN + ["2", program("pvbatch"), SCRIPT, "two"]))

    def test_three_processes(self):
        self.check("three", run(MPIRUN + ["3", program("pvbatch"), SCRIPT, "three"]))

    def check_server(self, prefix, command, port):
        server = subprocess.Popen(command + [f"--server-port={port}"], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
        try:
            for line in server.stdout:
                if "Accepting connection" in line:
                    break
            output = run([program("pvpython"), SCRIPT, prefix, str(port)])
            said = server.communicate(timeout=60)[0]
            self.assertNotIn("ERR|", said)
            self.assertNotIn("WARN|", said)
        finally:
            server.kill()
            server.wait()
        self.check(prefix, output)

    def test_server_of_two_processes(self):
        self.check_server("server2", MPIRUN + ["2", program("pvserver")], 21114)


if __name__ == "__main__":
    unittest.main(verbosity=2)
