"""Shadows of everything that a view shows, whatever it is shown as: the surfaces keep the look that ParaView gives
them, and cast and receive."""

import unittest

import numpy
import paraview.simple as pv
import scene


class TestEverything(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view()
        scene.add_sun(self.view)

    def tearDown(self):
        pv.ResetSession()

    def show_ball_on_ground(self, ball="Surface", ground="Surface"):
        self.ball, self.ground = scene.make_ball(), scene.make_ground()
        return scene.show(self.ball, self.view, ball), scene.show(self.ground, self.view, ground)

    def everything(self, name, on=1):
        self.view.SVOShadowsForEverything = on
        return scene.picture(self.view, name)

    def check_shadow(self, picture):
        """The ball's, on the ground."""
        height, width = picture.shape[:2]
        ground, dark = scene.exact_shadow(self.view, (width, height))
        self.assertGreater(dark.sum(), 1000)
        sure = ground & ~scene.border(ground, 3) & ~scene.border(dark, 3)
        black = picture[..., :3].max(axis=2) < 10
        self.assertEqual(((black != dark) & sure).sum(), 0)

    def test_ordinary_surfaces(self):
        self.show_ball_on_ground()
        without = scene.picture(self.view, "ordinary-without")
        shadowed = self.everything("ordinary")
        self.check_shadow(shadowed)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 0)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), 2)
        # Nothing but shadows has changed, and nothing has got lighter.
        changed = abs(shadowed - without).max(axis=2) > 0
        self.assertLess((shadowed - without).max(), 1)
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        self.assertEqual((changed & ground & ~dark & ~scene.border(dark, 3)).sum(), 0)
        self.assertEqual(scene.differing(self.everything("ordinary-again", 0), without, 0), 0)

    def test_beside_traced_surfaces(self):
        for kinds in ("SVO", "Surface"), ("Surface", "SVO"), ("SVO", "SVO"):
            with self.subTest(kinds=kinds):
                pv.HideAll(self.view)
                self.show_ball_on_ground(*kinds)
                self.check_shadow(self.everything("-".join(kinds)))
                self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), kinds.count("SVO"))


scene.load_plugin()
scene.run_tests()
