"""A ball that touches a large ground, in a renderer with the pass, as several tests have it."""

from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow


def actor_of(source):
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputConnection(source.GetOutputPort())
    actor.SetMapper(mapper)
    return actor


def build(test, size, svo):
    """Gives the test case its `ball`, `ground`, `renderer`, `window` and `svo`."""
    ball, ground = vtkSphereSource(), vtkPlaneSource()
    ball.SetCenter(0.0, 0.0, 1.0)
    ball.SetThetaResolution(64)
    ball.SetPhiResolution(64)
    ground.SetOrigin(-20.0, -20.0, 0.0)
    ground.SetPoint1(20.0, -20.0, 0.0)
    ground.SetPoint2(-20.0, 20.0, 0.0)
    test.ball, test.ground = actor_of(ball), actor_of(ground)
    test.renderer, test.window, test.svo = vtkRenderer(), vtkRenderWindow(), svo
    test.window.SetMultiSamples(0)
    test.window.SetSize(*size)
    test.window.AddRenderer(test.renderer)
    test.renderer.AddActor(test.ball)
    test.renderer.AddActor(test.ground)
    test.renderer.SetPass(svo)
    camera = test.renderer.GetActiveCamera()
    camera.SetPosition(5.0, -6.0, 5.0)
    camera.SetFocalPoint(0.0, 0.0, 0.5)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(25.0)
    test.renderer.ResetCameraClippingRange()
