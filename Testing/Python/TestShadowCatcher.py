"""Surfaces of which the shadows alone are seen: the background is darkened by what shadows take from a white surface in
their place."""

import unittest

import numpy
import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight
import ball_on_ground
from backend import new_pass, traced
from vtksvo import vtkSVORenderPass

SIZE = (300, 200)


class TestShadowCatcher(unittest.TestCase):
    def setUp(self):
        ball_on_ground.build(self, SIZE, new_pass())
        vtkSVORenderPass.SetUseSVO(False, self.ground)  # so that nothing but the look differs
        self.add_light((3.0, -2.0, 5.0), (0.5, 0.5, 0.5))  # no sum of lights may exceed 1

    def tearDown(self):
        self.window.Finalize()

    def add_light(self, position, color):
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(*position)
        light.SetDiffuseColor(*color)
        self.renderer.AddLight(light)
        return light

    def pixels(self):
        """Rows from below, columns, red, green, blue and alpha from 0 to 1."""
        self.window.Render()
        width, height = SIZE
        pixels = vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
        return vtk_to_numpy(pixels).reshape(height, width, 4) / 255.0

    def catch(self, on=True):
        vtkSVORenderPass.SetShadowCatcher(on, self.ground)

    def expected_share(self):
        """The share of its light that each pixel of the white ground keeps, and where the ball is not."""
        self.catch(False)
        shadowed = self.pixels()[..., 0]
        self.svo.SetShadowIntensity(0.0)
        lit = self.pixels()[..., 0]
        self.ball.VisibilityOff()
        empty = self.pixels()[..., 0]
        self.ball.VisibilityOn()
        self.ball.GetProperty().LightingOff()
        self.ball.GetProperty().SetColor(0.0, 0.0, 0.0)
        free = self.pixels()[..., 0] == empty
        self.ball.GetProperty().LightingOn()
        self.ball.GetProperty().SetColor(1.0, 1.0, 1.0)
        self.svo.SetShadowIntensity(1.0)
        return shadowed / numpy.maximum(lit, 1e-3), free

    def check(self, tolerance=0.02):
        """The background keeps as much as the white ground does; shadows' edges differ in nothing."""
        share, free = self.expected_share()
        self.assertGreater((free & (share < 0.9)).sum(), 300)
        self.renderer.RemoveActor(self.ball)
        self.renderer.RemoveActor(self.ground)
        background = self.pixels()[..., :3]
        self.renderer.AddActor(self.ball)
        self.renderer.AddActor(self.ground)
        self.catch()
        caught = self.pixels()[..., :3]
        off = abs(caught - background * share[..., None]).max(axis=2)
        self.assertLess(off[free].max(), tolerance)
        lit = free & (share > 0.999)
        self.assertEqual(abs(caught - background)[lit].max(), 0.0)
        return caught

    def test_one_light(self):
        self.renderer.SetBackground(0.8, 0.9, 1.0)
        self.check()

    def test_lights_of_several_kinds(self):
        """Lights that cast nothing count as well: a headlight, and one that was told so."""
        self.renderer.SetBackground(0.8, 0.9, 1.0)
        spot = self.add_light((-3.0, -3.0, 4.0), (0.3, 0.3, 0.3))
        spot.SetPositional(True)
        spot.SetConeAngle(40.0)
        vtkSVORenderPass.SetCastShadow(False, self.add_light((0.0, 3.0, 4.0), (0.2, 0.2, 0.2)))
        head = vtkLight()
        head.SetLightTypeToHeadlight()
        head.SetDiffuseColor(0.1, 0.1, 0.1)
        self.renderer.AddLight(head)
        self.check()

    def test_gradient_and_depth_peeling(self):
        self.renderer.SetBackground(1.0, 1.0, 0.9)
        self.renderer.SetBackground2(0.2, 0.3, 0.8)
        self.renderer.GradientBackgroundOn()
        plain = self.check()
        self.renderer.UseDepthPeelingOn()
        self.assertLess(abs(self.check() - plain).max(), 0.02)

    def test_properties_of_the_surface_do_not_matter(self):
        self.renderer.SetBackground(0.8, 0.9, 1.0)
        plain = self.check()
        look = self.ground.GetProperty()
        look.SetColor(0.2, 0.7, 0.1)
        look.SetAmbient(0.4)
        look.SetSpecular(0.8)
        self.assertEqual(abs(self.pixels()[..., :3] - plain).max(), 0.0)
        look.SetOpacity(0.5)
        half = self.pixels()[..., :3]
        dark = (plain < 0.05).all(axis=2)
        self.assertLess(abs(half[dark] - (plain[dark] + [0.8, 0.9, 1.0]) / 2)[
            (half[dark] > 0.2).all(axis=1)].max(), 0.02)
        look.SetOpacity(1.0)
        look.SetInterpolationToPBR()
        self.assertIn("physically based", vtkSVORenderPass.GetReason(self.ground))
        self.assertEqual(abs(self.pixels()[5, 5, :3] - [0.8, 0.9, 1.0]).max() > 0.01, False)

    def test_nothing_to_catch(self):
        """No shadows, no lights that cast, nothing that casts: nothing is seen of it."""
        self.renderer.SetBackground(0.5, 0.6, 0.7)
        self.renderer.RemoveActor(self.ball)
        self.renderer.RemoveActor(self.ground)
        background = self.pixels()
        self.renderer.AddActor(self.ground)
        self.catch()
        self.assertTrue((self.pixels() == background).all())
        self.renderer.AddActor(self.ball)
        self.assertFalse((self.pixels() == background).all())
        self.renderer.RemoveActor(self.ground)
        ball = self.pixels()
        self.renderer.AddActor(self.ground)
        self.assertFalse((self.pixels() == ball).all())
        self.svo.SetShadowTechniqueToNone()
        self.assertTrue((self.pixels() == ball).all())
        self.svo.SetShadowTechniqueToShadowBuffer()
        vtkSVORenderPass.SetReceiveShadow(False, self.ground)
        self.assertTrue((self.pixels() == ball).all())
        vtkSVORenderPass.SetReceiveShadow(True, self.ground)
        vtkSVORenderPass.SetCastShadow(False, self.ball)
        self.assertTrue((self.pixels() == ball).all())

    def test_what_is_below_is_seen(self):
        self.ball.SetPosition(0.0, 0.0, -3.0)
        self.renderer.SetBackground(0.5, 0.6, 0.7)
        self.renderer.RemoveActor(self.ground)
        alone = self.pixels()
        self.renderer.AddActor(self.ground)
        self.catch()
        self.assertTrue((self.pixels() == alone).all())

    def test_clear_background(self):
        """With depth peeling: VTK's other way of drawing translucent surfaces gets their alpha wrong."""
        self.window.SetAlphaBitPlanes(1)
        self.renderer.SetBackground(0.0, 0.0, 0.0)
        self.renderer.SetBackgroundAlpha(0.0)
        self.renderer.UseDepthPeelingOn()
        self.add_light((-3.0, -3.0, 4.0), (0.3, 0.3, 0.3))
        share, free = self.expected_share()
        self.catch()
        picture = self.pixels()
        self.assertEqual(picture[..., :3][free].max(), 0.0)
        self.assertLess(abs(picture[..., 3] - (1.0 - share))[free].max(), 0.02)

    def test_answers(self):
        self.assertFalse(vtkSVORenderPass.GetShadowCatcher(self.ground))
        self.catch()
        self.assertTrue(vtkSVORenderPass.GetShadowCatcher(self.ground))
        self.assertTrue(self.ground.GetForceTranslucent())
        self.assertFalse(vtkSVORenderPass.GetCastShadow(self.ground))
        self.assertEqual(vtkSVORenderPass.GetReason(self.ground),
                         "Left to the rasteriser: it is a shadow catcher. Casts no shadow: it is a shadow catcher.")
        self.catch(False)
        self.assertFalse(vtkSVORenderPass.GetShadowCatcher(self.ground))
        self.assertFalse(self.ground.GetForceTranslucent())
        self.assertEqual(vtkSVORenderPass.GetReason(self.ground), "Left to the rasteriser: it was told so.")
        vtkSVORenderPass.SetShadowCatcher(True, None)
        self.assertFalse(vtkSVORenderPass.GetShadowCatcher(None))

    def test_attached(self):
        """To a renderer whose surfaces were not chosen: they are traced and cast if everything is."""
        self.renderer.SetPass(None)
        self.ground.GetPropertyKeys().Remove(vtkSVORenderPass.USE_SVO())
        plain = self.pixels()
        self.svo.Attach(self.renderer)
        self.assertTrue((self.pixels() == plain).all())
        not_chosen = ("Left to the rasteriser: it was not chosen with SetUseSVO. "
                      "Casts no shadow: it was not chosen with SetUseSVO.")
        self.assertEqual(self.svo.GetReasonInLastFrame(self.ball), not_chosen)
        self.svo.ShadowsForEverythingOn()
        shadowed = self.pixels()
        self.assertEqual(self.svo.GetNumberOfTracedActors(), traced(2))
        self.assertEqual(self.svo.GetReasonInLastFrame(self.ball), "")
        self.assertGreater((shadowed[..., 0] < plain[..., 0] - 0.1).sum(), 300)
        self.assertLess((shadowed - plain).max(), 1.5 / 255)  # traced colours are rounded elsewhere
        self.catch()
        self.renderer.SetBackground(0.8, 0.9, 1.0)
        self.assertGreater((self.pixels()[..., 2] == 0.0).sum(), 300)
        self.assertEqual(self.svo.GetReasonInLastFrame(self.ground),
                         "Left to the rasteriser: it is a shadow catcher. Casts no shadow: it is a shadow catcher.")
        self.catch(False)
        self.renderer.SetBackground(0.0, 0.0, 0.0)
        self.svo.Detach(self.renderer)
        self.assertTrue((self.pixels() == plain).all())

    def test_a_mapper_of_two_actors(self):
        """One shows the ground, the other its shadows alone: the shader is the same."""
        other = vtkActor()
        other.SetMapper(self.ground.GetMapper())
        other.SetPosition(0.0, 0.0, -1.0)
        self.renderer.SetBackground(0.5, 0.6, 0.7)
        self.renderer.AddActor(other)
        self.catch(False)
        plain = self.pixels()
        vtkSVORenderPass.SetShadowCatcher(True, other)
        self.assertTrue((self.pixels() == plain).all())
        self.ground.VisibilityOff()
        self.assertFalse((self.pixels() == plain).all())


if __name__ == "__main__":
    unittest.main()
