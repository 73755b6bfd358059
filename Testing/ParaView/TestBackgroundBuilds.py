"""Interactive frames do not wait for octrees, whatever has changed right before; the still picture that
follows does, and is the one that it would have been anyway."""

import unittest

import numpy
import paraview.simple as pv
import scene
import series
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

# ParaView draws levels of detail while interacting from so many MB on: never, always.
DETAILS = {"full-geometry": 1000.0, "levels-of-detail": 0.0}


class TestBackgroundBuilds(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((300, 200))
        scene.add_sun(self.view)
        self.ball = scene.make_ball()
        self.displays = [scene.show(source, self.view) for source in (self.ball, scene.make_ground())]
        pv.Render(self.view)
        self.before = self.builds()

    def tearDown(self):
        pv.GetSettingsProxy("RenderViewSettings").LODThreshold = 20.0
        pv.GetSettingsProxy("GeneralSettings").CacheGeometryForAnimation = 0
        pv.ResetSession()

    def builds(self):
        return scene.statistic(self.displays[0], "SVONumberOfBuilds")

    def interactive_frame(self):
        """The picture of an interactive frame, as it is in the window."""
        self.view.SMProxy.InteractiveRender()
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.view.GetRenderWindow())
        grabber.ShouldRerenderOff()
        grabber.Update()
        image = grabber.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(int)

    def check_frame(self, still, share=0.03):
        """An interactive frame shows much the same as a still picture, and builds nothing."""
        frame = self.interactive_frame()
        self.assertEqual(self.builds(), self.before)
        # Octrees of other levels, rays farther apart, shadows that are not there yet.
        self.assertLess(scene.differing(frame, still, 40), share)

    def check_still(self, name, builds=1):
        still = scene.picture(self.view, name)
        self.assertEqual(self.builds(), self.before + builds)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)
        return still

    def set_detail(self, name):
        pv.GetSettingsProxy("RenderViewSettings").LODThreshold = DETAILS[name]
        self.before = self.builds()

    def test_level(self):
        still = scene.picture(self.view, "level-before")
        for level, name in zip((8, 7), DETAILS):
            self.set_detail(name)
            self.displays[0].SVOMaximumLevel = level
            self.check_frame(still)
            self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)
            self.check_still(f"level-{name}")
            # Back to what is kept: no build, and the picture that there was.
            self.displays[0].SVOMaximumLevel = 10
            self.view.SMProxy.InteractiveRender()
            again = scene.picture(self.view, f"level-again-{name}")
            self.assertEqual(scene.differing(again, still, 0), 0)
            self.assertEqual(self.builds(), self.before + 1)

    def test_many_changes(self):
        still = scene.picture(self.view, "many-before")
        for name in DETAILS:
            self.set_detail(name)
            for level in (4, 5, 6, 7, 8, 9, 5, 6, 7):
                self.displays[0].SVOMaximumLevel = level
                self.view.SMProxy.InteractiveRender()
            self.displays[0].SVOMaximumLevel = 10
            self.view.SMProxy.InteractiveRender()
            after = scene.picture(self.view, f"many-{name}")
            self.assertEqual(scene.differing(after, still, 0), 0)

    def test_surface(self):
        for resolution, name in zip((100, 90), DETAILS):
            self.set_detail(name)
            still = scene.picture(self.view, f"surface-before-{name}")
            self.ball.ThetaResolution = resolution
            self.check_frame(still, 0.1)
            after = self.check_still(f"surface-{name}")
            self.assertGreater(scene.differing(after, still, 0), 0)
            other = scene.show(self.ball, self.view, "Surface")  # afresh
            other.Representation = "SVO"
            self.assertEqual(scene.differing(scene.picture(self.view, "afresh"), after, 0), 0)

    def test_blocks_keep_their_colors(self):
        pv.Hide(self.ball, self.view)
        group = pv.GroupDatasets(Input=[self.ball, pv.Sphere(Center=[1, 1, 0.5])],
                                 OutputType="vtkMultiBlockDataSet", BlockNames=["A", "B"])
        self.displays[0] = scene.show(group, self.view)
        self.displays[0].BlockColors = ["/Root/A", "1", "0.2", "0.1"]
        still = scene.picture(self.view, "blocks-before")
        red = (still[..., 0] > 2 * still[..., 1] + 20).sum()
        self.assertGreater(red, 300)
        for level, name in zip((8, 7), DETAILS):
            self.set_detail(name)
            self.displays[0].SVOMaximumLevel = level
            self.check_frame(still)
            frame = self.interactive_frame()
            share = (frame[..., 0] > 2 * frame[..., 1] + 20).sum() / red
            self.assertLess(abs(share - 1), 0.05)
            after = self.check_still(f"blocks-{name}", builds=2)
            self.assertLess(scene.differing(after, still, 40), 0.01)

    def test_time(self):
        steps = 4
        path = series.write(scene.output("ball"), series.breathing_ball(steps))
        pv.Hide(self.ball, self.view)
        reader = pv.PVDReader(FileName=path)
        for cache in (0, 1):
            pv.GetSettingsProxy("GeneralSettings").CacheGeometryForAnimation = cache
            self.displays[0] = scene.show(reader, self.view)
            self.displays[0].SVOMaximumLevel = 9 - cache
            self.view.ViewTime = 0
            pv.Render(self.view)
            for time in range(1, steps):
                self.before = self.builds()
                self.view.ViewTime = time
                self.view.SMProxy.InteractiveRender()
                self.assertEqual(self.builds(), self.before)
            first = self.check_still(f"time-{cache}")
            self.view.ViewTime = 0
            scene.picture(self.view, "time-0")
            self.view.ViewTime = steps - 1
            self.assertEqual(scene.differing(scene.picture(self.view, "time"), first, 0), 0)
            self.assertEqual(self.builds(), self.before + 1)

    def test_a_camera_that_only_moves_updates_nothing(self):
        pv.Render(self.view)
        for _ in range(3):
            self.view.CameraPosition = list(numpy.array(self.view.CameraPosition) + 0.1)
            self.view.SMProxy.InteractiveRender()
        pv.Render(self.view)
        self.assertEqual(self.builds(), self.before)


scene.load_plugin()
scene.run_tests()
