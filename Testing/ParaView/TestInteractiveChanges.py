"""Interactive frames do not wait for octrees, whatever has changed right before; the still picture that
follows does, and is the one that it would have been anyway. So are screenshots and animations."""

import unittest

import numpy
import paraview.simple as pv
import scene
import series
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

# ParaView draws levels of detail while interacting from so many MB on: never, always.
DETAILS = {"full-geometry": 1000.0, "levels-of-detail": 0.0}


class TestInteractiveChanges(unittest.TestCase):
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
        self.displays[0].SVOLeafGeometry = "Plane"  # else few triangles need no such levels
        # Rays two pixels apart, as a slow frame has them, already make the ball 6 % larger or smaller.
        self.view.SVOAutoAdjustSampleDistances = 0
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

    def show_series(self, name, steps, level):
        """Voxels so large that no other octree looks the same."""
        path = series.write(scene.output(name), series.breathing_ball(steps))
        pv.Hide(self.ball, self.view)
        display = scene.show(pv.PVDReader(FileName=path), self.view)
        display.SVOLeafGeometry = "Voxel"
        display.SVOMaximumLevel = level
        self.displays[0] = display
        return pv.GetAnimationScene()

    def test_time(self):
        steps = 4
        self.show_series("time", steps, 4)
        self.view.ViewTime = 0
        pv.Render(self.view)
        for time in range(1, steps):
            self.before = self.builds()
            self.view.ViewTime = time
            self.view.SMProxy.InteractiveRender()
            self.assertEqual(self.builds(), self.before)
        first = self.check_still("time-still")
        self.view.ViewTime = 0
        scene.picture(self.view, "time-0")
        self.view.ViewTime = steps - 1
        self.assertEqual(scene.differing(scene.picture(self.view, "time-again"), first, 0), 0)
        self.assertEqual(self.builds(), self.before + 1)

    def test_time_steps_of_an_animation_are_complete(self):
        """Also those that ParaView keeps, and that begin while the user still interacts."""
        for cache in (0, 1):
            pv.GetSettingsProxy("GeneralSettings").CacheGeometryForAnimation = cache
            for turning in (False, True):
                with self.subTest(cache=cache, turning=turning):
                    # A level of its own each, so that all are built.
                    animation = self.show_series(f"animation{cache}{turning}", 4, 4)
                    animation.UpdateAnimationUsingDataTimeSteps()
                    expected = []
                    for time in range(4):
                        animation.AnimationTime = time
                        expected.append(scene.picture(self.view, f"animation-{time}"))
                    self.displays[0].SVOMaximumLevel = 5
                    animation.AnimationTime = 0
                    pv.Render(self.view)
                    self.displays[0].SVOMaximumLevel = 4
                    self.displays[0].SVOCacheMemoryLimit = 0
                    for time in (1, 0, 2, 3, 1, 2, 0, 3):
                        if turning:
                            self.view.SMProxy.InteractiveRender()
                        animation.AnimationTime = time
                        shown = scene.picture(self.view, "animation-shown")
                        self.assertEqual(scene.differing(shown, expected[time], 0), 0)
                    self.assertGreater(scene.differing(expected[0], expected[1], 20), 0.01)
                    pv.Hide(pv.GetActiveSource(), self.view)
                    pv.Delete(self.displays[0].Input)

    def updates(self, action):
        """How often the ball's representation is updated meanwhile."""
        representation = self.displays[0].SMProxy.GetClientSideObject().GetActiveRepresentation()
        count = []
        observer = representation.AddObserver("UpdateDataEvent", lambda *_: count.append(1))
        action()
        representation.RemoveObserver(observer)
        return len(count)

    def test_a_camera_that_only_moves_updates_nothing(self):
        def turn():
            for _ in range(3):
                self.view.CameraPosition = list(numpy.array(self.view.CameraPosition) + 0.1)
                self.view.SMProxy.InteractiveRender()
            pv.Render(self.view)

        self.assertEqual(self.updates(turn), 0)
        self.displays[0].SVOMaximumLevel = 6
        # By the first frame, and to complete it by the still picture.
        self.assertEqual(self.updates(turn), 2)
        self.assertEqual(self.updates(turn), 0)

    def test_screenshots_are_complete(self):
        self.view.UseInteractiveRenderingForScreenshots = 1
        self.ball.ThetaResolution = 12
        self.view.SMProxy.InteractiveRender()
        self.assertEqual(self.builds(), self.before)
        taken = scene.picture(self.view, "interactive-screenshot")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)
        self.view.UseInteractiveRenderingForScreenshots = 0
        still = scene.picture(self.view, "still-screenshot")
        self.assertEqual(scene.differing(taken, still, 0), 0)

    def test_what_paraview_takes_for_the_size(self):
        """Thresholds of the size decide where and how ParaView draws, with octrees or without."""
        view = self.view.SMProxy.GetClientSideObject()
        for threshold in (0.5, 1, 2, 3, 4, 5, 6, 8, 12):
            pv.GetSettingsProxy("RenderViewSettings").LODThreshold = threshold
            self.ball.ThetaResolution = 128
            pv.Render(self.view)
            details = view.GetUseLODForInteractiveRender()
            self.ball.ThetaResolution = 127
            self.view.SMProxy.InteractiveRender()
            self.assertEqual(view.GetUseLODForInteractiveRender(), details)
            self.displays[0].SVOCacheMemoryLimit = 0  # so that it is not kept for the next threshold
            pv.Render(self.view)

    def test_updates_outside_of_frames(self):
        still = scene.picture(self.view, "outside-before")
        for resolution, name in zip((100, 90), DETAILS):
            self.set_detail(name)
            self.ball.ThetaResolution = resolution
            self.view.SMProxy.Update()
            self.assertEqual(self.builds(), self.before + 1)
            frame = self.interactive_frame()
            self.assertLess(scene.differing(frame, still, 40), 0.02)
            self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)

    def test_comparative_view(self):
        view = pv.CreateView("ComparativeRenderView")
        display = scene.show(self.ball, view)
        pv.ResetCamera(view)
        pv.Render(view)
        root = view.SMProxy.GetRootView()
        for resolution in (100, 90):
            builds = scene.statistic(display, "SVONumberOfBuilds")
            self.ball.ThetaResolution = resolution
            view.SMProxy.InteractiveRender()
            root.InteractiveRender()
            pv.Render(view)
            self.assertEqual(scene.statistic(display, "SVONumberOfBuilds"), builds + 1)
            root.UpdatePropertyInformation()
            self.assertEqual(root.GetProperty("SVONumberOfTracedActors").GetElement(0), 1)


scene.load_plugin()
scene.run_tests()
