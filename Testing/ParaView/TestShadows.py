"""The plugin in an ordinary Render View: traced surfaces look as Surface does, and their shadows lie
where arithmetic says, on each other and on ordinary surfaces."""

import unittest

import numpy
import paraview.simple as pv
import scene


class TestShadows(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view()
        scene.add_sun(self.view)
        self.ball = scene.make_ball()
        self.ground = scene.make_ground()

    def tearDown(self):
        pv.ResetSession()

    def show(self, ball, ground):
        return (scene.show(self.ball, self.view, ball), scene.show(self.ground, self.view, ground))

    def check_shadow(self, picture):
        height, width = picture.shape[:2]
        ground, dark = scene.exact_shadow(self.view, (width, height))
        self.assertGreater(dark.sum(), 1000)
        # With a pixel error of 1 outlines may be off by a pixel.
        sure = ground & ~scene.border(ground, 2) & ~scene.border(dark, 2)
        black = picture[..., :3].max(axis=2) < 10
        wrong = (black != dark) & sure
        self.assertEqual(wrong.sum(), 0)

    def test_without_shadows_the_look_is_that_of_surface(self):
        self.view.SVOShadowTechnique = "None"
        self.view.SVOPixelError = 0
        self.show("Surface", "Surface")
        surface = scene.picture(self.view, "surface")
        self.show("SVO", "SVO")
        traced = scene.picture(self.view, "no-shadows")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), scene.traced(2))
        self.assertLess(scene.differing(surface, traced, tolerance=2), 1e-4)

    def test_shadow_on_a_traced_surface(self):
        self.view.SVOPixelError = 0
        self.show("SVO", "SVO")
        picture = scene.picture(self.view, "traced-ground")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), scene.traced(2))
        self.assertEqual(scene.statistic(self.view, "SVOActiveBackend"), 2 if scene.OPENGL else 1)
        self.check_shadow(picture)
        self.assertLess(scene.baseline_difference(picture, "ShadowedSphere"), 1e-3)

    def test_shadow_on_an_ordinary_surface(self):
        self.show("SVO", "Surface")
        picture = scene.picture(self.view, "ordinary-ground")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), scene.traced(1))
        self.check_shadow(picture)

    @unittest.skipIf(scene.OPENGL, "only of the CPU's maps parts are traced")
    def test_what_the_view_adds_receives_nothing(self):
        """The selections of representations, and the axes of the view: for them the maps of lights would be traced
        whole, where only what traced surfaces look up is."""
        self.view.AdditionalLights = []
        self.view.UseLight = 1  # moves with the camera, so that nothing is kept
        self.view.CenterAxesVisibility = 0

        def shadow_rays():
            for x in (6.0, 5.0):
                self.view.CameraPosition = [x, -6.0, 4.0]
                pv.Render(self.view)
            return scene.statistic(self.view, "SVONumberOfShadowRays")

        self.show("SVO", "SVO")
        alone = shadow_rays()
        self.view.CenterAxesVisibility = 1
        self.assertEqual(shadow_rays(), alone)
        scene.show(pv.Sphere(Center=list(scene.CENTER), Radius=0.1), self.view, "Surface")
        self.assertGreater(shadow_rays(), alone)

    def shares(self, picture, without):
        """What is left of the light inside of the exact shadow, and beside it, on the ground."""
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        inside, beside = dark & ~scene.border(dark, 3), ground & ~dark & ~scene.border(dark, 3)
        share = picture[..., 0] / numpy.maximum(without[..., 0], 1.0)
        return share[inside & ground], share[beside & ~scene.border(ground, 3)]

    def test_translucent_surfaces_cast_lighter_shadows(self):
        for kind in "SVO", "Surface":  # of the ground
            with self.subTest(ground=kind):
                ball, ground = self.show("SVO", kind)
                self.view.SVOShadowTechnique = "None"
                without = scene.picture(self.view, f"translucent-{kind}-none").astype(float)
                self.view.SVOShadowTechnique = "Shadow Buffer"
                for opacity in (0.2, 0.4, 0.99, 1.0):
                    ball.Opacity = opacity
                    picture = scene.picture(self.view, f"translucent-{kind}-{opacity}").astype(float)
                    inside, beside = self.shares(picture, without)
                    self.assertGreater(len(inside), 500)
                    self.assertLess(abs(inside - (1.0 - opacity)).max(), 0.015)
                    self.assertEqual(abs(beside - 1.0).max(), 0.0)
                    self.assertNotIn("Casts", scene.statistic(self.view, "SVOReasons").replace(
                        "Casts no shadow: it is not shown as SVO", ""))
                ball.Opacity = 0.4
                self.view.SVOTranslucentShadows = 0
                inside, _ = self.shares(scene.picture(self.view, f"translucent-{kind}-off").astype(float), without)
                self.assertEqual(abs(inside - 1.0).max(), 0.0)
                self.view.SVOTranslucentShadows = 1
                ball.Opacity = 1.0

    def test_opacity_mapping(self):
        """The ball is invisible on the one side, opaque on the other, and so is its shadow."""
        ball, ground = self.show("SVO", "SVO")
        pv.Hide(self.ball, self.view)
        colored = pv.Elevation(Input=self.ball, LowPoint=[-0.5, 0, 0.8], HighPoint=[0.5, 0, 0.8])
        ball = scene.show(colored, self.view)
        pv.ColorBy(ball, ("POINTS", "Elevation"))
        table, opacity = pv.GetColorTransferFunction("Elevation"), pv.GetOpacityTransferFunction("Elevation")
        for function in table, opacity:
            function.RescaleTransferFunction(0.0, 1.0)
        opacity.Points = [0.0, 0.0, 0.5, 0.0, 1.0, 1.0, 0.5, 0.0]
        self.view.SVOShadowTechnique = "None"
        without = scene.picture(self.view, "mapped-none").astype(float)
        # Where the light meets the ball first.
        _, points, _ = scene.ground_points(self.view, self.view.ViewSize)
        way = points - scene.CENTER
        along = -(way * scene.TO_LIGHT).sum(axis=-1)
        reach = numpy.sqrt(numpy.maximum(scene.RADIUS ** 2 - ((way ** 2).sum(axis=-1) - along ** 2), 0.0))
        left = 0.5 - (points + (along + reach)[..., None] * scene.TO_LIGHT)[..., 0]
        for technique in "Shadow Buffer", "Shadow Rays":
            table.EnableOpacityMapping = 1
            self.view.SVOShadowTechnique = technique
            inside, beside = self.shares(scene.picture(self.view, "mapped").astype(float), without)
            self.assertEqual(abs(beside - 1.0).max(), 0.0)
            expected, _ = self.shares(255.0 * left[..., None], numpy.full_like(without, 255.0))
            self.assertLess(expected.min(), 0.1)
            self.assertGreater(expected.max(), 0.6)
            self.assertLess(abs(inside - expected).max(), 0.05)
            self.assertLess(abs(inside - expected).mean(), 0.01)
            self.assertEqual(scene.statistic(self.view, "SVOReasons"),
                             "Elevation1: Left to the rasteriser: it is translucent. "
                             "Casts less than its whole shadow: it is invisible in parts.\n")
            table.EnableOpacityMapping = 0
            inside, _ = self.shares(scene.picture(self.view, "mapped-off").astype(float), without)
            self.assertLess(inside.max(), 0.05)

    def test_ordinary_surfaces_cast_nothing(self):
        self.show("Surface", "SVO")
        ordinary = scene.picture(self.view, "ordinary-ball")
        ground, _ = scene.exact_shadow(self.view, self.view.ViewSize)
        self.assertGreater(ordinary[ground & ~scene.border(ground, 2)].min(), 100)

    def test_exact_rays_agree_with_the_buffer(self):
        self.show("SVO", "SVO")
        self.view.SVOShadowTechnique = "Shadow Buffer"
        buffer = scene.picture(self.view, "buffer")
        self.view.SVOShadowTechnique = "Shadow Rays"
        rays = scene.picture(self.view, "rays")
        self.check_shadow(rays)
        self.assertLess(scene.differing(buffer, rays), 2e-3)
        self.view.SVOBackend = "OpenGL"
        drawn = scene.picture(self.view, "rays-opengl")
        self.check_shadow(drawn)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 0)
        self.assertEqual(scene.statistic(self.view, "SVOActiveBackend"), 2)
        self.assertLess(scene.differing(rays, drawn), 2e-3)
        self.view.SVOShadowTechnique = "Shadow Volumes"
        volumes = scene.picture(self.view, "volumes-opengl")
        self.check_shadow(volumes)
        self.assertLess(scene.differing(drawn, volumes), 2e-4)

    def test_kinds_of_lights(self):
        """Each from where the sun is."""
        self.show("SVO", "SVO")
        sun = self.view.AdditionalLights[0]

        def check(name, says):
            self.check_shadow(scene.picture(self.view, "light-" + name))
            self.assertEqual(scene.statistic(self.view, "SVOCastingLights"), says)

        check("directional", "Light 0, directional: casts shadows\n")
        sun.Type = "Positional"
        sun.Position = list(500.0 * scene.TO_LIGHT)  # its rays are parallel to half a pixel
        sun.ConeAngle = 180.0
        check("point", "Light 0, point: casts shadows\n")
        sun.ConeAngle = 20.0
        check("spot", "Light 0, spot: casts shadows\n")
        ahead = numpy.array(self.view.CameraFocalPoint) - self.view.CameraPosition
        ahead /= numpy.linalg.norm(ahead)
        right = numpy.cross(ahead, self.view.CameraViewUp)
        right /= numpy.linalg.norm(right)
        axes = numpy.stack([right, numpy.cross(right, ahead), -ahead])
        sun.Type = "Directional"
        sun.Coords = "Camera"
        sun.Position = list(axes @ scene.TO_LIGHT)
        check("camera", "Light 0, directional: casts shadows\n")
        sun.Enable = 0
        unlit = scene.picture(self.view, "light-off")
        self.assertEqual(scene.statistic(self.view, "SVOCastingLights"), "")
        other = scene.add_sun(self.view)  # lights have the names that the Light Inspector gives them
        check("second", "Light 1, directional: casts shadows\n")
        pv.RemoveLight(other)
        self.show("Surface", "Surface")
        self.assertLess(scene.differing(unlit, scene.picture(self.view, "light-off-surface")), 1e-3)

    def test_lights_with_a_size(self):
        """A light's own property; umbras stay, and beside them there is what was neither."""
        self.show("SVO", "SVO")
        hard = scene.picture(self.view, "size-0")
        self.view.AdditionalLights[0].SVOSize = 12.0
        soft = scene.picture(self.view, "size-12")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfLightSamples"), 32)
        lighter = (hard[..., 0] < 5) & (soft[..., 0] > 20)
        darker = (hard[..., 0] > 150) & (soft[..., 0] < hard[..., 0].astype(int) - 20)
        for edge in (lighter, darker):
            self.assertGreater(edge.sum(), 300)
            self.assertLess(edge.sum(), 5000)
        self.view.AdditionalLights[0].SVOSize = 0.0
        self.assertEqual(scene.differing(hard, scene.picture(self.view, "size-0-again")), 0.0)

    def test_ambient_occlusion_and_a_sky_need_no_light(self):
        pv.RemoveLight(self.view.AdditionalLights[0])
        self.show("SVO", "SVO")
        plain = scene.picture(self.view, "no-light")
        self.view.SVOAmbientOcclusion = 1
        closed = scene.picture(self.view, "occlusion")
        darker = plain[..., 0].astype(int) - closed[..., 0]
        self.assertGreater(darker.max(), 60)  # below the ball
        self.view.SVOAmbientOcclusion = 0
        self.view.SVOSkyLight = 1
        self.view.SVOSkyColor = [0.0, 0.0, 1.0]
        self.view.SVOGroundColor = [0.0, 0.0, 0.0]
        sky = scene.picture(self.view, "sky")
        other = sky[(sky != plain).any(axis=2)]  # surfaces, without lights as bright as they can be
        self.assertGreater(len(other), 10000)
        self.assertEqual(numpy.median(other[:, :2]), 0)  # but for their outlines
        self.assertGreater(other[:, 2].max(), 150)

    def test_large_picture_with_a_clear_background(self):
        self.show("SVO", "SVO")
        picture = scene.picture(self.view, "large", TransparentBackground=1,
                                ImageResolution=[2400, 1600])  # four times the window
        self.check_shadow(picture)
        ground, dark = scene.exact_shadow(self.view, (2400, 1600))
        self.assertEqual(picture[dark & ~scene.border(dark, 2), 3].min(), 255)
        self.assertEqual(picture[-1, 0, 3], 0)

    def test_stereo(self):
        self.show("SVO", "SVO")
        one_eye = scene.picture(self.view, "one-eye")
        self.view.StereoRender = 1
        self.view.StereoType = "Anaglyph"
        pv.Render(self.view)
        buffer = scene.picture(self.view, "stereo-buffer")
        self.view.SVOShadowTechnique = "Shadow Rays"
        rays = scene.picture(self.view, "stereo-rays")
        self.assertLess(scene.differing(buffer, rays), 2e-3)
        self.assertGreater(scene.differing(buffer, one_eye), 1e-2)
        self.view.SVOShadowTechnique = "None"
        self.assertGreater(scene.differing(buffer, scene.picture(self.view, "stereo-none")), 1e-2)

    def test_cast_and_receive(self):
        ball, ground = self.show("SVO", "SVO")
        shown, _ = scene.exact_shadow(self.view, self.view.ViewSize)
        shown &= ~scene.border(shown, 2)
        ball.SVOCastShadows = 0
        self.assertGreater(scene.picture(self.view, "no-caster")[shown].min(), 100)
        ball.SVOCastShadows = 1
        ground.SVOReceiveShadows = 0
        self.assertGreater(scene.picture(self.view, "no-receiver")[shown].min(), 100)
        ground.SVOReceiveShadows = 1
        self.check_shadow(scene.picture(self.view, "both-again"))

    def test_intensity_halves_the_shadow(self):
        self.show("SVO", "SVO")
        self.view.SVOShadowIntensity = 0.5
        picture = scene.picture(self.view, "half")
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        inside = dark & ~scene.border(dark) & ~scene.border(ground)
        lit = ground & ~dark & ~scene.border(dark) & ~scene.border(ground)
        self.assertAlmostEqual(picture[inside].mean() / picture[lit].mean(), 0.5, delta=0.01)


scene.load_plugin()
scene.run_tests()
