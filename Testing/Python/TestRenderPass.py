"""The render pass from Python: a picture with a shadow, the static helpers, the statistics."""

import unittest

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
import vtksvo
from backend import OPENGL, new_pass, rasterized, traced
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersParallel import vtkExtractPolyDataPiece
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow)


class Scene:
    """A ball above a ground, the sun to its right; the shadow lies around (-1, 0, 0)."""

    def __init__(self, with_filter):
        ball = vtkSphereSource()
        ball.SetCenter(0.0, 0.0, 1.0)
        ground = vtkPlaneSource()
        ground.SetOrigin(-2.0, -2.0, 0.0)
        ground.SetPoint1(2.0, -2.0, 0.0)
        ground.SetPoint2(-2.0, 2.0, 0.0)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(200, 200)
        self.renderer = vtkRenderer()
        self.window.AddRenderer(self.renderer)
        self.actors = []
        for source in (ball, ground):
            if with_filter:
                convert = vtksvo.vtkPolyDataToSVO()
                convert.SetMaximumLevel(7)
                convert.SetInputConnection(source.GetOutputPort())
                source = convert
            mapper = vtkPolyDataMapper()
            mapper.SetInputConnection(source.GetOutputPort())
            actor = vtkActor()
            actor.SetMapper(mapper)
            self.renderer.AddActor(actor)
            self.actors.append(actor)
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPosition(3.0, 0.0, 4.0)
        self.light.SetFocalPoint(0.0, 0.0, 1.0)
        self.renderer.AddLight(self.light)
        self.svo = new_pass()
        self.svo.SetMaximumLevel(7)
        self.renderer.SetPass(self.svo)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0.0, 0.0, 8.0)
        camera.SetFocalPoint(0.0, 0.0, 0.0)

    def pixels(self):
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        width, height = self.window.GetSize()
        self.window.GetPixelData(0, 0, width - 1, height - 1, 1, pixels, 0)
        return bytes(memoryview(pixels))

    def ground_brightness(self, x, y):
        self.window.Render()
        self.renderer.SetWorldPoint(x, y, 0.0, 1.0)
        self.renderer.WorldToDisplay()
        px, py = (int(c) for c in self.renderer.GetDisplayPoint()[:2])
        pixel = vtkUnsignedCharArray()
        self.window.GetPixelData(px, py, px, py, 1, pixel, 0)
        return pixel.GetValue(0)


