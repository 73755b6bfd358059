"""The representation 3D Glyphs: where its actor says that it uses octrees, its copies are traced as ParaView draws
them, and cast."""

import unittest

import paraview.simple as pv
import scene
import vtksvo
from pictures import differing
from vtkmodules.vtkRenderingCore import vtkGlyph3DMapper


def glyph_actor(view):
    """The visible actor of glyphs."""
    props = view.GetRenderer().GetViewProps()
    for i in range(props.GetNumberOfItems()):
        prop = props.GetItemAsObject(i)
        mapper = prop.GetMapper() if hasattr(prop, "GetMapper") else None
        if prop.GetVisibility() and isinstance(mapper, vtkGlyph3DMapper):
            return prop
    return None


class TestGlyphs(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((400, 300))
        scene.add_sun(self.view)
        scene.show(scene.make_ground(), self.view)
        self.points = pv.Sphere(Center=[0, 0, 1.1], Radius=0.7, ThetaResolution=7, PhiResolution=6)
        self.display = scene.show(self.points, self.view, "3D Glyphs")
        self.display.Scaling = 1
        self.display.ScaleFactor = 0.6
        self.display.Orient = 1
        self.display.SelectOrientationVectors = "Normals"
        pv.Render(self.view)
        self.actor = glyph_actor(self.view)

    def tearDown(self):
        pv.ResetSession()

    def test_is_traced_as_it_is_drawn_and_casts(self):
        self.view.SVOShadowTechnique = "None"
        drawn = scene.picture(self.view, "drawn")
        self.assertGreater(differing(drawn, drawn[::-1]), 0.1)  # there is something to see
        vtksvo.vtkSVORenderPass.SetUseSVO(True, self.actor)
        self.assertEqual(vtksvo.vtkSVORenderPass.GetReason(self.actor), "")
        traced = scene.picture(self.view, "traced")
        self.assertLess(differing(drawn, traced), 0.003)
        self.view.SVOShadowTechnique = "Shadow Buffer"
        shadowed = scene.picture(self.view, "shadowed")
        darker = (shadowed.mean(axis=2) < traced.mean(axis=2) - 20).mean()
        self.assertGreater(darker, 0.01)

    def test_follows_its_properties(self):
        vtksvo.vtkSVORenderPass.SetUseSVO(True, self.actor)
        self.view.SVOShadowTechnique = "None"
        before = scene.picture(self.view, "before")
        self.display.ScaleFactor = 1.0
        larger = scene.picture(self.view, "larger")
        self.assertGreater(differing(before, larger), 0.02)
        vtksvo.vtkSVORenderPass.SetUseSVO(False, self.actor)
        self.assertLess(differing(larger, scene.picture(self.view, "larger-drawn")), 0.003)
        vtksvo.vtkSVORenderPass.SetUseSVO(True, self.actor)
        self.points.ThetaResolution = 9
        moved = scene.picture(self.view, "moved")
        vtksvo.vtkSVORenderPass.SetUseSVO(False, self.actor)
        self.assertLess(differing(moved, scene.picture(self.view, "moved-drawn")), 0.003)
        self.assertGreater(differing(moved, larger), 0.02)


scene.load_plugin()
scene.run_tests()
