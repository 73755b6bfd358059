"""What the benchmarks of run-performance.sh write, on short runs: whether everything is measured that
should be, whether it is what it is called, and whether a page can be filled from it. No times.

usage: TestPerformance.py folder-of-programs output-folder
"""
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, "..", "..", "..", "Documentation", "Performance.md")
PHASES = ["collect", "eye", "mark", "lights", "shade", "present"]
SITUATIONS = {"retraced", "all", "one", "camera", "nothing"}


def measure(program, name, *arguments):
    """The rows, and what was printed."""
    path = os.path.join(OUTPUT, name)
    if os.path.exists(path):
        os.remove(path)
    run = subprocess.run([os.path.join(PROGRAMS, program), *arguments, path], check=True,
                         stdout=subprocess.PIPE, text=True)
    with open(path, encoding="utf-8") as file:
        return json.load(file), run.stdout


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows, _ = measure("BenchmarkFrames", "frames.json", "--short", "--output")

    def some(self, experiment, **wanted):
        rows = [r for r in self.rows if r["experiment"] == experiment
                and all(r.get(key) == value for key, value in wanted.items())]
        self.assertTrue(rows, f"{experiment} {wanted} is not measured")
        return rows

    def test_everything_is_measured(self):
        methods = {"svo, point light", "svo", "vtkShadowMapPass", "vtk, no shadows",
                   "vtk, empty frame"}
        for situation in SITUATIONS:
            self.assertEqual({r["method"] for r in self.some("scenes", scene="paper2",
                                                             situation=situation)}, methods)
        self.assertEqual({r["situation"] for r in self.some("scenes", scene="paper1a")},
                         SITUATIONS - {"one"})
        peers = {"svo", "vtkShadowMapPass", "vtk, no shadows"}
        for experiment in ("triangles", "objects", "sizes", "lights", "lightKit"):
            self.assertLessEqual(peers, {r["method"] for r in self.some(experiment)})
        for experiment, key, values in (
                ("triangles", "triangles", 2), ("objects", "objects", 2), ("levels", "level", 2),
                ("sizes", "width", 2), ("lights", "lights", 2), ("refined", "triangles", 2),
                ("threads", "threads", 1)):
            self.assertEqual(len({r[key] for r in self.some(experiment)}), values, experiment)
        self.assertEqual({r["method"] for r in self.some("levels")},
                         {"voxel", "plane", "triangle", "automatic"})
        self.assertEqual({r["method"] for r in self.some("shadows")},
                         {"none", "512", "1024", "2048", "4096", "rays"})
        self.assertIn("scalar", {r["instructionSet"] for r in self.some("instructionSets")})

    def test_more_cores_are_no_slower_and_at_most_as_many_times_as_fast(self):
        rows = self.some("cores")
        self.assertEqual({r["situation"] for r in rows}, {"retraced", "one", "camera"})
        for r in rows:
            for phase in ("eye", "mark", "lights", "shade", "tracer"):
                alone = r[f"{phase}Cores1Ms"]
                slower = alone
                for cores in (2, 16, 64):
                    time = r[f"{phase}Cores{cores}Ms"]
                    self.assertLessEqual(time, slower)
                    self.assertGreaterEqual(time, alone / cores)
                    slower = time
                self.assertLessEqual(r[f"{phase}SerialMs"], slower)

    def test_figures_belong_together(self):
        for r in self.rows:
            self.assertGreater(r["wallLeastMs"], 0.0)
            self.assertLessEqual(r["wallLeastMs"], r["wallMs"])
            self.assertGreater(r["frames"], 0)
            self.assertLessEqual(r["processorLowMs"], r["processorMs"])
            self.assertLessEqual(r["processorMs"], r["processorHighMs"])
            if "instances" not in r:
                self.assertNotIn("eyeMs", r)  # VTK's own
                continue
            if "OpenGL" in r["method"]:
                self.assertNotIn("eyeMs", r)  # its pass is as it is, without a stopwatch
                continue
            phases = [r[phase + "Ms"] for phase in PHASES]
            self.assertGreaterEqual(min(phases), 0.0)
            lightless = (r["method"] == "none" or "rays" in r["method"]
                         or r.get("lightsWithRays", 0) > 0)  # no maps are traced
            if r["situation"] == "retraced" and not lightless:
                self.assertGreater(min(phases), 0.0, r)
            # Medians of parts need not add up to that of the whole; but a phase that is counted
            # twice, or not at all, shows.
            self.assertLess(sum(phases), 2.0 * r["processorHighMs"], r)
            self.assertGreater(sum(phases), 0.3 * r["processorLowMs"], r)
            # The least of parts cannot be more than the least of the whole.
            least = [r[phase + "WallLeastMs"] for phase in PHASES]
            self.assertLess(sum(least), 1.01 * r["wallLeastMs"], r)

    def test_situations_are_what_they_are_called(self):
        for r in self.some("scenes", method="svo, point light"):
            objects = {"paper1a": 1, "paper2": 3}[r["scene"]]
            self.assertEqual(r["instances"], objects + 1)  # and the ground
            if r["situation"] in ("retraced", "all"):
                self.assertGreater(r["shadowRays"], 0)
            elif r["situation"] == "nothing":
                self.assertEqual(r["shadowRays"], 0)
        for scene in ("paper1a", "paper2"):
            layers = {r["situation"]: r["retracedLayers"]
                      for r in self.some("scenes", scene=scene, method="svo, point light")}
            self.assertEqual(layers["nothing"], 0)
            self.assertGreater(layers["camera"], 0)
            self.assertLess(0, layers["all"])
            self.assertLess(layers["all"], layers["retraced"])  # there the ground is, too
            self.assertLess(0, layers.get("one", 1))
            self.assertLess(layers.get("one", 0), layers["all"])
        shadows = {r["method"]: r["shadowRays"] for r in self.some("shadows")}
        self.assertEqual(shadows["none"], 0)
        self.assertGreater(shadows["4096"], shadows["512"])
        self.assertGreater(shadows["rays"], 0)

    def test_settings_arrive(self):
        for method in ("voxel", "automatic"):
            sizes = [r["octreeMiB"] for r in sorted(self.some("levels", method=method),
                                                    key=lambda r: r["level"])]
            self.assertEqual(sizes, sorted(set(sizes)))
        rays = [r["shadowRays"] for r in sorted(self.some("lights", method="svo"),
                                                key=lambda r: r["lights"])]
        self.assertEqual(rays, sorted(set(rays)))
        for r in self.some("objects", method="svo"):
            self.assertEqual(r["instances"], r["objects"] + 1)


