"""Whatever a user then does: a traced surface looks as the representation Surface does, and what is
not the surface's look builds no octree."""

import pathlib
import unittest

import numpy
import paraview
import paraview.simple as pv
import scene


def distributed_plugins(name):
    """Files of a plugin that comes with ParaView, which knows those of the folder that it was installed to only."""
    own = pathlib.Path(paraview.__file__).parents[4]
    found = [file for usr in (own, pathlib.Path("/usr")) for file in usr.glob(f"lib/*/paraview-*/plugins/{name}/*.so")]
    return [str(file) for file in found]


class TestLook(unittest.TestCase):
    """Pictures without shadows and to the full depth, of SVO and of Surface."""

    size = (400, 300)

    def setUp(self):
        self.view = scene.make_view(self.size)
        scene.add_sun(self.view)
        self.view.SVOShadowTechnique = "None"
        self.view.SVOPixelError = 0
        self.displays = []

    def tearDown(self):
        pv.ResetSession()

    def show(self, *sources):
        self.displays += [scene.show(source, self.view) for source in sources]
        return self.displays if len(self.displays) > 1 else self.displays[0]

    def both(self, name, traced=None, **options):
        """The two pictures; checks how many surfaces the first one traced."""
        svo = scene.picture(self.view, name + "-svo", **options)
        if traced is not None:
            self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), scene.traced(traced))
        for display in self.displays:
            display.Representation = "Surface"
        surface = scene.picture(self.view, name + "-surface", **options)
        for display in self.displays:
            display.Representation = "SVO"
        pv.Render(self.view)  # figures are those of the last picture
        return svo, surface

    def check(self, name, traced=None, share=3e-4, tolerance=3, **options):
        svo, surface = self.both(name, traced, **options)
        self.assertLess(scene.differing(svo, surface, tolerance), share)
        return svo

    def builds(self):
        return sum(scene.statistic(display, "SVONumberOfBuilds") for display in self.displays)

    def colored_ball(self):
        """With the height of each point and of each cell."""
        ball = scene.make_ball()
        points = pv.Elevation(Input=ball, LowPoint=[0, 0, 0.3], HighPoint=[0, 0, 1.3])
        return pv.PointDatatoCellData(Input=points, PassPointData=1)

    def test_a_panorama(self):
        """A view that draws its scene in six directions, by another of ParaView's plugins."""
        plugins = distributed_plugins("PanoramicProjectionView")
        if not plugins:
            self.skipTest("this ParaView has no panoramas")
        pv.LoadPlugin(plugins[0], remote=False, ns=vars(pv))
        panorama = pv.CreateView("PanoramicProjectionView")
        for name in ("UseLight", "OrientationAxesVisibility"):
            panorama.SetPropertyWithName(name, 0)
        panorama.ViewSize = list(self.size)
        panorama.CameraPosition = [0.0, -3.0, 1.5]
        panorama.CameraFocalPoint = [0.0, 0.0, 0.3]
        panorama.CameraViewUp = [0.0, 0.0, 1.0]
        scene.choose_backend(panorama)
        panorama.SVOShadowTechnique = "None"
        self.view = panorama
        scene.add_sun(self.view)
        beside = pv.Box(XLength=1, YLength=1, ZLength=1, Center=[-3, -3, 0.5])
        self.show(scene.make_ball(), beside, scene.make_ground())
        picture = self.check("panorama", traced=3, share=2e-3)
        self.view.SVOShadowTechnique = "Shadow Buffer"
        shadowed = scene.picture(self.view, "panorama-shadows")
        self.assertGreater(scene.differing(picture, shadowed, 20), 1e-3)

    def test_a_comparative_view(self):
        """ParaView shows none of the settings; those of the first view, from scripts, are those of all."""
        comparative = pv.CreateView("ComparativeRenderView")
        comparative.ViewSize, comparative.Dimensions = list(self.size), [2, 1]
        for source in (scene.make_ball(), scene.make_ground()):
            pv.Show(source, comparative).Representation = "SVO"
        comparative.CameraPosition = [0.0, -5.0, 3.0]
        comparative.CameraFocalPoint = [0.0, 0.0, 0.3]
        comparative.CameraViewUp = [0.0, 0.0, 1.0]
        first = pv.servermanager._getPyProxy(comparative.GetRootView())
        scene.choose_backend(first)
        shadowed = scene.picture(comparative, "comparative-shadows")
        first.SVOShadowTechnique = "None"
        plain = scene.picture(comparative, "comparative-plain")
        half = shadowed.shape[1] // 2
        for part in (slice(None, half), slice(half, None)):
            self.assertGreater(scene.differing(shadowed[:, part], plain[:, part], 8), 0.005)

    def test_point_and_cell_colors(self):
        ball, _ = self.show(self.colored_ball(), scene.make_ground())
        plain = self.check("plain", traced=2)
        builds = self.builds()
        for association, preset in ("POINTS", "Viridis (matplotlib)"), ("CELLS", "Jet"):
            pv.ColorBy(ball, (association, "Elevation"))
            ball.SetScalarBarVisibility(self.view, True)
            colored = self.check(association.lower(), traced=2)
            self.assertGreater(scene.differing(plain, colored), 0.02)
            table = pv.GetColorTransferFunction("Elevation")
            table.RescaleTransferFunction(0.0, 0.4)
            rescaled = self.check(association.lower() + "-rescaled", traced=2)
            self.assertGreater(scene.differing(rescaled, colored), 0.02)
            scene.apply_preset(table, preset)
            self.assertGreater(scene.differing(rescaled, self.check("preset", traced=2)), 0.02)
            table.RescaleTransferFunction(0.0, 1.0)
        ball.MapScalars = 1
        ball.InterpolateScalarsBeforeMapping = 0
        pv.ColorBy(ball, ("POINTS", "Elevation"))
        self.check("not-interpolated", traced=2)
        self.assertEqual(self.builds(), builds)

    def test_material(self):
        ball, ground = self.show(scene.make_ball(), scene.make_ground())
        builds = self.builds()
        ball.DiffuseColor = ball.AmbientColor = [0.9, 0.3, 0.1]
        ball.Specular, ball.SpecularPower, ball.Ambient = 0.6, 30.0, 0.2
        ground.Interpolation = "Flat"
        self.check("material", traced=2)
        ball.Interpolation = "PBR"
        self.check("pbr", traced=1)
        ball.Interpolation = "Gouraud"
        ball.Opacity = 0.5
        self.check("translucent", traced=1)
        ball.Opacity = 1.0
        ball.BackfaceRepresentation = "Cull Backface"
        self.check("culled", traced=1)
        ball.BackfaceRepresentation = "Follow Frontface"
        scene.move(ball, [0.3, 0, 0.1])
        ball.Scale, ball.Orientation = [1, 1.5, 0.7], [10, 20, 30]
        self.check("transformed", traced=2)
        self.assertEqual(self.builds(), max(builds, 2))

    def test_blocks(self):
        groups = pv.GroupDatasets(Input=[scene.make_ball(), scene.make_ground()],
                                  OutputType="vtkMultiBlockDataSet",
                                  BlockNames=["Sphere1", "Plane1"])
        display = self.show(groups)
        self.check("blocks")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), scene.traced(2))
        builds = self.builds()
        self.assertEqual(builds, 2)
        names = ["/Root/Sphere1", "/Root/Plane1"]
        self.assertEqual(list(display.BlockSelectors), ["/"])
        pv.ColorBy(display, ("FIELD", "vtkBlockColors"))
        self.check("block-colors")
        pv.ColorBy(display, None)
        display.BlockColors = [names[0], "1", "0.2", "0.1"]
        colored = self.check("one-block-colored")
        self.assertGreater((colored[..., 0] - colored[..., 2]).max(), 100)
        display.BlockColors = []
        display.BlockSelectors = [names[1]]
        self.check("one-block")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), scene.traced(1))
        display.BlockSelectors = ["/"]
        display.BlockOpacities = [names[0], "0.4"]
        self.check("one-block-translucent")
        self.assertEqual(self.builds(), builds)

    def test_all_together(self):
        ball, ground = self.show(self.colored_ball(), scene.make_ground())
        self.view.SVOShadowTechnique, self.view.SVOPixelError = "Shadow Buffer", 1
        self.view.SVOShadowIntensity = 0.7
        self.view.SVOAntiAliasing = 0 if scene.OPENGL else 1  # of OpenGL's pictures it says that the window has that
        self.view.OrientationAxesVisibility = 1
        ground.DiffuseColor = ground.AmbientColor = [0.6, 0.8, 0.6]
        pv.ColorBy(ball, ("POINTS", "Elevation"))
        scene.apply_preset(pv.GetColorTransferFunction("Elevation"), "Viridis (matplotlib)")
        ball.SetScalarBarVisibility(self.view, True)
        pv.Render(self.view)
        pv.SelectSurfaceCells(Rectangle=[150, 150, 190, 200], View=self.view)
        picture = scene.picture(self.view, "all-together")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), scene.traced(2))
        # The axes' and legend's letters are in it.
        self.assertLess(scene.baseline_difference(picture, "AllTogether"), 2e-3)
        pv.ClearSelection()

    def test_effects_of_the_view(self):
        self.show(scene.make_ball(), scene.make_ground())
        self.check("effects-none", traced=2)
        # FXAA works on edges: an outline's pixel that is off takes its neighbours along.
        self.view.UseFXAA = 0
        self.check("no-fxaa", traced=2)
        self.view.UseFXAA = 1
        self.view.UseAmbientOcclusion = 1
        self.check("ssao", traced=2, share=2e-3, tolerance=8)
        self.view.UseAmbientOcclusion = 0
        self.view.CameraParallelProjection = 1
        self.view.CameraParallelScale = 2.0
        self.check("parallel", traced=2)
        self.view.CameraParallelProjection = 0
        self.view.OrientationAxesVisibility = 1
        self.view.CenterAxesVisibility = 1
        self.view.AxesGrid.Visibility = 1
        self.check("axes", traced=2)

    def test_stereo(self):
        self.show(scene.make_ball(), scene.make_ground())
        one_eye = scene.picture(self.view, "one-eye")
        self.view.StereoRender = 1
        for kind in "Red-Blue", "Interlaced", "Anaglyph", "Checkerboard", "SplitViewportHorizontal":
            with self.subTest(kind=kind):
                self.view.StereoType = kind
                pv.Render(self.view)  # ParaView's own first picture shows one eye twice
                stereo = self.check("stereo-" + kind, traced=2)
                self.assertGreater(scene.differing(stereo, one_eye), 5e-3)

    def test_screenshots(self):
        self.show(scene.make_ball(), scene.make_ground())
        large = self.check("large", ImageResolution=[3 * n for n in self.size])
        self.assertEqual(large.shape[:2], (900, 1200))
        clear = self.check("transparent", TransparentBackground=1)
        self.assertEqual(clear.shape[2], 4)
        alpha = clear[..., 3]
        self.assertEqual(alpha[-1, 0], 0)
        self.assertEqual(alpha[alpha.shape[0] // 2, alpha.shape[1] // 2], 255)

    def test_light_kit_and_headlight(self):
        self.show(scene.make_ball(), scene.make_ground())
        self.view.UseLight = 1
        self.check("kit-and-sun", traced=2)
        pv.RemoveLight(self.view.AdditionalLights[0])
        self.check("kit", traced=2)
        self.view.SVOShadowTechnique = "Shadow Buffer"
        shadowed, plain = self.both("kit-shadows", traced=2)
        darker = (plain - shadowed).max(axis=2) > 8
        self.assertGreater(darker.mean(), 0.005)
        self.assertLess((shadowed - plain).max(), 9)  # a shadow never lightens
        # The kit's key light, and neither its other lights nor the headlight.
        lights = scene.statistic(self.view, "SVOCastingLights").splitlines()
        self.assertEqual([line.split(",")[0] for line in lights],
                         ["Head light", "Key light", "Fill light", "Back light", "Back light"])
        self.assertEqual([line for line in lights if "casts shadows" in line],
                         ["Key light, directional: casts shadows"])

    def test_several_views(self):
        ball, ground = scene.make_ball(), scene.make_ground()
        self.show(ball, ground)
        first = scene.picture(self.view, "view-1")
        other = scene.make_view(self.size)
        scene.add_sun(other)
        scene.show(ball, other)
        scene.show(ground, other)
        second = scene.picture(other, "view-2")  # the second view's settings are its own
        self.assertGreater(scene.differing(first, second), 5e-3)
        self.assertEqual(scene.differing(first, scene.picture(self.view, "view-1-again")), 0)
        other.SVOShadowTechnique = "None"
        other.SVOPixelError = 0
        self.assertEqual(scene.differing(first, scene.picture(other, "view-2-like-1")), 0)
        pv.Delete(other)
        self.assertEqual(scene.differing(first, scene.picture(self.view, "view-1-alone")), 0)

    def test_split_view(self):
        ball, ground = scene.make_ball(), scene.make_ground()
        self.show(ball, ground)
        layout = pv.CreateLayout("split")
        left = layout.SplitHorizontal(0, 0.5)
        pv.AssignViewToLayout(self.view, layout, left)
        other = scene.make_view(self.size)
        scene.add_sun(other)
        other.SVOShadowTechnique = "Shadow Buffer"
        other.SVOShadowIntensity = 0.5
        pv.AssignViewToLayout(other, layout, left + 1)
        for source in ball, ground:
            scene.show(source, other)
        layout.SetSize(2 * self.size[0], self.size[1])
        alone = [scene.picture(view, "split-" + name)
                 for view, name in ((self.view, "left"), (other, "right"))]
        self.assertGreater(scene.differing(*[a[:, :300] for a in alone]), 5e-3)
        path = scene.output("split.png")
        pv.SaveScreenshot(path, layout, SeparatorWidth=0,
                          ImageResolution=[sum(a.shape[1] for a in alone), alone[0].shape[0]])
        both = scene.read(path)
        self.assertEqual(scene.differing(both, numpy.concatenate(alone, axis=1), 0), 0)

    def test_surface_of_other_data(self):
        wavelet = pv.Wavelet(WholeExtent=[-10, 10] * 3)
        contour = pv.Contour(Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])
        display = self.show(contour)
        pv.ColorBy(display, ("POINTS", "RTData"))
        pv.ResetCamera(self.view)
        self.check("contour", traced=1)
        pv.Hide(contour, self.view)
        clip = pv.Clip(Input=wavelet, ClipType="Plane")  # an unstructured grid
        self.displays = [scene.show(clip, self.view)]
        pv.ColorBy(self.displays[0], ("POINTS", "RTData"))
        self.check("unstructured", traced=1)
        pv.Hide(clip, self.view)
        self.displays = [scene.show(wavelet, self.view)]
        self.check("image", traced=1)


scene.load_plugin()
scene.run_tests()
