"""The view's ground of which the shadows alone are seen: below the data, whatever that is, and nowhere else."""

import unittest

import numpy
import paraview.simple as pv
import scene

# So that the ground, a little below the ball, is where scene.exact_shadow() has it.
DIAGONAL = 2.0 * scene.RADIUS * numpy.sqrt(3.0)
scene.CENTER = numpy.array([0.0, 0.0, scene.RADIUS + 1e-3 * DIAGONAL])


class TestShadowGround(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view()
        scene.add_sun(self.view)
        self.view.UseFXAA = 0
        self.ball = scene.make_ball()
        self.display = scene.show(self.ball, self.view, "Surface")
        self.view.SVOShadowsForEverything = 1

    def tearDown(self):
        pv.ResetSession()

    def check(self, name):
        """The shadow is black, and all else is as it is without a ground."""
        self.view.SVOShadowCatcher = "None"
        without = scene.picture(self.view, name + "-without")
        self.view.SVOShadowCatcher = "Below Z"
        picture = scene.picture(self.view, name)
        self.assertEqual(scene.statistic(self.view, "SVOReasons"), "")
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        self.assertGreater(dark.sum(), 1000)
        sure = ground & ~scene.border(ground, 3) & ~scene.border(dark, 3)
        self.assertEqual(picture[dark & sure].max(), 0)
        self.assertTrue((picture == without)[~dark & ~scene.border(dark, 3)].all())
        return picture

    def test_shadow(self):
        for kind in "Surface", "SVO":
            with self.subTest(kind=kind):
                self.display.Representation = kind
                self.check("ground-" + kind)

    def test_gradient(self):
        self.view.UseColorPaletteForBackground = 0
        self.view.BackgroundColorMode = "Gradient"
        self.view.Background, self.view.Background2 = [1.0, 1.0, 1.0], [0.2, 0.4, 0.8]
        self.check("gradient")

    def test_intensity(self):
        self.view.SVOShadowIntensity = 0.5
        self.view.SVOShadowCatcher = "Below Z"
        picture = scene.picture(self.view, "half")
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        inside = dark & ~scene.border(dark, 3) & ~scene.border(ground, 3)
        self.assertLess(abs(2 * picture[inside] - picture[0, 0]).max(), 3)

    def test_a_clear_background(self):
        self.view.SVOShadowCatcher = "Below Z"
        picture = scene.picture(self.view, "clear", TransparentBackground=1, ImageResolution=[1200, 800])
        ground, dark = scene.exact_shadow(self.view, (1200, 800))
        sure = ground & ~scene.border(ground, 3) & ~scene.border(dark, 3)
        self.assertTrue((picture[dark & sure] == [0, 0, 0, 255]).all())
        self.assertEqual(picture[~dark & sure, 3].max(), 0)
        self.view.SVOShadowIntensity = 0.5
        half = scene.picture(self.view, "clear-half", TransparentBackground=1, ImageResolution=[1200, 800])
        self.assertLess(abs(half[dark & sure] - [0, 0, 0, 128]).max(), 3)

    def test_translucent_surfaces(self):
        """All of their layers are seen, in front of the shadow and behind it, as without a ground."""
        self.ball.ThetaResolution = self.ball.PhiResolution = 16
        self.display.Opacity = 0.4
        inner = scene.show(pv.Sphere(Center=list(scene.CENTER), Radius=0.3), self.view, "Surface")
        inner.Opacity, inner.AmbientColor, inner.DiffuseColor = 0.5, [1, 0, 0], [1, 0, 0]
        self.view.SVOTranslucentShadows = 0
        without = scene.picture(self.view, "translucent-none")
        self.view.SVOShadowCatcher = "Below Z"
        self.assertLess(scene.differing(scene.picture(self.view, "translucent-no-shadow"), without), 1e-4)
        scene.show(pv.Sphere(Center=[0.8, 0.5, 1.5], Radius=0.3), self.view, "Surface")
        shadow = scene.picture(self.view, "translucent-shadow").astype(int)
        self.view.SVOShadowCatcher = "None"
        plain = scene.picture(self.view, "translucent-plain").astype(int)
        # The sphere's shadow lies behind the translucent ones, which hide a share of it.
        darker = (plain - shadow).max(axis=2)
        self.assertGreater((darker > 30).sum(), 1000)
        self.assertLess(((shadow - plain).max(axis=2) > 2).mean(), 1e-4)

    def test_it_follows_the_data(self):
        self.check("before")
        self.ball.Center = [0.0, 0.0, 5.0]
        self.view.CameraPosition = [5.0, -6.0, 8.2]
        self.view.CameraFocalPoint = [0.0, 0.0, 4.5]
        far = scene.picture(self.view, "lifted")
        self.ball.Center = [0.0, 0.0, 0.8]
        self.view.CameraPosition = [5.0, -6.0, 4.0]
        self.view.CameraFocalPoint = [0.0, 0.0, 0.3]
        self.assertLess(scene.differing(far, scene.picture(self.view, "lowered")), 1e-3)

    def test_it_leaves_the_camera_alone(self):
        def camera():
            pv.ResetCamera(self.view)
            return list(self.view.CameraPosition), list(self.view.CameraFocalPoint)

        without = camera()
        self.view.SVOShadowCatcher = "Below Z"
        pv.Render(self.view)
        self.assertEqual(camera(), without)

    def test_axes(self):
        """The sun is at positive x and z, and at negative y."""
        without = scene.picture(self.view, "axis-none")
        for axis, falls in ("X", True), ("Y", False), ("Z", True):
            self.view.SVOShadowCatcher = "Below " + axis
            pixels = scene.differing(scene.picture(self.view, "axis-" + axis), without)
            self.assertEqual(pixels > 3e-3, falls, axis)

    def test_selection_and_empty_views(self):
        self.view.SVOShadowCatcher = "Below Z"
        pv.Render(self.view)
        pv.SelectSurfaceCells(Rectangle=[0, 0, 599, 399], View=self.view)
        self.assertIsNotNone(self.ball.GetSelectionInput(self.ball.Port))
        pv.ClearSelection(self.ball)
        pv.Hide(self.ball, self.view)
        empty = scene.picture(self.view, "empty")
        self.assertTrue((empty == empty[0, 0]).all())
        self.view.SVOShadowsForEverything = 0  # the ground alone has use for the pass
        pv.Show(self.ball, self.view)
        pv.Render(self.view)
        self.view.SVOShadowCatcher = "None"
        pv.Render(self.view)

    def test_state(self):
        picture = self.check("state")
        path = scene.output("state.pvsm")
        pv.SaveState(path)
        pv.ResetSession()
        pv.LoadState(path)
        view = pv.GetActiveView()
        view.UseFXAA = 0  # states leave it out
        self.assertEqual(str(view.SVOShadowCatcher).strip("'"), "Below Z")
        self.assertEqual(scene.differing(picture, scene.picture(view, "state-loaded"), 0), 0)


scene.load_plugin()
scene.run_tests()
