"""PaperScenes on its stand-ins: pictures, movie frames, the table and the JSON file."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from pictures import Picture

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class TestPaperScenes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_small_run_leaves_everything(self):
        done = run("--stand-in", "--output", self.folder, "--scenes", "paper3", "--size",
                   "192x108", "--level", 6, "--frames", 1, "--movie-frames", 6)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("ERR|", done.stderr)
        self.assertIn("6 A + B", done.stdout)
        self.assertIn("vtkShadowMapPass", done.stdout)
        # What a user gets comes first, and on what.
        self.assertRegex(done.stdout, r"point light as in the paper\n +by default:")

        figures = json.loads((self.folder / "figures.json").read_text())
        self.assertEqual(figures["object_a"]["triangles"], 16978)
        self.assertEqual(figures["object_b"]["triangles_per_pose"], 2040)
        self.assertTrue(figures["processor"])
        self.assertIn(f"{figures['processor']}, octrees with {figures['instruction_set']}",
                      done.stdout)
        scene = figures["scenes"]["paper3"]
        self.assertEqual(scene["triangles_shown"], 6 * 16978 + 2040 + 2)
        self.assertEqual(scene["triangles_in_memory"], 16978 + 50 * 2040 + 2)
        self.assertEqual(len(scene["methods"]), 9)
        for name, timing in scene["methods"].items():
            self.assertEqual(timing["frames"], 3, name)
            self.assertGreater(timing["frames_per_second"], 0, name)

        frames = sorted((self.folder / "frames").iterdir())
        self.assertEqual([f.name for f in frames], [f"frame-{i:05}.png" for i in range(6)])
        self.assertEqual(Picture(frames[-1]).size, (192, 108))
        ours = Picture(self.folder / "paper3-front.png")
        theirs = Picture(self.folder / "paper3-front-vtkShadowMapPass.png")
        self.assertGreater(ours.differing_values(theirs), 0)

    def test_unreadable_file_is_one_clear_message(self):
        missing = self.folder / "dragon.off"
        done = run("--a", missing, "--b", missing, "--output", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("dragon.off", done.stderr)
        self.assertEqual(done.stderr.count("PaperScenes:"), 1)
        missing.write_text("no mesh")
        done = run("--a", missing, "--b", missing, "--output", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("PaperScenes:"), 1)

    def test_wrong_arguments_are_refused(self):
        for arguments in ((), ("--stand-in", "--scenes", "paper9"), ("--stand-in", "--size", "9"),
                          ("--stand-in", "--level", "21")):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(done.stderr.count("PaperScenes:"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
