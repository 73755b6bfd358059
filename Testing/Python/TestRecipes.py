"""The recipes of the documentation, as they stand there, and classes derived in Python."""

import contextlib
import importlib.util
import os
import re
import tempfile
import unittest

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
import vtksvo
from backend import OPENGL, choose, new_pass, rasterized, traced
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingLOD import vtkLODActor, vtkQuadricLODActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkDataSetMapper, vtkFollower, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow)

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Documentation", "Recipes.md")


def recipe(heading):
    with open(PAGE, encoding="utf-8") as page:
        return re.search(rf"^## {heading}\n.*?^```python\n(.*?)^```", page.read(), re.M | re.S).group(1)


def brightness(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    colors = reader.GetOutput().GetPointData().GetScalars()
    size = colors.GetNumberOfComponents()
    values = bytes(memoryview(colors))
    return [sum(values[i:i + 3]) / 3 for i in range(0, len(values), size)]


class TestRecipes(unittest.TestCase):
    def run_recipe(self, heading, package):
        if not importlib.util.find_spec(package):
            self.skipTest(f"{package} is not installed")
        os.environ.setdefault("ETS_TOOLKIT", "null")
        code, made = recipe(heading), "svo = vtksvo.vtkSVORenderPass()"
        self.assertIn(made, code)
        pictures = []
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            for without in "", "; svo.SetShadowTechniqueToNone()":
                names = {"choose": choose}
                text = code.replace(made, made + "; choose(svo)" + without)
                exec(compile(text, PAGE, "exec"), names)
                pictures.append(brightness(package + ".png"))
                self.assertEqual(names["svo"].GetNumberOfTracedActors(), traced(2))
                self.assertEqual(names["svo"].GetNumberOfRasterizedActors(), rasterized(0, of=2))
                self.assertIn(": casts shadows", names["svo"].GetCastingLights())
        darker = sum(lit - dark > 20 for dark, lit in zip(*pictures))
        print(heading, darker, "pixels in the shadow")
        self.assertGreater(darker, 500)

    def test_vedo(self):
        self.run_recipe("vedo", "vedo")

    def test_mayavi(self):
        self.run_recipe("Mayavi", "mayavi")

    def test_pyvista(self):
        self.run_recipe("PyVista", "pyvista")

    def test_classes_of_python(self):
        class Actor(vtkActor):
            def __init__(self, source, mapper):
                self.mapper = mapper
                mapper.SetInputConnection(source.GetOutputPort())
                self.SetMapper(mapper)

        class Label(vtkFollower):
            pass

        class Coarse(vtkLODActor):
            pass

        class Coarser(vtkQuadricLODActor):
            pass

        class Mapper(vtkDataSetMapper):
            pass

        ground = vtkPlaneSource()
        ground.SetOrigin(-3, -3, 0)
        ground.SetPoint1(3, -3, 0)
        ground.SetPoint2(-3, 3, 0)
        ball = vtkSphereSource()
        ball.SetCenter(0, 0, 1)
        renderer = vtkRenderer()
        actors = [Actor(ground, vtkPolyDataMapper()), Actor(ball, Mapper()), Label(), Coarse()]
        if not OPENGL:  # VTK 9.1 crashes where it draws one, without the pass, too
            actors.append(Coarser())
        for place, actor in enumerate(actors[2:]):
            actor.SetMapper(vtkPolyDataMapper())
            actor.GetMapper().SetInputConnection(ball.GetOutputPort())
            actor.SetPosition(place + 1, 0, 0)
        for actor in actors:
            renderer.AddActor(actor)
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(3, -2, 5)
        renderer.AddLight(light)
        svo = new_pass()
        renderer.SetPass(svo)
        window = vtkRenderWindow()
        window.SetOffScreenRendering(True)
        window.AddRenderer(renderer)
        window.Render()
        self.assertEqual(svo.GetNumberOfTracedActors(), traced(len(actors)))
        for actor in actors:
            self.assertTrue(svo.GetCastShadow(actor))
            self.assertEqual(svo.GetReason(actor), "")
        window.Finalize()


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # of the packages
