"""Lights with a size and ambient occlusion: how a picture is refined, what settings do, what is said."""

import time
import unittest

import numpy
import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
import vtkmodules.vtkRenderingUI
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import (VTK_DOUBLE, vtkOutputWindow, vtkStringOutputWindow,
                                      vtkUnsignedCharArray)
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderWindowInteractor, vtkTexture
import ball_on_ground
from vtksvo import vtkSVORenderPass

SIZE = (160, 120)
SIZE_OF_LIGHT = 1.0


class TestSoftLight(unittest.TestCase):
    def setUp(self):
        ball_on_ground.build(self, SIZE, vtkSVORenderPass())
        self.svo.SetBackendToCPU()
        self.window.SetOffScreenRendering(True)
        self.renderer.AutomaticLightCreationOff()
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPosition(3.0, -2.0, 5.0)
        self.light.SetPositional(True)
        self.light.SetConeAngle(180.0)
        self.renderer.AddLight(self.light)
        self.said = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.said)

    def tearDown(self):
        vtkOutputWindow.SetInstance(None)
        self.window.Finalize()

    def refine(self):
        """As often as may be; the samples before each step but the last."""
        steps = [self.svo.GetNumberOfLightSamples()]
        while self.svo.Refine():
            steps.append(self.svo.GetNumberOfLightSamples())
        return steps

    def picture(self):
        self.window.Render()
        return self.shown()

    def shown(self):
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, SIZE[0] - 1, SIZE[1] - 1, 0, pixels, 0)
        return vtk_to_numpy(pixels).astype(int)

    def soften(self, size=SIZE_OF_LIGHT):
        vtkSVORenderPass.SetLightSize(size, self.light)

    def test_a_light_without_a_size_is_a_point(self):
        hard = self.picture()
        self.assertEqual(vtkSVORenderPass.GetLightSize(self.light), 0.0)
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 0)
        self.soften()
        soft = self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), self.svo.GetMaximumLightSamples())
        self.assertGreater(numpy.abs(soft - hard).max(), 50)
        self.soften(0.0)
        self.assertTrue((self.picture() == hard).all())
        self.assertEqual(self.said.GetOutput(), "")

    def test_sizes_that_are_none_are_refused(self):
        self.soften()
        for size in (-1.0, float("nan"), float("inf")):
            self.soften(size)
            self.assertEqual(vtkSVORenderPass.GetLightSize(self.light), SIZE_OF_LIGHT)
        self.assertEqual(self.said.GetOutput().count("is no radius or angle"), 3)
        vtkSVORenderPass.SetLightSize(1.0, None)
        self.assertEqual(vtkSVORenderPass.GetLightSize(None), 0.0)

    def test_few_samples_that_are_filtered_are_nearer_to_many(self):
        self.soften()
        self.svo.SetShadowTechniqueToShadowRays()
        # Penumbras are a few pixels wide here, where there is little to be taken from around.
        for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
            backend()
            for occlusion, share in (False, 0.75), (True, 0.5):
                self.svo.SetAmbientOcclusion(occlusion)
                self.svo.SetFilterLightSamples(False)
                self.svo.SetMaximumLightSamples(512)
                truth = self.picture()
                self.svo.SetMaximumLightSamples(4)
                off = numpy.sqrt(((self.picture() - truth) ** 2).mean())
                self.svo.SetFilterLightSamples(True)
                filtered = numpy.sqrt(((self.picture() - truth) ** 2).mean())
                print(self.svo.GetBackend(), "occlusion" if occlusion else "soft light", off, filtered)
                self.assertLess(filtered, share * off)

    def test_several_samples_a_pixel_show_no_more_grain(self):
        self.svo.SetAmbientOcclusion(True)
        off = []
        for count in (0, 8):
            self.window.SetMultiSamples(count)
            self.svo.SetMaximumLightSamples(512)
            truth = self.picture()
            self.svo.SetMaximumLightSamples(1)
            off.append(numpy.sqrt(((self.picture() - truth) ** 2).mean()))
        print("one sample of occlusion, without and with multisampling", off)
        self.assertLess(off[1], 1.5 * off[0])

    def test_more_samples_are_nearer_to_many(self):
        self.soften()
        self.svo.SetFilterLightSamples(False)
        self.svo.SetMaximumLightSamples(1024)
        truth = self.picture()
        off = []
        for samples in (1, 8, 64):
            self.svo.SetMaximumLightSamples(samples)
            off.append(numpy.sqrt(((self.picture() - truth) ** 2).mean()))
            self.assertEqual(self.svo.GetNumberOfLightSamples(), samples)
        self.assertGreater(off[0], 2.0 * off[1])
        self.assertGreater(off[1], 2.0 * off[2])

    def test_an_interactive_frame_has_few_and_what_it_shows_is_refined(self):
        self.soften()
        self.svo.SetMaximumLightSamples(32)
        straight = self.picture()
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        few = self.picture()
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(self.refine(), [4, 8, 16])
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        self.assertFalse((few == straight).all())
        self.assertTrue((self.shown() == straight).all())
        self.assertFalse(self.svo.Refine())
        # While somebody interacts it stays at what it is, and nothing is said to go on.
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.assertFalse(self.svo.Refine())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertTrue(self.svo.Refine())
        self.renderer.RemoveAllViewProps()
        self.window.Render()
        self.assertFalse(self.svo.Refine())  # nothing is left to be seen
        self.renderer.AddActor(self.ball)
        self.renderer.AddActor(self.ground)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.assertTrue((self.picture() == straight).all())
        # What is refined stays, whoever asks for a frame with rays as far apart.
        self.svo.AutoAdjustSampleDistancesOff()
        self.window.SetDesiredUpdateRate(10.0)
        self.assertTrue((self.picture() == straight).all())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)

    def test_what_is_around_begins_with_one_sample(self):
        self.svo.SetAmbientOcclusion(True)
        self.svo.SetMaximumLightSamples(8)
        straight = self.picture()
        self.ball.SetPosition(0.5, 0.0, 0.0)
        for filtered, first in (True, 1), (False, 4):
            self.svo.SetFilterLightSamples(filtered)
            self.ball.SetPosition(0.5 - self.ball.GetPosition()[0], 0.0, 0.0)
            self.window.SetDesiredUpdateRate(10.0)
            self.window.Render()
            self.assertEqual(self.svo.GetNumberOfLightSamples(), first)
            self.window.SetDesiredUpdateRate(0.0001)
            self.refine()
            self.assertEqual(self.svo.GetNumberOfLightSamples(), 8)
            if filtered:
                self.assertTrue((self.shown() == straight).all())

    def test_an_error_ends_it(self):
        self.soften()
        self.svo.SetMaximumLightSamples(4096)
        self.svo.SetLightError(1.0)
        found = self.picture()
        count = self.svo.GetNumberOfLightSamples()
        self.assertLess(count, 4096)
        self.assertGreater(count, 4)
        self.svo.SetLightError(0.0)
        self.svo.SetMaximumLightSamples(count)
        self.assertTrue((self.picture() == found).all())
        self.svo.SetMaximumLightSamples(1024)
        truth = self.picture()
        hit = truth.sum(axis=1) > 0
        self.assertLess(numpy.sqrt(((found - truth)[hit] ** 2).mean()), 1.0)

    def test_who_listens_hears_of_samples_and_ends_them(self):
        self.soften()
        self.ground.SetPosition(0.0, 0.0, -0.01)  # else what begins is the picture before
        straight = self.picture()
        heard, told, backends, until, change = [], [], [], [2.0], []

        @calldata_type(VTK_DOUBLE)
        def hear(caller, event, amount):
            heard.append(amount)
            told.append((amount, self.svo.GetNumberOfLightSamples() / self.svo.GetMaximumLightSamples()))
            backends.append(self.svo.GetActiveBackend())
            if change:
                change.pop()()
            if amount >= until[0]:
                self.window.SetAbortRender(True)

        self.svo.AddObserver("ProgressEvent", hear)
        for traced in True, False:
            for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
                vtkSVORenderPass.SetUseSVO(traced, self.ground)
                backend()
                heard.clear()
                self.ball.SetPosition(0.5, 0.0, 0.0)
                other = self.picture()
                self.assertEqual(heard, [0.125, 0.25, 0.5])
                self.assertEqual(set(backends[-3:]), {self.svo.GetBackend()})
                # The next Render() goes on where this one ended.
                heard.clear()
                until[0] = 0.25
                self.ball.SetPosition(0.0, 0.0, 0.0)
                self.picture()
                self.assertEqual(heard, [0.125, 0.25])
                self.assertEqual(self.svo.GetNumberOfLightSamples(), 8)
                until[0] = 2.0
                same = self.picture()
                self.assertEqual(heard, [0.125, 0.25, 0.25, 0.5])
                self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
                if traced and self.svo.GetActiveBackend() == self.svo.BACKEND_CPU:
                    self.assertTrue((same == straight).all())
                # What observers change is drawn as they have left it.
                change.append(lambda: self.ball.SetPosition(0.5, 0.0, 0.0))
                self.ball.SetPosition(0.2, 0.0, 0.0)
                self.assertTrue((self.picture() == other).all())
        # So is an abort of the window's.
        self.svo.RemoveObservers("ProgressEvent")
        asked = []

        def abort(caller, event):
            asked.append(self.svo.GetNumberOfLightSamples())
            self.window.SetAbortRender(True)

        self.ball.SetPosition(0.1, 0.0, 0.0)
        self.window.AddObserver("AbortCheckEvent", abort)
        time.sleep(0.3)  # windows ask five times a second
        self.window.Render()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.assertGreaterEqual(len(asked), 1)
        self.window.RemoveObservers("AbortCheckEvent")
        self.window.Render()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        # An error ends it as soon as it does without anybody who listens.
        self.svo.SetMaximumLightSamples(4096)
        self.svo.SetLightError(1.0)
        self.svo.SetBackendToCPU()
        alone = self.picture()
        count = self.svo.GetNumberOfLightSamples()
        self.svo.AddObserver("ProgressEvent", hear)
        heard.clear()
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.picture()
        self.ball.SetPosition(0.1, 0.0, 0.0)
        self.assertTrue((self.picture() == alone).all())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), count)
        self.assertGreater(len(heard), 2)
        for amount, share in told:
            self.assertEqual(amount, share)
        self.assertEqual(self.said.GetOutput(), "")

    def test_steps_without_any_light(self):
        self.renderer.RemoveAllLights()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.svo.SetAmbientOcclusion(True)
        for property in self.ball.GetProperty(), self.ground.GetProperty():
            property.SetAmbient(0.3)
        for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
            backend()
            self.ball.SetPosition(0.5, 0.0, 0.0)
            alone = self.picture()
            self.assertGreater(alone.max(), 0)
            self.ball.SetPosition(0.0, 0.0, 0.0)
            self.picture()
            lights = []
            self.svo.AddObserver("ProgressEvent",
                                 lambda *_: lights.append(self.renderer.GetLights().GetNumberOfItems()))
            self.ball.SetPosition(0.5, 0.0, 0.0)
            self.assertTrue((self.picture() == alone).all())
            self.assertGreater(len(lights), 1)
            self.assertEqual(max(lights), 0)
            self.svo.RemoveObservers("ProgressEvent")

    def test_who_receives_may_change_between_steps(self):
        self.soften()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.picture()
        vtkSVORenderPass.SetUseSVO(True, self.ground)
        traced = self.picture()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.ball.SetPosition(0.5, 0.0, 0.0)
        shadowed = self.picture()
        vtkSVORenderPass.SetReceiveShadow(False, self.ground)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.picture()
        change = [lambda: vtkSVORenderPass.SetReceiveShadow(True, self.ground)]
        self.svo.AddObserver("ProgressEvent", lambda *_: change and change.pop()())
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.assertTrue((self.picture() == shadowed).all())
        self.assertEqual(change, [])
        self.ball.SetPosition(0.0, 0.0, 0.0)
        vtkSVORenderPass.SetUseSVO(True, self.ground)
        self.assertTrue((self.picture() == traced).all())

    def test_an_interactor_refines_while_it_has_nothing_else_to_do(self):
        self.window.SetOffScreenRendering(False)
        interactor = vtkRenderWindowInteractor()
        interactor.SetRenderWindow(self.window)
        interactor.Initialize()
        self.soften()
        self.svo.SetMaximumLightSamples(32)
        self.svo.AddObserver("ProgressEvent", lambda *_: None)  # who listens does not make it wait
        self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        done = []
        waited = interactor.CreateRepeatingTimer(50)

        def look(caller, event):
            done.append(self.svo.GetNumberOfLightSamples())
            if done[-1] == 32 or len(done) > 400:
                interactor.TerminateApp()

        interactor.AddObserver("TimerEvent", look)
        interactor.Start()
        interactor.DestroyTimer(waited)
        self.assertEqual(done[-1], 32)
        self.assertFalse(self.svo.Refine())

    def test_ambient_occlusion_needs_no_light_set_up(self):
        self.renderer.RemoveAllLights()
        self.renderer.AutomaticLightCreationOn()
        self.svo.SetShadowTechniqueToNone()
        plain = self.picture()
        self.svo.SetAmbientOcclusion(True)
        closed = self.picture()
        self.assertEqual(self.said.GetOutput(), "")
        # Below the ball it is dark, far from it as before.
        darker = (plain - closed).reshape(SIZE[1], SIZE[0], 3)[:, :, 0]
        self.assertGreaterEqual(darker.min(), 0)
        self.assertGreater(darker.max(), 60)
        self.svo.SetAmbientOcclusionStrength(0.0)
        self.assertTrue((self.picture() == plain).all())
        self.svo.SetAmbientOcclusionStrength(1.0)
        self.svo.SetAmbientOcclusionOfAllLight(False)
        self.assertTrue((self.picture() == plain).all())  # materials have no ambient part
        self.ball.GetProperty().SetAmbient(1.0)
        self.ground.GetProperty().SetAmbient(1.0)
        darkened = self.picture()
        self.svo.SetAmbientOcclusion(False)
        self.assertGreater((self.picture() - darkened).max(), 60)

    def test_a_sky_lights_without_lights(self):
        self.svo.SetSkyLight(True)
        self.svo.SetSkyColor(1.0, 1.0, 1.0)
        self.svo.SetGroundColor(1.0, 1.0, 1.0)
        self.light.SetSwitch(False)
        sky = self.picture().reshape(SIZE[1], SIZE[0], 3)
        self.assertGreater(sky[:, :, 0].max(), 240)  # open ground
        self.assertLess(sky[sky.sum(axis=2) > 0].min(), 60)  # below the ball
        self.svo.SetSkyStrength(0.5)
        self.assertLess(abs(self.picture().max() - 128), 3)
        self.svo.SetSkyColor(float("nan"), 1.0, 1.0)
        self.assertEqual(self.svo.GetSkyColor(), (1.0, 1.0, 1.0))
        self.assertEqual(self.said.GetOutput().count("SkyColor stays 1 1 1"), 1)
        self.svo.SetSkyUp(0.0, 0.0, 1.0)
        self.svo.SetGroundColor(0.0, 0.0, 0.0)
        self.svo.SetSkyColor(0.0, 0.0, 2.0)
        blue = self.picture()
        self.assertEqual(blue[:, :2].max(), 0)
        self.assertGreater(blue[:, 2].max(), 150)
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)

    def test_what_changes_changes_what_is_closed_off(self):
        self.svo.SetAmbientOcclusion(True)
        self.svo.SetSkyLight(True)
        self.soften()
        self.picture()
        changes = [
            lambda: self.ball.SetPosition(1.0, 1.0, 0.3), lambda: self.light.SetPosition(2.0, 4.0, 5.0),
            lambda: self.soften(0.3), lambda: self.svo.SetAmbientOcclusionDistance(0.6),
            lambda: self.ball.SetScale(0.7), lambda: vtkSVORenderPass.SetCastShadow(False, self.ball)]
        for number, change in enumerate(changes):
            before = self.shown()
            change()
            kept = self.picture()
            self.assertFalse((kept == before).all(), number)
            fresh = vtkSVORenderPass()
            fresh.SetBackendToCPU()
            fresh.SetAmbientOcclusion(True)
            fresh.SetSkyLight(True)
            fresh.SetAmbientOcclusionDistance(self.svo.GetAmbientOcclusionDistance())
            self.renderer.SetPass(fresh)
            self.assertTrue((self.picture() == kept).all(), number)
            self.renderer.SetPass(self.svo)
            self.picture()

    def test_what_vtk_draws_is_soft_as_well(self):
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        pictures = []
        for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
            backend()
            self.soften(0.0)
            hard = self.picture()
            self.soften()
            pictures.append(self.picture())
            self.assertGreater(numpy.abs(pictures[-1] - hard).max(), 50)
        self.assertLess(numpy.abs(pictures[0] - pictures[1]).mean(), 0.5)
        self.assertEqual(self.said.GetOutput(), "")

    def test_what_does_not_fit_is_said(self):
        self.soften()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.svo.SetSkyLight(True)
        self.picture()
        self.assertEqual(self.said.GetOutput(), "")
        self.svo.SetBackendToOpenGL()
        self.picture()
        self.assertEqual(self.svo.GetNumberOfLightsWithShadowRays(), 1)
        self.assertEqual(self.said.GetOutput(), "")
        self.svo.SetGPUMemoryLimit(self.svo.GetGPUMemory() - 1)
        self.picture()
        self.picture()
        self.assertEqual(self.said.GetOutput().count("samples of the light have found does not fit"), 1)

    def test_the_sky_is_turned_as_vtk_turns_environments(self):
        sky = numpy.full((64, 128, 3), 0.1, numpy.float32)
        sky[45:55, 20:35] = 6.0, 4.0, 1.0
        sky[10:20, 90:100] = 0.5, 1.0, 4.0
        image = vtkImageData()
        image.SetDimensions(128, 64, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(sky.reshape(-1, 3), deep=True))
        texture = vtkTexture()
        texture.SetInputData(image)
        texture.SetColorModeToDirectScalars()
        texture.MipmapOn()
        texture.InterpolateOn()
        self.renderer.RemoveActor(self.ground)
        self.renderer.RemoveAllLights()
        self.svo.SetSkyFromEnvironment(True)
        self.svo.SetSkyLight(True)
        self.picture()
        self.assertEqual(self.said.GetOutput().count("no environment texture"), 1)
        self.renderer.SetEnvironmentTexture(texture)
        look = self.ball.GetProperty()
        for up, right in ((0, 1, 0), (1, 0, 0)), ((0, 0, 1), (0, 1, 0)):
            self.renderer.SetEnvironmentUp(up)
            self.renderer.SetEnvironmentRight(right)
            self.renderer.SetPass(None)
            self.renderer.UseImageBasedLightingOn()
            look.SetInterpolationToPBR()
            look.SetMetallic(0.0)
            look.SetRoughness(1.0)
            expected = 255.0 * (self.picture() / 255.0) ** 2.2
            self.renderer.UseImageBasedLightingOff()
            look.SetInterpolationToGouraud()
            self.renderer.SetPass(self.svo)
            for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
                backend()
                found = self.picture()
                # VTK adds a faint gloss, and its irradiance has large texels.
                self.assertLess(numpy.abs(found - expected).mean(), 0.1 * expected.mean())
                self.assertGreater(numpy.corrcoef(found.ravel(), expected.ravel())[0, 1], 0.98)
        self.assertEqual(self.said.GetOutput().count("Warn"), 1)

    def test_the_error_of_samples_is_known(self):
        self.soften()
        self.svo.SetFilterLightSamples(False)
        said = []
        for samples in 4, 64:
            self.svo.SetMaximumLightSamples(samples)
            self.picture()
            said.append(self.svo.GetAcceptedLightError())
        self.assertGreater(said[0], 2.0 * said[1])
        self.assertGreater(said[1], 0.0)
        self.soften(0.0)
        self.picture()
        self.assertEqual(self.svo.GetAcceptedLightError(), 0.0)

    def test_with_opengl_it_is_refined_to_the_same_bits(self):
        self.soften()
        self.svo.SetBackendToOpenGL()
        self.svo.SetAmbientOcclusion(True)  # by rays, and so lights are
        self.svo.SetSkyLight(True)
        straight = self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.ball.SetPosition(0.0, 0.0, 0.0)
        few = self.picture()
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(self.refine(), [4, 8, 16])
        self.assertFalse((few == straight).all())
        self.assertTrue((self.shown() == straight).all())
        # What VTK draws and nothing casts: its samples are taken anew where it has moved.
        vtkSVORenderPass.SetCastShadow(False, self.ball)
        self.picture()
        self.ball.SetPosition(0.3, 0.0, 0.0)
        moved = self.picture()
        self.renderer.SetPass(None)
        self.window.Finalize()
        self.renderer.SetPass(self.svo)
        self.assertTrue((self.picture() == moved).all())
        self.assertEqual(self.said.GetOutput(), "")


if __name__ == "__main__":
    unittest.main()
