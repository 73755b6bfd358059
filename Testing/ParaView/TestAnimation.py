"""Animated surfaces: one octree for each time step, each built once; a moving surface builds none."""

import unittest

import paraview.simple as pv
import scene
import series

STEPS = 6


class TestAnimation(unittest.TestCase):
    def setUp(self):
        self.path = series.write(scene.output("ball"), series.breathing_ball(STEPS))
        self.view = scene.make_view((300, 200))
        scene.add_sun(self.view)
        scene.show(scene.make_ground(), self.view)
        self.reader = pv.PVDReader(FileName=self.path)
        self.scene = pv.GetAnimationScene()
        self.scene.UpdateAnimationUsingDataTimeSteps()

    def tearDown(self):
        pv.GetSettingsProxy("GeneralSettings").CacheGeometryForAnimation = 0
        pv.ResetSession()

    def loop(self, proxy, name):
        """Plays all time steps; how many octrees were built meanwhile."""
        before = scene.statistic(proxy, name)
        self.scene.GoToFirst()
        self.scene.Play()
        return scene.statistic(proxy, name) - before

    def test_representation_builds_each_step_once(self):
        ball = scene.show(self.reader, self.view)
        pv.Render(self.view)
        first = self.loop(ball, "SVONumberOfBuilds")
        self.assertEqual(scene.statistic(ball, "SVONumberOfBuilds"), STEPS)
        self.assertGreaterEqual(first, STEPS - 1)  # one may have been built by the first picture
        self.assertEqual(self.loop(ball, "SVONumberOfBuilds"), 0)

    def test_walking_figure(self):
        """All key frames of a real figure. Two of its poses are the same."""
        reader = pv.PVDReader(FileName=series.write(scene.output("figure"), series.md2(series.SYDNEY)))
        pv.Delete(self.reader)
        self.scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(len(reader.TimestepValues), 198)
        figure = scene.show(reader, self.view)
        figure.Scale = [1.5, 1.5, 1.5]
        figure.SVOMaximumLevel = 8
        self.view.CameraPosition = [3.2, -3.9, 2.7]
        self.view.CameraFocalPoint = [0.0, 0.0, 0.5]
        first = scene.picture(self.view, "figure-first")
        self.loop(figure, "SVONumberOfBuilds")
        self.assertEqual(scene.statistic(figure, "SVONumberOfBuilds"), 197)
        self.assertEqual(self.loop(figure, "SVONumberOfBuilds"), 0)
        kept = scene.statistic(figure, "SVOCacheMemorySize")
        self.assertLess(kept, figure.SVOCacheMemoryLimit)
        self.scene.AnimationTime = 99
        between = scene.picture(self.view, "figure-between")
        self.assertLess(scene.baseline_difference(between, "WalkingFigure"), 1e-3)
        self.assertGreater(scene.differing(first, between), 0.003)
        self.scene.AnimationTime = 0
        self.assertEqual(scene.differing(scene.picture(self.view, "figure-again"), first, 0), 0)
        # With room for half of them a loop builds the other half, and few more.
        figure.SVOCacheMemoryLimit = kept // 2
        self.loop(figure, "SVONumberOfBuilds")
        again = self.loop(figure, "SVONumberOfBuilds")
        self.assertGreater(again, 50)
        self.assertLess(again, 120)
        self.assertLessEqual(scene.statistic(figure, "SVOCacheMemorySize"), kept // 2)

    def test_limit_of_the_cache(self):
        ball = scene.show(self.reader, self.view)
        ball.SVOCacheMemoryLimit = 0
        pv.Render(self.view)
        self.loop(ball, "SVONumberOfBuilds")
        self.assertGreaterEqual(self.loop(ball, "SVONumberOfBuilds"), STEPS - 1)
        self.assertEqual(scene.statistic(ball, "SVOCacheMemorySize"), 0)

    def test_filter_builds_each_step_once(self):
        octrees = pv.PolyDataToSVO(Input=self.reader, MaximumLevel=8)
        ball = scene.show(octrees, self.view)
        pv.Render(self.view)
        self.assertEqual(list(octrees.TimestepValues), [float(i) for i in range(STEPS)])
        self.loop(octrees, "NumberOfBuilds")
        self.assertEqual(scene.statistic(octrees, "NumberOfBuilds"), STEPS)
        self.assertEqual(self.loop(octrees, "NumberOfBuilds"), 0)
        fields = octrees.FieldData
        self.assertEqual(fields["SVO Level"].GetRange(), (8.0, 8.0))
        self.assertEqual(fields["SVO Voxels"].GetRange()[0],
                         scene.statistic(octrees, "NumberOfVoxels"))
        self.assertGreater(fields["SVO Memory"].GetRange()[0], 1)
        # The representation takes what comes, whatever its own level.
        self.assertEqual(scene.statistic(ball, "SVONumberOfBuilds"), 0)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)

    def test_geometry_cache_shares_the_octrees(self):
        pv.GetSettingsProxy("GeneralSettings").CacheGeometryForAnimation = 1
        ball = scene.show(self.reader, self.view)
        pv.Render(self.view)
        self.loop(ball, "SVONumberOfBuilds")
        kept = scene.statistic(ball, "SVOCacheMemorySize")
        self.assertEqual(self.loop(ball, "SVONumberOfBuilds"), 0)
        self.assertEqual(scene.statistic(ball, "SVONumberOfBuilds"), STEPS)
        self.assertEqual(scene.statistic(ball, "SVOCacheMemorySize"), kept)
        # The view has none of its own.
        self.assertEqual(scene.statistic(self.view, "SVOOctreeMemorySize"), 0)

    def test_each_step_is_the_surface_of_its_time(self):
        ball = scene.show(self.reader, self.view, "Surface")
        self.view.SVOShadowTechnique = "None"
        self.view.SVOPixelError = 0
        pictures = {}
        for kind in ("Surface", "SVO", "SVO"):
            ball.Representation = kind
            for step in range(STEPS):
                self.scene.AnimationTime = step
                picture = scene.picture(self.view, f"{kind}-{step}")
                expected = pictures.setdefault(step, picture)
                self.assertLess(scene.differing(picture, expected, tolerance=2), 2e-4)
        self.assertGreater(scene.differing(pictures[0], pictures[1]), 1e-2)

    def test_saved_animation(self):
        ball = scene.show(self.reader, self.view)
        size = list(self.view.ViewSize)
        pictures = []
        for step in range(STEPS):
            self.scene.AnimationTime = step
            pictures.append(scene.picture(self.view, f"shown-{step}"))
        builds = scene.statistic(ball, "SVONumberOfBuilds")
        pv.SaveAnimation(scene.output("saved.png"), self.view, ImageResolution=size,
                         FrameWindow=[0, STEPS - 1])
        for step, picture in enumerate(pictures):
            saved = scene.read(scene.output(f"saved.{step:04}.png"))
            self.assertEqual(scene.differing(saved, picture, 0), 0)
        self.assertGreater(scene.differing(pictures[0], pictures[1]), 1e-2)
        self.assertEqual(scene.statistic(ball, "SVONumberOfBuilds"), builds)

    def test_moving_and_turning_builds_nothing(self):
        octrees = scene.make_ball()
        ball = scene.show(octrees, self.view)
        pv.Render(self.view)
        for name, index, values in ((scene.position_name(ball), 0, (0.0, 1.0)),
                                    ("Orientation", 2, (0.0, 180.0))):
            track = pv.GetAnimationTrack(name, index=index, proxy=ball)
            first, last = pv.CompositeKeyFrame(), pv.CompositeKeyFrame()
            first.KeyTime, first.KeyValues = 0.0, [values[0]]
            last.KeyTime, last.KeyValues = 1.0, [values[1]]
            track.KeyFrames = [first, last]
        self.scene.PlayMode = "Sequence"
        self.scene.NumberOfFrames = 5
        before = scene.statistic(ball, "SVONumberOfBuilds")
        self.assertEqual(before, 1)
        self.scene.GoToFirst()
        left = scene.picture(self.view, "moved-0")
        self.scene.GoToLast()
        right = scene.picture(self.view, "moved-1")
        self.assertEqual(self.loop(ball, "SVONumberOfBuilds"), 0)
        self.assertGreater(scene.differing(left, right), 1e-2)


scene.load_plugin()
scene.run_tests()