class Rays(unittest.TestCase):
    def test_rows(self):
        rows, printed = measure("BenchmarkTrace", "rays.json", "--levels", "6", "--size", "96x64",
                                "--repeat", "1", "--instances", "4", "--isa", "AVX2", "--json")
        self.assertTrue(printed.startswith("AVX2, 8 lanes"), printed)  # what the kernels say
        self.assertEqual({r["camera"] for r in rows}, {"far", "near", "4 instances"})
        self.assertEqual({r["instructionSet"] for r in rows}, {"AVX2"})
        kernels = {r["kernel"] for r in rows}
        self.assertLessEqual({"triangle, whole tiles", "voxel, blocks in tile intervals",
                              "a frame's rays of the eye"}, kernels)
        for r in rows:
            self.assertGreater(r["raysPerSecond"], 1e4)


class Build(unittest.TestCase):
    def test_rows(self):
        rows, _ = measure("BenchmarkBuild", "build.json", "--levels", "6,8", "--repeat", "1", "--json")
        ours = [r for r in rows if r["method"] == "octree"]
        self.assertEqual({r["level"] for r in ours}, {6, 8})
        self.assertEqual(len({r["mesh"] for r in ours}), 2)
        for r in rows:
            self.assertGreaterEqual(r["processorMs"], 0.0)


class WrittenPage(unittest.TestCase):
    """After the others: of their rows."""

    def test_tables_and_plots(self):
        page = os.path.join(OUTPUT, "Performance.md")
        shutil.copy(PAGE, page)
        rows = os.path.join(OUTPUT, "all", "performance.json")
        os.makedirs(os.path.dirname(rows), exist_ok=True)
        scripts = [["collect.py", OUTPUT, rows, "frames=3"], ["tables.py", rows, page]]
        if importlib.util.find_spec("matplotlib"):
            scripts.append(["plots.py", rows, OUTPUT])
        for script, *arguments in scripts:
            subprocess.run([sys.executable, os.path.join(HERE, script), *arguments], check=True,
                           env={**os.environ, "PYTHONPATH": os.path.dirname(HERE)})
        with open(page, encoding="utf-8") as file:
            found = re.findall("<!-- begin (.*?) -->\n(.*?)<!-- end", file.read(), re.DOTALL)
        sections = dict(found)
        for name in ("scenes", "triangles", "objects", "refined", "sizes", "lights", "light-kit",
                     "shadows", "levels", "threads", "cores", "builders", "overtakes"):
            self.assertGreater(sections[name].count("\n"), 2, name)
            self.assertNotIn("not measured", sections[name])
        # Of what no short run measures the page says so.
        self.assertIn("not measured", sections["paraview"])
        bars = [line.split("|")[4:6] for line in sections["bars"].splitlines()[2:]]
        for measured, verdict in bars:
            self.assertEqual("not measured" in measured, not verdict.strip())
        self.assertTrue(any("met" in verdict or "missed" in verdict for _, verdict in bars))
        # Another machine's figures stand beside these, and change nothing else.
        other = os.path.join(OUTPUT, "all", "other.json")
        with open(rows, encoding="utf-8") as file:
            changed = json.load(file)
        changed[0]["processor"] = "another"
        for row in changed:
            if row.get("processorMs"):
                row["processorMs"] *= 2
        with open(other, "w", encoding="utf-8") as file:
            json.dump(changed, file)
        subprocess.run([sys.executable, os.path.join(HERE, "tables.py"), other, page], check=True,
                       env={**os.environ, "PYTHONPATH": os.path.dirname(HERE)})
        os.remove(other)
        with open(page, encoding="utf-8") as file:
            both = dict(re.findall("<!-- begin (.*?) -->\n(.*?)<!-- end", file.read(), re.DOTALL))
        self.assertIn("another", both["machines"])
        self.assertTrue(both["machines"].startswith(sections.pop("machines")))
        for name, content in sections.items():
            self.assertEqual(both[name], content)


class Arithmetic(unittest.TestCase):
    def test_crossing(self):
        sys.path.insert(0, HERE)
        from measured import crossing
        self.assertAlmostEqual(crossing([(10, 0.5), (1000, 2.0)]), 100.0)
        self.assertAlmostEqual(crossing([(1, 2.0), (10, 0.5), (1000, 2.0)]), 100.0)  # the last one
        self.assertEqual(crossing([(10, 1.5), (100, 2.0)]), 10)
        self.assertIsNone(crossing([(10, 1.5), (100, 0.9)]))


if __name__ == "__main__":
    PROGRAMS, OUTPUT = sys.argv[1:3]
    os.makedirs(OUTPUT, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
