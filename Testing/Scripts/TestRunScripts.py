"""run_scripts.py finds a picture that differs, messages and crashes, and nothing where nothing differs."""

import os
import subprocess
import sys
import tempfile
import unittest

here = os.path.dirname(os.path.abspath(__file__))


class TestRunScripts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_scripts(self, *arguments):
        said = subprocess.run([sys.executable, f"{here}/run_scripts.py", "--output", f"{self.folder.name}/results",
                               *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        print(said.stdout)
        return said.returncode, said.stdout

    def sample(self, name):
        return f"{here}/Samples/{name}.py"

    def test_nothing_differs(self):
        code, text = self.run_scripts(self.sample("same"))
        self.assertEqual(code, 0)
        self.assertNotIn("same.py @", text)
        # Drawn, with multisampling as well.
        picture = {}
        for run in ("plain-0", "plain-4", "traced-0"):
            with open(f"{self.folder.name}/results/{run}/same.py/picture-0.ppm", "rb") as file:
                self.assertEqual(file.readline(), b"P6 100 100 255\n")
                picture[run] = file.read()
        self.assertGreater(len(set(picture["plain-0"])), 10)
        self.assertNotEqual(picture["plain-0"], picture["plain-4"])

    def test_a_picture_differs(self):
        code, text = self.run_scripts("--samples", "0", self.sample("differs"))
        self.assertEqual(code, 1)
        self.assertIn("differs.py @0: different: 2.00 % of the pixels", text)
        # Known results are not made again.
        record = f"{self.folder.name}/results/traced-0/differs.py/record.json"
        time = os.path.getmtime(record)
        self.run_scripts("--samples", "0", self.sample("differs"))
        self.assertEqual(os.path.getmtime(record), time)
        # With a reason it may.
        reasons = f"{self.folder.name}/reasons.txt"
        with open(reasons, "w") as file:
            file.write("*/differs.py@4\tof other samples\ndif*.py@0\tit is made to\n")
        code, text = self.run_scripts("--samples", "0", "--reasons", reasons, self.sample("differs"))
        self.assertEqual(code, 0)
        self.assertIn("for a reason: 2.00 % of the pixels (it is made to)", text)

    def test_messages_and_crashes(self):
        code, text = self.run_scripts("--samples", "0", self.sample("speaks"))
        self.assertEqual(code, 1)
        self.assertIn("crash (SIGABRT)", text)
        self.assertIn("not without the pass", text)

    def test_what_is_not_there(self):
        code, text = self.run_scripts(f"{here}/nothing")
        self.assertNotEqual(code, 0)
        self.assertIn("there is no", text)


if __name__ == "__main__":
    unittest.main()
