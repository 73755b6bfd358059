"""Lights with a size and ambient occlusion: what settings do, what is said. TestLightSteps: how a picture is refined."""

import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture
from soft_light import SIZE, SIZE_OF_LIGHT, SoftLightTest
from vtksvo import vtkSVORenderPass


class TestSoftLight(SoftLightTest):
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


if __name__ == "__main__":
    unittest.main()