class RenderPass(unittest.TestCase):
    def test_source_to_picture_with_and_without_the_filter(self):
        for with_filter in (False, True):
            with self.subTest(with_filter=with_filter):
                scene = Scene(with_filter)
                lit = scene.ground_brightness(-1.0, 1.5)
                shadowed = scene.ground_brightness(-1.0, 0.0)
                self.assertGreater(lit, 100)
                self.assertLess(shadowed, 10)
                scene.window.Finalize()

    def test_filtered_meshes_need_no_conversion(self):
        scene = Scene(with_filter=True)
        scene.svo.ConvertPolyDataOff()
        scene.window.Render()
        self.assertEqual(scene.svo.GetNumberOfTracedActors(), traced(2))
        scene.window.Finalize()
        plain = Scene(with_filter=False)
        plain.svo.ConvertPolyDataOff()
        plain.window.Render()
        self.assertEqual(plain.svo.GetNumberOfTracedActors(), 0)
        plain.window.Finalize()

    def test_a_mesh_that_is_drawn_piece_by_piece_is_there_as_a_whole(self):
        scene = Scene(with_filter=False)
        scene.svo.SetShadowTechniqueToNone()
        ball = scene.actors[0]
        # The filter hands on the piece that it is asked for, and holds the last one after a frame.
        extract = vtkExtractPolyDataPiece()
        extract.SetInputConnection(ball.GetMapper().GetInputConnection(0, 0))
        ball.GetMapper().SetInputConnection(extract.GetOutputPort())
        ball.GetMapper().SetNumberOfSubPieces(5)
        traced = scene.pixels()
        self.assertIn("piece by piece", scene.svo.GetReason(ball))
        scene.renderer.SetPass(None)
        plain = scene.pixels()
        self.assertLess(sum(abs(a - b) > 8 for a, b in zip(traced, plain)), 0.001 * len(plain))
        scene.window.Finalize()

    def test_static_helpers_take_the_value_first(self):
        scene = Scene(with_filter=False)
        svo = vtksvo.vtkSVORenderPass
        ball, ground = scene.actors
        lit = scene.ground_brightness(-1.0, 1.5)
        svo.SetCastShadow(False, ball)
        self.assertFalse(svo.GetCastShadow(ball))
        self.assertEqual(scene.ground_brightness(-1.0, 0.0), lit)
        svo.SetCastShadow(True, ball)
        self.assertLess(scene.ground_brightness(-1.0, 0.0), 10)
        svo.SetReceiveShadow(False, ground)
        self.assertFalse(svo.GetReceiveShadow(ground))
        self.assertEqual(scene.ground_brightness(-1.0, 0.0), lit)
        svo.SetReceiveShadow(True, ground)
        svo.SetCastShadow(False, scene.light)
        self.assertFalse(svo.GetCastShadow(scene.light))
        self.assertEqual(scene.ground_brightness(-1.0, 0.0), lit)
        svo.SetCastShadow(True, scene.light)
        svo.SetUseSVO(False, ground)
        self.assertFalse(svo.GetUseSVO(ground))
        self.assertLess(scene.ground_brightness(-1.0, 0.0), 10)
        self.assertEqual(scene.svo.GetNumberOfRasterizedActors(), rasterized(1, of=2))
        scene.window.Finalize()

    @unittest.skipIf(OPENGL, "rays and layers are the CPU's")
    def test_statistics_of_the_last_frame(self):
        scene = Scene(with_filter=False)
        scene.window.Render()
        self.assertGreater(scene.svo.GetNumberOfPrimaryRays(), 0)
        self.assertGreater(scene.svo.GetNumberOfShadowRays(), 0)
        self.assertGreater(scene.svo.GetTraceTime(), 0.0)
        self.assertGreater(scene.svo.GetShadowTime(), 0.0)
        self.assertGreater(scene.svo.GetPresentTime(), 0.0)
        self.assertGreater(scene.svo.GetNumberOfRetracedLayers(), 0)
        # What stands still is kept from its second frame on.
        scene.window.Render()
        scene.window.Render()
        self.assertEqual(scene.svo.GetNumberOfRetracedLayers(), 0)
        scene.window.Finalize()

    @unittest.skipIf(OPENGL, "its rays alone are paced")
    def test_an_interactive_frame_says_what_it_accepted(self):
        scene = Scene(with_filter=False)
        scene.svo.SetPixelError(0.5)
        scene.svo.SetMaximumImageSampleDistance(4.0)
        scene.svo.SetFrameCoherence(False)
        scene.window.Render()
        self.assertEqual(scene.svo.GetImageSampleDistance(), 1.0)
        self.assertEqual(scene.svo.GetAcceptedPixelError(), 0.5)
        still = scene.pixels()
        scene.window.SetDesiredUpdateRate(1e9)  # no frame is that quick
        scene.window.Render()
        self.assertEqual(scene.svo.GetImageSampleDistance(), 4.0)
        self.assertEqual(scene.svo.GetAcceptedPixelError(), 4.0)
        self.assertNotEqual(scene.pixels(), still)
        scene.svo.SetAutoAdjustSampleDistances(False)
        self.assertEqual(scene.pixels(), still)
        scene.svo.SetAutoAdjustSampleDistances(True)
        scene.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(scene.pixels(), still)
        self.assertEqual(scene.svo.GetAcceptedPixelError(), 0.5)
        scene.window.Finalize()

    def test_octrees_that_the_pass_builds_are_counted(self):
        scene = Scene(with_filter=False)
        self.assertEqual(scene.svo.GetNumberOfOctreesBuilt(), 0)
        scene.window.Render()
        built = scene.svo.GetNumberOfOctreesBuilt()
        self.assertGreaterEqual(built, 2)
        self.assertEqual(scene.svo.GetNumberOfOctreesInProgress(), 0)
        scene.window.Render()
        self.assertEqual(scene.svo.GetNumberOfOctreesBuilt(), built)
        scene.window.Finalize()
        # Those that come with their meshes are not the pass's.
        scene = Scene(with_filter=True)
        scene.window.Render()
        self.assertEqual(scene.svo.GetNumberOfOctreesBuilt(), 0)
        scene.window.Finalize()

    def test_settings_are_clamped_to_their_range(self):
        svo = vtksvo.vtkSVORenderPass()
        svo.SetShadowIntensity(7.0)
        self.assertEqual(svo.GetShadowIntensity(), 1.0)
        svo.SetPixelError(-1.0)
        self.assertEqual(svo.GetPixelError(), 0.0)
        svo.SetMaximumLevel(99)
        self.assertEqual(svo.GetMaximumLevel(), 20)
        convert = vtksvo.vtkPolyDataToSVO()
        self.assertEqual(convert.GetMaximumLevel(), 10)


