"""Surfaces that are no meshes: isosurfaces of images and implicit functions, traced with shadows."""

import unittest

import numpy
import paraview.simple as pv
import scene
import vtksvo  # gives the algorithms' own methods
from messages import Output

STEPS = 3


def statistics(source):
    source.UpdatePipeline()
    return scene.statistic(source, "NumberOfVoxels"), scene.statistic(source, "BuildTime")


def function_of(source, name, **properties):
    source.ImplicitFunction = name
    for key, value in properties.items():
        setattr(source.ImplicitFunction, key, value)


def wavelet():
    """Smooth at the distance of its points. Executed, so that the arrays are known of which filters choose one by default."""
    source = pv.Wavelet(WholeExtent=[-24, 24, -24, 24, -24, 24], XFreq=20, YFreq=10, ZFreq=13)
    source.UpdatePipeline()
    return source


def shown(mask):
    """Without pixels whose neighbours are not in the mask."""
    return mask & ~scene.border(mask, 2)


class Traced(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view()
        scene.add_sun(self.view)

    def tearDown(self):
        pv.ResetSession()

    def picture(self, name):
        picture = scene.picture(self.view, name)
        self.traced = scene.statistic(self.view, "SVONumberOfTracedActors")
        return picture


class ImplicitFunctions(Traced):
    def make(self, name, **properties):
        source = pv.ImplicitFunctionToSVO(MaximumLevel=8)
        function_of(source, name, **properties)
        return source

    def test_shadow_of_a_sphere_is_where_arithmetic_says(self):
        ball = self.make("Sphere", Center=list(scene.CENTER), Radius=scene.RADIUS)
        ball.ModelBounds = [-0.6, 0.6, -0.6, 0.6, 0.2, 1.4]
        voxels, seconds = statistics(ball)
        # One to three voxels for each voxel's face of the area.
        area = 4 * numpy.pi * scene.RADIUS ** 2 * (256 / 1.2) ** 2
        self.assertTrue(area < voxels < 3 * area, (voxels, area))
        self.assertGreater(seconds, 0)
        # The representation that it is shown as by default.
        self.assertEqual(pv.Show(ball, self.view).Representation, "SVO")
        scene.show(scene.make_ground(), self.view)
        picture = self.picture("sphere")
        self.assertEqual(self.traced, scene.traced(1, others=1))
        ground, dark = scene.exact_shadow(self.view, self.view.ViewSize)
        sure = ground & ~scene.border(ground, 2) & ~scene.border(dark, 2)
        black = picture[..., :3].max(axis=2) < 10
        self.assertGreater((dark & sure).sum(), 1000)
        self.assertEqual(((black != dark) & sure).sum(), 0)
        # OpenGL's shaders trace it as well.
        self.view.SVOShadowTechnique = "Shadow Rays"
        rays = self.picture("sphere-rays")
        self.view.SVOBackend = "OpenGL"
        drawn = self.picture("sphere-opengl")
        self.assertEqual(self.traced, 1)  # the ground is rasterised
        self.assertLess(scene.differing(rays, drawn), 4e-4)
        self.view.SVOBackend, self.view.SVOShadowTechnique = "CPU", "Shadow Buffer"
        scene.choose_backend(self.view)
        # And as the mesh is shaded.
        pv.Hide(ball, self.view)
        scene.show(scene.make_ball(), self.view)
        self.assertLess(scene.differing(picture, self.picture("sphere-of-a-mesh"), 24), 5e-3)

    def test_functions(self):
        """Each is there, in its box, and moves with its properties."""
        scene.show(scene.make_ground(), self.view)
        ground = self.picture("ground-alone")
        cases = {
            "Sphere": {"Center": [0, 0, 0.8], "Radius": 0.6},
            "Box": {"Position": [-0.5, -0.5, 0.3], "Length": [1, 1, 1]},
            "Plane": {"Origin": [0, 0, 0.8], "Normal": [0.3, 0.2, 1]},
            "Cylinder": {"Center": [0, 0, 0.8], "Axis": [1, 0, 0.4], "Radius": 0.4},
            # A hyperboloid of one sheet around z, with its waist at 0.8.
            "Quadric": {"QuadricCoefficients": [1, 1, -0.7, 0, 0, 0, 0, 0, 1.12, -0.53]},
            "PerlinNoise": {"Frequency": [1, 1, 1]},
            "Mandelbulb": {"Power": 8, "NumberOfIterations": 6},
        }
        names = pv.ImplicitFunctionToSVO().GetProperty("ImplicitFunction").GetAvailable()
        self.assertEqual(sorted(names), sorted(cases))
        pictures = []
        for name, properties in cases.items():
            with self.subTest(function=name):
                source = self.make(name, **properties)
                source.ModelBounds = [-1.2, 1.2, -1.2, 1.2, 0.1, 1.6]
                self.assertGreater(statistics(source)[0], 10000)
                scene.show(source, self.view)
                pictures.append(self.picture("function-" + name))
                pv.Hide(source, self.view)
                for other in [ground] + pictures[:-1]:
                    self.assertGreater(scene.differing(pictures[-1], other), 0.02)
                if name in ("Sphere", "Box", "Cylinder", "Quadric"):
                    low, high = (numpy.array(source.GetDataInformation().GetBounds())[i::2]
                                 for i in (0, 1))
                    # The surface ends at the box.
                    self.assertTrue((low > [-1.3, -1.3, 0.0]).all() and (high < [1.3, 1.3, 1.7]).all())

    @unittest.skipIf(scene.OPENGL, "nothing is drawn")
    def test_settings(self):
        source = self.make("Mandelbulb")
        source.ModelBounds = [-1.2, 1.2] * 3
        coarse, _ = statistics(source)
        source.MaximumLevel = 9
        fine, _ = statistics(source)
        self.assertTrue(3 * coarse < fine < 8 * coarse, (coarse, fine))
        source.ImplicitFunction.NumberOfIterations = 3
        smooth, _ = statistics(source)
        self.assertLess(smooth, 0.9 * fine)
        source.Value = 0.1
        self.assertLess(statistics(source)[0], smooth)
        # A bound that is too short leaves parts out.
        source.Value, source.GradientBound = 0.0, 0.05
        self.assertLess(statistics(source)[0], smooth)
        source.MinimumLevel = 4
        source.UpdatePipeline()
        self.assertEqual(source.GetClientSideObject().GetMinimumLevel(), 4)

    def test_one_message(self):
        source = self.make("Sphere", Radius=7.0)  # beyond the box
        with Output() as output:
            source.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        self.assertIn("No surface was found", output.messages()[0])
        self.assertEqual(scene.statistic(source, "NumberOfVoxels"), 0)
        function_of(source, "Sphere", Radius=1.0)
        source.MaximumLevel, source.MemoryLimit = 12, 1000
        with Output() as output:
            source.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        self.assertIn("level 12", output.messages()[0])
        source.ModelBounds, source.MemoryLimit = [0.0] * 6, 0
        with Output() as output:
            source.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        self.assertIn("box", output.messages()[0])


class Images(Traced):
    def camera(self):
        self.view.CameraPosition = [100.0, -125.0, 105.0]
        self.view.CameraFocalPoint = [0.0, 0.0, -8.0]

    def ground(self):
        return pv.Plane(Origin=[-45, -45, -30], Point1=[45, -45, -30], Point2=[-45, 45, -30])

    def test_defaults(self):
        """What a user meets who adds the filter: the array, and the middle of its range."""
        image = wavelet()
        octree = pv.ImageToSVO(Input=image)
        self.assertEqual(list(octree.ContourBy), ["POINTS", "RTData"])
        low, high = image.PointData["RTData"].GetRange()
        self.assertAlmostEqual(octree.Value, (low + high) / 2, places=3)
        domain = octree.GetProperty("Value").GetDomain("range")
        self.assertAlmostEqual(domain.GetMinimum(0), low, places=3)
        self.assertAlmostEqual(domain.GetMaximum(0), high, places=3)
        voxels, seconds = statistics(octree)
        self.assertGreater(voxels, 1000)
        self.assertGreater(seconds, 0)
        # For the Information panel.
        field = octree.GetFieldDataInformation()
        self.assertEqual(field["SVO Voxels"].GetRange()[0], voxels)
        self.assertEqual(field["SVO Level"].GetRange()[0], 8)
        self.assertEqual(pv.Show(octree, self.view).Representation, "SVO")

    def test_looks_as_the_contour_does(self):
        """Shadows included: the contour's octree is that of its triangles."""
        self.camera()
        image = wavelet()
        ground = scene.show(self.ground(), self.view)
        octree = pv.ImageToSVO(Input=image, Value=140.0, MaximumLevel=8)
        scene.show(octree, self.view)
        traced = self.picture("wavelet")
        self.assertEqual(self.traced, scene.traced(1, others=1))
        pv.Hide(octree, self.view)
        contour = pv.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[140.0])
        display = scene.show(contour, self.view)
        pv.ColorBy(display, None)
        mesh = self.picture("wavelet-contour")
        # Outlines, and facets where the image has few points: but no areas.
        differ = abs(traced - mesh).max(axis=2) > 24
        self.assertLess(differ.mean(), 0.02)
        self.assertLess((differ & ~scene.border(differ, 2)).mean(), 1e-3)
        # Its shadow on the ground is there.
        ground.SVOReceiveShadows = 0
        lit = self.picture("wavelet-no-shadow")
        dark = (lit.max(axis=2) > 100) & (mesh.max(axis=2) < 10)
        self.assertGreater(shown(dark).sum(), 2000)
        self.assertEqual((shown(dark) & (traced.max(axis=2) > 10)).sum(), 0)

    def test_value_is_dragged(self):
        """Through other values to one: the picture is that of one made afresh."""
        self.camera()
        image = wavelet()
        scene.show(self.ground(), self.view)
        octree = pv.ImageToSVO(Input=image, Value=120.0)
        scene.show(octree, self.view)
        pictures = [self.picture("value-120")]
        for value in (150.0, 180.0):
            octree.Value = value
            pictures.append(self.picture(f"value-{value:.0f}"))
        for a, b in ((0, 1), (0, 2), (1, 2)):
            self.assertGreater(scene.differing(pictures[a], pictures[b]), 0.02)
        pv.Hide(octree, self.view)
        scene.show(pv.ImageToSVO(Input=image, Value=180.0), self.view)
        self.assertEqual(scene.differing(pictures[-1], self.picture("value-afresh"), 0), 0)

    def test_isovalues(self):
        """Several values; scripts and states that know of one are right as they were."""
        octree = pv.ImageToSVO(Input=wavelet(), Value=120.0, MaximumLevel=7, Colors="RTData")
        self.assertEqual(list(octree.Isovalues), [])
        one = statistics(octree)[0]
        octree.Isovalues = [120.0, 180.0, 220.0]
        several = statistics(octree)[0]
        self.assertGreater(several, 1.2 * one)
        low, high = octree.CellData["RTData"].GetRange()
        self.assertAlmostEqual(low, 120.0, delta=6.0)
        self.assertAlmostEqual(high, 220.0, delta=6.0)
        state = scene.output("isovalues.pvsm")
        pv.SaveState(state)
        pv.ResetSession()
        pv.LoadState(state)
        octree = pv.FindSource("ImageToSVO1")
        self.assertEqual(octree.Value, 120.0)
        self.assertEqual(list(octree.Isovalues), [120.0, 180.0, 220.0])
        self.assertEqual(statistics(octree)[0], several)
        octree.Isovalues = []
        self.assertEqual(statistics(octree)[0], one)

    def test_time_steps(self):
        """Of an image that changes with time: voxels and pictures follow."""
        image = pv.ProgrammableSource(OutputDataSetType="vtkImageData")
        image.ScriptRequestInformation = f"""
executive = self.GetExecutive()
info = executive.GetOutputInformation(0)
info.Set(executive.WHOLE_EXTENT(), 0, 24, 0, 24, 0, 24, )
info.Remove(executive.TIME_STEPS())
for t in range({STEPS}):
    info.Append(executive.TIME_STEPS(), t)
info.Set(executive.TIME_RANGE(), [0, {STEPS - 1}], 2)
"""
        image.Script = """
import numpy
executive = self.GetExecutive()
time = executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP()) or 0.0
output = self.GetImageDataOutput()
output.SetDimensions(25, 25, 25)
output.SetOrigin(-1, -1, 0)
output.SetSpacing(1 / 12, 1 / 12, 1 / 12)
z, y, x = numpy.mgrid[0:25, 0:25, 0:25] / 12 - 1
from vtkmodules.util.numpy_support import numpy_to_vtk
array = numpy_to_vtk((numpy.sqrt(x * x + y * y + z * z) - 0.5 - 0.15 * time).ravel(), deep=1)
array.SetName("distance")
output.GetPointData().SetScalars(array)
"""
        image.UpdatePipelineInformation()
        octree = pv.ImageToSVO(Input=image, ContourBy=["POINTS", "distance"], Value=0.0,
                               MaximumLevel=6)
        octree.UpdatePipeline()
        octree.UpdatePipelineInformation()
        self.assertEqual(list(octree.TimestepValues), list(range(STEPS)))
        scene.show(scene.make_ground(), self.view)
        scene.show(octree, self.view)
        animation = pv.GetAnimationScene()
        animation.UpdateAnimationUsingDataTimeSteps()

        def loop(name):
            voxels, pictures = [], []
            for time in range(STEPS):
                animation.AnimationTime = time
                pictures.append(self.picture(f"{name}-{time}"))
                voxels.append(scene.statistic(octree, "NumberOfVoxels"))
            return voxels, pictures

        voxels, first = loop("time")
        for time in range(STEPS):
            ratio = voxels[time] / voxels[0]
            self.assertAlmostEqual(ratio, ((0.5 + 0.15 * time) / 0.5) ** 2, delta=0.12 * ratio)
        again = loop("again")[1]
        for a, b in zip(first, again):
            self.assertEqual(scene.differing(a, b, 0), 0)

    def test_another_array_colors_it(self):
        height = pv.Calculator(Input=wavelet(), ResultArrayName="height", Function="coordsZ")
        height.UpdatePipeline()
        octree = pv.ImageToSVO(Input=height, Value=140.0, MaximumLevel=7, Colors="height")
        octree.ContourBy = ["POINTS", "RTData"]
        octree.UpdatePipeline()
        low, high = octree.CellData["height"].GetRange()
        self.assertLess(low, -20)
        self.assertGreater(high, 20)
        display = scene.show(octree, self.view)
        pv.ColorBy(display, ("CELLS", "height"))
        display.RescaleTransferFunctionToDataRange()
        self.view.ResetCamera()
        picture = self.picture("height")
        self.assertEqual(self.traced, 1)
        # Cool below, warm above; the background is neither.
        excess = picture[..., 0].astype(int) - picture[..., 2]
        warm, cool = (numpy.nonzero(mask)[0] for mask in (excess > 60, excess < -40))
        self.assertGreater(len(warm), 3000)
        self.assertGreater(len(cool), 500)
        self.assertGreater(abs(warm.mean() - cool.mean()), picture.shape[0] / 5)

    def test_one_message(self):
        octree = pv.ImageToSVO(Input=wavelet(), Value=1e6)
        with Output() as output:
            octree.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        self.assertIn("does not take the value", output.messages()[0])
        self.assertEqual(scene.statistic(octree, "NumberOfVoxels"), 0)
        octree.Value = 140.0
        octree.ContourBy = ["POINTS", "nothing of that name"]
        with Output() as output:
            octree.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        image = pv.Wavelet(WholeExtent=[-10, 10, -10, 10, 0, 0])
        image.UpdatePipeline()
        flat = pv.ImageToSVO(Input=image, Value=140.0)
        with Output() as output:
            flat.UpdatePipeline()
        self.assertEqual(len(output.messages()), 1, output.text)
        self.assertIn("fewer than two points", output.messages()[0])


scene.load_plugin()
scene.run_tests()
