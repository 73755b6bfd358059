"""Who culls front faces looks into a body, and so does the light."""

import unittest

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
import vtksvo
from backend import new_pass
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

CORNERS = [(x, y, z) for z in (0.0, 2.0) for y in (-1.5, 1.5) for x in (-1.5, 1.5)]
WALLS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # outwards
EYES = [(0.0, -7.0, 5.0), (5.0, -5.0, 3.0), (-1.0, 6.0, 6.0)]


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def room(walls):
    mesh, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for corner in CORNERS:
        points.InsertNextPoint(corner)
    for wall in walls:
        cells.InsertNextCell(4, wall)
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


class TestCulledFaces(unittest.TestCase):
    def setUp(self):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(240, 200)
        self.renderer = vtkRenderer()
        self.window.AddRenderer(self.renderer)
        self.svo = new_pass()
        self.renderer.SetPass(self.svo)
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(1.0, -2.0, 4.0)
        self.renderer.AddLight(light)
        ball = vtkSphereSource()
        ball.SetCenter(0.2, 0.0, 0.8)
        self.add(ball)
        self.walls = self.add()
        self.walls.GetProperty().FrontfaceCullingOn()
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetViewUp(0.0, 0.0, 1.0)
        self.camera.SetFocalPoint(0.0, 0.0, 0.8)

    def tearDown(self):
        self.window.Finalize()

    def add(self, source=None):
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        if source:
            actor.GetMapper().SetInputConnection(source.GetOutputPort())
        self.renderer.AddActor(actor)
        return actor

    def show(self, walls=WALLS):
        self.walls.GetMapper().SetInputData(room(walls))
        return self.picture()

    def picture(self):
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, 239, 199, 1, pixels, 0)
        return bytes(memoryview(pixels))

    def seen(self):
        """Those whose back the eye sees."""
        side = self.walls.GetMatrix().Determinant()
        place = lambda i: self.walls.GetMatrix().MultiplyPoint(CORNERS[i] + (1.0,))[:3]
        result = []
        for wall in WALLS:
            a, b, c = (place(i) for i in wall[:3])
            towards = minus(self.camera.GetPosition(), a)
            if self.camera.GetParallelProjection():
                towards = minus(self.camera.GetPosition(), self.camera.GetFocalPoint())
            if dot(cross(minus(b, a), minus(c, a)), towards) <= 0.0:
                result.append(wall)
        return result

    def check(self, name):
        walls = self.seen()
        self.assertTrue(0 < len(walls) < len(WALLS), name)
        self.svo.SetShadowTechniqueToNone()
        self.assertEqual(self.show(), self.show(walls), name + ": these are what VTK shows")
        for technique in self.svo.SetShadowTechniqueToShadowRays, self.svo.SetShadowTechniqueToShadowBuffer:
            technique()
            whole, reference = self.show(), self.show(walls)
            others = sum(abs(a - b) > 8 for a, b in zip(whole[::3], reference[::3]))
            self.assertLess(others, 20, name)

    def test_light_enters_where_the_eye_does(self):
        for eye in EYES:
            self.camera.SetPosition(eye)
            self.check(f"from {eye}")
        self.walls.SetScale(-1.0, 1.0, 1.0)
        self.check("mirrored")
        self.walls.SetScale(1.0, 1.0, 1.0)
        self.camera.ParallelProjectionOn()
        self.camera.SetParallelScale(2.5)
        self.check("parallel")

    def test_shadows_follow_the_eye(self):
        self.show()
        for eye in EYES + EYES[:1]:
            self.camera.SetPosition(eye)
            kept = self.picture()
            self.svo = new_pass()
            self.renderer.SetPass(self.svo)
            self.assertEqual(kept, self.picture())

    def test_who_is_told_to_casts_whole(self):
        self.camera.SetPosition(EYES[0])
        light = sum(self.show())
        self.assertEqual(self.svo.GetReason(self.walls), "Left to the rasteriser: it has culled faces.")
        self.svo.SetCastShadow(True, self.walls)
        dark = sum(self.picture())
        print("light", light, "dark", dark)
        self.assertGreater(light, 1.5 * dark)

    def test_surfaces_that_are_no_meshes_cast_whole(self):
        ball = vtkSphere()
        ball.SetRadius(0.8)
        convert = vtksvo.vtkImplicitFunctionToSVO()
        convert.SetImplicitFunction(ball)
        convert.SetModelBounds(-1, 1, -1, 1, -1, 1)
        convert.SetMaximumLevel(6)
        self.walls.GetMapper().SetInputConnection(convert.GetOutputPort())
        self.camera.SetPosition(EYES[0])
        culled = self.picture()
        self.svo.SetCastShadow(True, self.walls)
        self.assertEqual(culled, self.picture())

    def test_culled_back_faces_cast(self):
        ground = vtkPlaneSource()
        ground.SetOrigin(-5.0, -5.0, -0.1)
        ground.SetPoint1(5.0, -5.0, -0.1)
        ground.SetPoint2(-5.0, 5.0, -0.1)
        self.add(ground)
        self.camera.SetPosition(-1.0, 9.0, 6.0)  # the light is behind the room
        self.walls.GetProperty().FrontfaceCullingOff()
        plain = self.show()
        self.walls.GetProperty().BackfaceCullingOn()
        culled = self.picture()
        others = sum(abs(a - b) > 8 for a, b in zip(plain[::3], culled[::3]))
        self.assertLess(others, 20)


if __name__ == "__main__":
    unittest.main()
