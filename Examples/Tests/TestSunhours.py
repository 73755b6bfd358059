"""sunhours.py: the numbers of a city that can be told without it, and its picture."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import vtk

from pictures import Picture

SCRIPT = pathlib.Path(__file__).parents[1] / "sunhours.py"


class TestSunhours(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_it(self, *arguments):
        done = subprocess.run([sys.executable, SCRIPT, "--output", self.folder / "out",
                               "--cell", "6", *map(str, arguments)],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "out.vtp"))
        reader.Update()
        mesh = reader.GetOutput()
        self.assertEqual(Picture(self.folder / "out.png").size, (1280, 720))
        return mesh, mesh.GetCellData().GetArray("Exposure")

    def highest_roof(self, mesh):
        """A cell that nothing stands above."""
        top = mesh.GetBounds()[5]
        return next(i for i in range(mesh.GetNumberOfCells())
                    if mesh.GetCell(i).GetBounds()[4] == top)

    def test_hours_of_a_day_in_summer_and_in_winter(self):
        for date, day in ((2024, 6, 21), 16.0), ((2024, 12, 21), 8.3):
            mesh, hours = self.run_it("--date", *date)
            self.assertAlmostEqual(hours.GetValue(self.highest_roof(mesh)), day, delta=0.3)
            self.assertLess(hours.GetRange()[0], 1.0)

    def test_sky(self):
        mesh, sky = self.run_it("--sky")
        self.assertAlmostEqual(sky.GetValue(self.highest_roof(mesh)), 1.0, delta=1e-9)
        self.assertEqual(sky.GetRange()[0], 0.0, "the ground below a house sees none")
        walls = [sky.GetValue(i) for i in range(mesh.GetNumberOfCells())
                 if mesh.GetCell(i).GetBounds()[4] < mesh.GetCell(i).GetBounds()[5]]
        self.assertAlmostEqual(max(walls), 0.5, delta=0.01)


if __name__ == "__main__":
    unittest.main()