class ShadowMemory(unittest.TestCase):
    """Small actors under three lights, a third of them translucent, in a small window: maps are held as
    far as somebody looks them up and something lies there."""

    def setUp(self):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(240, 200)
        self.renderer = vtkRenderer()
        self.window.AddRenderer(self.renderer)
        self.renderer.AutomaticLightCreationOff()
        for i in range(3):
            light = vtkLight()
            light.SetLightTypeToSceneLight()
            light.SetPosition(2 - 2 * i, 4, 3)
            light.SetPositional(i != 1)
            light.SetConeAngle(180 if i == 0 else 60)
            self.renderer.AddLight(light)
        self.actors = []
        for i in range(9):
            ball = vtkSphereSource()
            ball.SetThetaResolution(10 + 5 * i)
            ball.SetPhiResolution(10 + 5 * i)
            mapper = vtkPolyDataMapper()
            mapper.SetInputConnection(ball.GetOutputPort())
            actor = vtkActor()
            actor.SetMapper(mapper)
            actor.SetPosition(-2 + 2 * (i % 3), 0.6 * (i // 3), -1.5 + (i * 7 % 9) / 3)
            actor.GetProperty().SetOpacity(0.5 if i % 3 == 0 else 1.0)
            self.renderer.AddActor(actor)
            self.actors.append(actor)
        self.svo = new_pass()
        self.svo.SetShadowTechniqueToShadowBuffer()
        self.renderer.SetPass(self.svo)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(4, 4, 7)
        camera.SetFocalPoint(0, 0.7, 0)
        self.renderer.ResetCameraClippingRange()

    def tearDown(self):
        self.window.Finalize()

    def test_it_is_what_is_looked_up_and_does_not_grow(self):
        # Opaque casters alone have thirteen maps of 2048 x 2048 texels: whole, 20 bytes each with copies, 1 GiB.
        sizes = []
        for frame in range(24):
            self.actors[frame % 9].AddPosition(0.2 * (-1) ** (frame // 9), 0, 0.1)
            self.window.Render()
            sizes.append(self.svo.GetShadowMemorySize())
        self.assertGreater(min(sizes), 0)
        # OpenGL's are whole, of 8 bytes a texel; those in which nothing lies are not there.
        self.assertLess(max(sizes), 128 * 1024 if self.svo.GetActiveBackend() == self.svo.BACKEND_CPU else 26 * 32 * 1024)
        self.assertLess(max(sizes[12:]), 1.5 * max(sizes[:12]))

    def test_its_limit_is_kept_and_said_once(self):
        said = []
        self.svo.AddObserver("WarningEvent", lambda *unused: said.append(1))
        self.assertEqual(self.svo.GetShadowMemoryLimit(), 4 * 1024 * 1024)
        self.window.Render()
        self.assertEqual(said, [])
        limit = self.svo.GetShadowMemorySize() // 4
        self.svo.SetShadowMemoryLimit(limit)
        for step in range(3):
            self.actors[0].AddPosition(0, 0.1, 0)
            self.window.Render()
            self.assertLessEqual(self.svo.GetShadowMemorySize(), limit)
        self.assertEqual(said, [1])


class KeptFrame(unittest.TestCase):
    """A frame in which nothing has changed is shown once more; changes in place are seen."""

    def setUp(self):
        self.scene = Scene(False)
        self.ball = self.scene.actors[0]
        self.mapper = self.ball.GetMapper()
        self.mapper.Update()
        self.mesh = vtkPolyData()
        self.mesh.DeepCopy(self.mapper.GetInput())
        self.scalars = vtkFloatArray()
        self.scalars.SetName("height")
        for i in range(self.mesh.GetNumberOfPoints()):
            self.scalars.InsertNextValue(self.mesh.GetPoint(i)[2])
        self.mesh.GetPointData().SetScalars(self.scalars)
        self.mapper.SetInputData(self.mesh)
        self.mapper.SetScalarRange(0.5, 1.5)

    def expect_change(self, change):
        before = self.scene.pixels()
        self.assertEqual(before, self.scene.pixels())
        self.assertEqual(0, self.scene.svo.GetNumberOfPrimaryRays())
        self.assertEqual(0, self.scene.svo.GetNumberOfShadowRays())
        change()
        after = self.scene.pixels()
        self.assertNotEqual(before, after)
        self.assertEqual(after, self.scene.pixels())
        again = new_pass()  # knows nothing of what was before
        again.SetMaximumLevel(7)
        self.scene.renderer.SetPass(again)
        self.assertEqual(after, self.scene.pixels())

    def test_scalars(self):
        def change():
            for i in range(0, self.scalars.GetNumberOfTuples(), 2):
                self.scalars.SetValue(i, 1.0)
            self.scalars.Modified()
        self.expect_change(change)

    def test_table(self):
        self.expect_change(lambda: self.mapper.GetLookupTable().SetHueRange(0.2, 0.4))

    def test_texture_of_scalars(self):
        self.mapper.InterpolateScalarsBeforeMappingOn()
        self.expect_change(lambda: self.mapper.GetLookupTable().SetHueRange(0.2, 0.4))

    def test_normals(self):
        def change():
            normals = self.mesh.GetPointData().GetNormals()
            for i in range(normals.GetNumberOfTuples()):
                x, y, z = normals.GetTuple3(i)
                normals.SetTuple3(i, x, 0.6 * y + 0.8 * z, 0.6 * z - 0.8 * y)
            normals.Modified()
        self.expect_change(change)

    def test_points(self):
        def change():
            points = self.mesh.GetPoints()
            for i in range(points.GetNumberOfPoints()):
                x, y, z = points.GetPoint(i)
                points.SetPoint(i, 1.2 * x, y, z)
            points.Modified()
        self.expect_change(change)

    def test_property(self):
        self.mapper.ScalarVisibilityOff()
        self.expect_change(lambda: self.ball.GetProperty().SetColor(1.0, 0.2, 0.1))

    def test_actor(self):
        self.expect_change(lambda: self.ball.RotateX(20.0))

    def test_light(self):
        self.expect_change(lambda: self.scene.light.SetIntensity(0.5))

    def test_background(self):
        self.expect_change(lambda: self.scene.renderer.SetBackground(0.3, 0.1, 0.1))


class Presentation(unittest.TestCase):
    """What nothing was drawn before may come into the window another way; the picture is the same."""

    @staticmethod
    def picture(rasterized_first, stencil=False):
        scene = Scene(False)
        scene.window.SetStencilCapable(stencil)
        scene.window.SetSize(203, 197)  # no multiple of a tile's 8
        # Behind the ground, and through the ball.
        hidden, through = vtkSphereSource(), vtkSphereSource()
        hidden.SetCenter(0.0, 0.0, -3.0)
        through.SetCenter(0.4, 0.1, 1.2)
        actors = []
        for source in (hidden, through):
            mapper = vtkPolyDataMapper()
            mapper.SetInputConnection(source.GetOutputPort())
            actor = vtkActor()
            actor.SetMapper(mapper)
            actor.GetProperty().SetColor(0.2, 0.4, 1.0)
            vtksvo.vtkSVORenderPass.SetUseSVO(False, actor)
            vtksvo.vtkSVORenderPass.SetCastShadow(False, actor)
            actors.append(actor)
        first = actors[:1] if rasterized_first else []
        last = actors[len(first):]
        for actor in scene.actors:
            scene.renderer.RemoveActor(actor)
        for actor in first + scene.actors + last:
            scene.renderer.AddActor(actor)
        scene.renderer.GradientBackgroundOn()
        scene.renderer.SetBackground2(0.3, 0.5, 0.2)
        scene.renderer.GetActiveCamera().SetPosition(1.0, -4.0, 6.0)
        pictures = []
        for turn in (0.0, 0.0, 20.0):  # the second one is the first once more
            scene.renderer.GetActiveCamera().Azimuth(turn)
            colors = scene.pixels()
            depths = vtkFloatArray()
            scene.window.GetZbufferData(0, 0, 202, 196, depths)
            pictures.append((colors, bytes(memoryview(depths))))
        assert scene.svo.GetNumberOfTracedActors() == traced(2)
        assert scene.svo.GetNumberOfRasterizedActors() == rasterized(2, of=4)
        scene.window.Finalize()
        return pictures

    def check_copies(self, **settings):
        drawn, copied = self.picture(True, **settings), self.picture(False, **settings)
        for one, other in zip(drawn, copied):
            self.assertEqual(one[0], other[0])
            self.assertEqual(one[1], other[1])

    def test_copies_are_what_is_drawn(self):
        self.check_copies()

    def test_copies_beside_a_stencil_are_what_is_drawn(self):
        self.check_copies(stencil=True)


if __name__ == "__main__":
    unittest.main()
