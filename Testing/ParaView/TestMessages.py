"""Each message opens a window in ParaView: none comes of an opacity that is lowered, and those that come ask
for what ParaView's panels offer."""

import unittest

import paraview.simple as pv
import scene
from messages import Output


class TestMessages(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((300, 200))
        self.sun = scene.add_sun(self.view)
        scene.show(scene.make_ground(), self.view)

    def tearDown(self):
        pv.ResetSession()

    def said(self, change):
        """By two pictures after a change."""
        with Output() as output:
            change()
            pv.Render(self.view)
            pv.Render(self.view)
        return output.messages()

    def test_opacity(self):
        ball = scene.show(scene.make_ball(), self.view)
        pv.Render(self.view)
        for opacity in (0.5, 0.3, 0.0, 1.0):
            self.assertEqual(self.said(lambda: setattr(ball, "Opacity", opacity)), [])

    def test_opacity_of_a_block(self):
        groups = pv.GroupDatasets(Input=[scene.make_ball(), scene.make_ground()],
                                  OutputType="vtkMultiBlockDataSet",
                                  BlockNames=["Sphere1", "Plane1"])
        display = scene.show(groups, self.view)
        self.assertEqual(self.said(
            lambda: setattr(display, "BlockOpacities", ["/Root/Sphere1", "0.4"])), [])

    def test_translucent_cells(self):
        """That some cells cast and others do not is said, once, where these do not cast as light as they are."""
        self.view.SVOTranslucentShadows = 0
        elevation = pv.Elevation(Input=scene.make_ball(), LowPoint=[0, 0, 0.3], HighPoint=[0, 0, 1.3],
                                 ScalarRange=[0.3, 1.3])
        ball = scene.show(elevation, self.view)
        pv.ColorBy(ball, ("POINTS", "Elevation"))
        table = pv.GetColorTransferFunction("Elevation")
        opacity = pv.GetOpacityTransferFunction("Elevation")
        for function in (table, opacity):
            function.RescaleTransferFunction(0.3, 1.3)
        opacity.Points = [0.3, 0.0, 0.5, 0.0, 1.3, 1.0, 0.5, 0.0]
        messages = self.said(lambda: setattr(table, "EnableOpacityMapping", 1))
        self.assertEqual(len(messages), 1, messages)
        self.assertIn("Cast Shadows", messages[0])
        self.assertNotIn("SetCastShadow", messages[0])

    def test_headlights(self):
        scene.show(scene.make_ball(), self.view)
        self.expect_headlights()

    def test_headlights_with_opengl(self):
        """It has no instances without a light that casts."""
        self.view.SVOBackend = "OpenGL"
        scene.show(scene.make_ball(), self.view)
        self.expect_headlights()

    def test_no_svo_with_opengl(self):
        self.view.SVOBackend = "OpenGL"
        pv.HideAll(self.view)
        scene.show(scene.make_ball(), self.view, "Surface")
        self.assertEqual(self.said(lambda: setattr(self.sun, "Coords", "Ambient")), [])

    def expect_headlights(self):
        for coords, count in (("Ambient", 1), ("Headlight", 0)):  # once
            messages = self.said(lambda: setattr(self.sun, "Coords", coords))
            self.assertEqual(len(messages), count, messages)
            self.assertTrue(all("Add Light" in message for message in messages), messages)
            self.assertEqual(scene.statistic(self.view, "SVOCastingLights"),
                             "Light 0, headlight or ambient light: casts none\n")

    def test_a_view_that_was_there_before(self):
        """Once, when the plugin is loaded."""
        self.assertEqual(len(EARLY.messages()), 1, EARLY.text)
        self.assertIn("Reset Session", EARLY.text)


with Output() as EARLY:
    view = pv.CreateView("RenderView")
    other = pv.CreateView("RenderView")
    scene.load_plugin()
pv.ResetSession()
scene.run_tests()
