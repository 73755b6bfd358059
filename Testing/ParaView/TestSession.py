"""A session's other work on traced surfaces: selecting, saving and loading states, tracing to Python,
and changing the representation back and forth."""

import os
import runpy
import unittest

import paraview.simple as pv
import scene
import vtksvo
from paraview import smstate, smtrace
from vtkmodules.vtkFiltersSources import vtkSphereSource


def resident_memory():
    """Of this process, in KiB."""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


class TestSession(unittest.TestCase):
    size = (400, 300)

    def setUp(self):
        self.view = scene.make_view(self.size)
        scene.add_sun(self.view)
        self.ball, self.ground = scene.make_ball(), scene.make_ground()
        self.displays = [scene.show(source, self.view) for source in (self.ball, self.ground)]
        pv.Render(self.view)

    def tearDown(self):
        pv.ResetSession()

    def set_kind(self, kind):
        for display in self.displays:
            display.Representation = kind

    def selected(self, select):
        """Ids of the ball's selected cells or points."""
        select(Rectangle=[150, 150, 260, 240], View=self.view)
        selection = self.ball.GetSelectionInput(self.ball.Port)
        self.assertIsNotNone(selection)
        return sorted(selection.Input[0].IDs)

    def test_selection(self):
        for select in (pv.SelectSurfaceCells, pv.SelectSurfacePoints):
            ids = {}
            for kind in ("Surface", "SVO"):
                pv.ClearSelection(self.ball)
                self.set_kind(kind)
                pv.Render(self.view)
                ids[kind] = self.selected(select)
            self.assertGreater(len(ids["Surface"]), 100)
            self.assertTrue(ids["SVO"] == ids["Surface"], "other ids")
            # What is selected is outlined in magenta.
            shown = scene.picture(self.view, "selection-svo")
            magenta = (shown[..., 0] > 200) & (shown[..., 1] < 60) & (shown[..., 2] > 200)
            self.assertGreater(magenta.sum(), 50)
        self.set_kind("SVO")
        pv.ClearSelection(self.ball)
        pv.Render(self.view)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 2)

    def test_frustum_selection(self):
        pv.SelectCellsThrough(Rectangle=[150, 150, 260, 240], View=self.view)
        self.assertIsNotNone(self.ball.GetSelectionInput(self.ball.Port))

    def test_macro(self):
        macro = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Examples/paraview_shadows.py")
        for on in 1, 0:
            runpy.run_path(macro)
            self.assertEqual(self.view.SVOShadowsForEverything, on)
        pv.SetActiveView(pv.CreateView("SpreadSheetView"))
        with self.assertRaisesRegex(RuntimeError, "load the plugin"):
            runpy.run_path(macro)

    def test_a_view_keeps_paraviews_own_help(self):
        text = type(self.view).__doc__
        self.assertIn("render", text.lower())
        self.assertNotIn("SVO", text.split("\n")[0])

    def change_everything(self):
        self.view.SVOShadowIntensity = 0.6
        self.view.SVOShadowBufferResolution = 512
        self.view.SVOPixelError = 0.5
        self.displays[0].SVOMaximumLevel = 7
        self.displays[0].SVOLeafGeometry = "Voxel"
        self.displays[1].SVOReceiveShadows = 1
        scene.move(self.displays[0], [0.2, 0.1, 0.0])

    def check_restored(self, picture):
        view = pv.GetActiveViewOrCreate("RenderView")
        self.assertEqual(view.SVOShadowBufferResolution, 512)
        self.assertEqual(scene.differing(picture, scene.picture(view, "restored"), 0), 0)
        self.assertEqual(scene.statistic(view, "SVONumberOfTracedActors"), 2)

    def test_wrapped_classes(self):
        sphere = vtkSphereSource()
        convert = vtksvo.vtkPolyDataToSVO()
        convert.SetInputConnection(sphere.GetOutputPort())
        convert.SetMaximumLevel(6)
        convert.Update()
        octree = vtksvo.vtkSparseVoxelOctree()
        self.assertTrue(octree.Initialize(convert.GetOutput()))
        self.assertEqual(octree.GetNumberOfLevels(), 6)
        # The class of the filter in the menu, from the same libraries.
        menu = pv.PolyDataToSVO(Input=self.ball)
        menu.UpdatePipeline()
        self.assertIsInstance(menu.GetClientSideObject(), vtksvo.vtkPPolyDataToSVO)

    def test_state(self):
        self.change_everything()
        picture = scene.picture(self.view, "state")
        path = scene.output("state.pvsm")
        pv.SaveState(path)
        pv.ResetSession()
        pv.LoadState(path)
        self.check_restored(picture)

    def test_a_state_keeps_black_shadows(self):
        self.assertEqual(self.view.SVOShadowIntensity, 1.0)
        self.assertEqual(pv.CreateView("RenderView").SVOShadowIntensity, 0.7)  # a new view's
        path = scene.output("black.pvsm")
        pv.SaveState(path)
        pv.ResetSession()
        pv.LoadState(path)
        kept = [view.SVOShadowIntensity for view in pv.GetRenderViews()]
        self.assertEqual(sorted(kept), [0.7, 1.0])

    def test_a_new_view_draws_with_what_its_properties_say(self):
        # ParaView hands over what differs from the defaults, so those have to be the pass's.
        view = pv.CreateView("RenderView")
        view.ViewSize = self.view.ViewSize
        scene.add_sun(view)
        for source in (self.ball, self.ground):
            scene.show(source, view)
        pv.ResetCamera(view)
        before = scene.picture(view, "defaults")
        for name, other in {"ShadowIntensity": 0.5, "ShadowBufferResolution": 64, "ShadowTechnique": "None",
                            "TranslucentShadows": 0, "AutomaticShadowBias": 0, "ShadowBias": 3.0, "PixelError": 8.0,
                            "FilterShadows": 1, "AntiAliasing": 1}.items():
            setting = view.GetProperty("SVO" + name)
            default = setting.GetData()
            setattr(view, "SVO" + name, other)
            self.assertNotEqual(setting.GetData(), default)
            setattr(view, "SVO" + name, default)
        self.assertEqual(scene.differing(before, scene.picture(view, "defaults-set"), 0), 0)

    def test_python_state(self):
        self.change_everything()
        picture = scene.picture(self.view, "python-state")
        text = smstate.get_state()
        pv.ResetSession()
        self.assertRegex(text, r"SVOShadowIntensity ?= ?0\.6\b")  # an assignment, or an argument of Set()
        exec(compile(text, "state", "exec"), {"__name__": "state"})
        self.check_restored(picture)

    def test_python_trace(self):
        smtrace.start_trace()
        self.displays[0].SetRepresentationType("SVO")
        octrees = pv.PolyDataToSVO(Input=self.ball)
        octrees.MaximumLevel = 6
        display = pv.Show(octrees, self.view)
        display.SetRepresentationType("SVO")
        display.SVOCastShadows = 0
        text = smtrace.stop_trace()
        for expected in "PolyDataToSVO(", "SetRepresentationType('SVO')":
            self.assertTrue(expected in text, expected)

    def test_switching_does_not_grow(self):
        def switch(times):
            for _ in range(times):
                self.set_kind("Surface")
                pv.Render(self.view)
                self.set_kind("SVO")
                pv.Render(self.view)

        switch(20)
        builds = scene.statistic(self.displays[0], "SVONumberOfBuilds")
        growth = []
        for _ in range(4):
            before = resident_memory()
            switch(30)
            growth.append(resident_memory() - before)
        print(f"memory grows by {growth} KiB in 30 switches each")
        # What is lost by a switch is lost in every round; a heap may take a buffer of 16 MiB more once. The
        # ball's octree alone takes 10 MB.
        self.assertLess(min(growth), 1024)
        self.assertLess(sum(growth), 24 * 1024)
        self.assertEqual(scene.statistic(self.displays[0], "SVONumberOfBuilds"), builds)

    def test_hiding_and_deleting(self):
        pv.Hide(self.ball, self.view)
        picture = scene.picture(self.view, "hidden")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 1)
        pv.Delete(self.displays[0])
        pv.Delete(self.ball)
        self.assertEqual(scene.differing(picture, scene.picture(self.view, "deleted"), 0), 0)
        pv.Hide(self.ground, self.view)
        pv.Render(self.view)
        pv.Show(self.ground, self.view)
        self.assertEqual(scene.differing(picture, scene.picture(self.view, "again"), 0), 0)


scene.load_plugin()
scene.run_tests()
