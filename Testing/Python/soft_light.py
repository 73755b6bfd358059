"""A ball on a ground under a light that may have a size, as several tests have it."""

import unittest

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
import vtkmodules.vtkRenderingUI
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkLight
import ball_on_ground
from vtksvo import vtkSVORenderPass

SIZE = (160, 120)
SIZE_OF_LIGHT = 1.0


class SoftLightTest(unittest.TestCase):
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

    def picture(self):
        self.window.Render()
        return self.shown()

    def shown(self):
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, SIZE[0] - 1, SIZE[1] - 1, 0, pixels, 0)
        return vtk_to_numpy(pixels).astype(int)

    def soften(self, size=SIZE_OF_LIGHT):
        vtkSVORenderPass.SetLightSize(size, self.light)
