"""Point Gaussians, points as spheres, lines as tubes and molecules: where everything casts, they do."""

import unittest

import numpy
import paraview.simple as pv
import scene


class TestPointsAndLines(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view()
        scene.add_sun(self.view)
        self.ground = scene.show(scene.make_ground(), self.view, "Surface")
        self.view.SVOShadowsForEverything = 1

    def tearDown(self):
        pv.ResetSession()

    def show_point(self, kind):
        return scene.show(pv.PointSource(Center=list(scene.CENTER), NumberOfPoints=1, Radius=0.0,
                                         registrationName="Point"), self.view, kind)

    def pixel(self):
        """At the ball's centre, world units."""
        eye = numpy.array(self.view.CameraPosition)
        ahead = numpy.array(self.view.CameraFocalPoint) - eye
        ahead /= numpy.linalg.norm(ahead)
        half = numpy.tan(numpy.radians(self.view.CameraViewAngle) / 2)
        return 2 * half * ahead.dot(scene.CENTER - eye) / self.view.ViewSize[1]

    def check_ball(self, name):
        """The shadow on the ground is that of the ball of the scene."""
        picture = scene.picture(self.view, name)
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        self.assertGreater(dark.sum(), 1000)
        # Balls of pixels are a little larger or smaller where the eye sees them from aside.
        sure = ground & ~scene.border(ground, 6) & ~scene.border(dark, 3)
        black = picture[..., :3].max(axis=2) < 10
        self.assertEqual(((black != dark) & sure).sum(), 0)

    def test_point_gaussian(self):
        display = self.show_point("Point Gaussian")
        display.ColorArrayName = [None, ""]
        display.GaussianRadius = scene.RADIUS
        for preset in "Sphere", "Plain circle", "Black-edged circle":
            display.ShaderPreset = preset
            self.check_ball("gaussian-" + preset)
            self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), 2)
            self.assertEqual(scene.statistic(self.view, "SVOReasons"), "")
        for preset, reason in ("Gaussian Blur", "has splats that fade out"), \
                ("Triangle", "has a splat shader that draws no plain discs"), \
                ("Square Outline", "has a splat shader that draws no plain discs"):
            display.ShaderPreset = preset
            pv.Render(self.view)
            self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), 1)
            self.assertEqual(scene.statistic(self.view, "SVOReasons"),
                             f"Point: {scene.casts_nothing(reason)}\n")

    def test_points_as_spheres(self):
        display = self.show_point("Points")
        display.ColorArrayName = [None, ""]
        display.RenderPointsAsSpheres = 1
        display.PointSize = 2 * scene.RADIUS / self.pixel()
        self.check_ball("spheres")
        self.view.CameraViewAngle = 20
        display.PointSize = 2 * scene.RADIUS / self.pixel()
        self.check_ball("spheres-closer")

    def test_lines_as_tubes(self):
        ends = {"Point1": [-1.0, 0.8, 0.7], "Point2": [1.2, -0.6, 0.9], "Resolution": 40}
        line = pv.Line(**ends)
        display = scene.show(line, self.view, "Surface")
        display.ColorArrayName = [None, ""]
        display.LineWidth = 12
        pv.Render(self.view)
        self.assertIn("none of them as tubes or spheres", scene.statistic(self.view, "SVOReasons"))
        display.RenderLinesAsTubes = 1
        pv.ColorBy(display, ("POINTS", "Texture Coordinates", "X"))  # looked up between points
        tubes = scene.picture(self.view, "tubes-colored")
        self.assertEqual(scene.statistic(self.view, "SVOReasons"), "")
        self.assertGreater((tubes[..., :3].max(axis=2) < 10).sum(), 1000)
        self.assertGreater((tubes.max(axis=2) - tubes.min(axis=2) > 40).sum(), 800)  # where the ground is behind them as well
        display.ColorArrayName = [None, ""]
        tubes = scene.picture(self.view, "tubes")
        self.assertEqual(scene.statistic(self.view, "SVOReasons"), "")
        pv.Hide(line, self.view)
        # Along the line pixels are from 0.95 to 1.05 as large as in its middle.
        tube = pv.Tube(Input=pv.Line(**ends), Radius=6 * self.pixel(), NumberofSides=32)
        tube.Vectors = [None, ""]
        scene.show(tube, self.view, "Surface").ColorArrayName = [None, ""]
        mesh = scene.picture(self.view, "tube-filter")
        dark = [picture[..., :3].max(axis=2) < 10 for picture in (tubes, mesh)]
        print("tubes:", dark[1].sum(), "pixels of the mesh's shadow,", (dark[0] != dark[1]).sum(), "others")
        self.assertGreater(dark[1].sum(), 1000)
        self.assertLess((dark[0] != dark[1]).sum(), 0.2 * dark[1].sum())

    def test_molecule(self):
        source = pv.ProgrammableSource(OutputDataSetType="vtkMolecule")
        source.Script = """
molecule = self.GetMoleculeOutput() if hasattr(self, "GetMoleculeOutput") else self.GetOutputDataObject(0)
a = molecule.AppendAtom(8, -0.6, 0.0, 0.9)
b = molecule.AppendAtom(8, 0.6, 0.0, 0.9)
molecule.AppendBond(a, b, 1)
"""
        display = pv.Show(source, self.view)
        display.SetRepresentationType("Molecule")
        picture = scene.picture(self.view, "molecule")
        # Two atoms, and a bond of two halves.
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), 1 + 2 + 2)
        self.assertGreater((picture[..., :3].max(axis=2) < 10).sum(), 2000)
        self.assertEqual(scene.statistic(self.view, "SVOReasons"), "")


scene.load_plugin()
scene.run_tests()
