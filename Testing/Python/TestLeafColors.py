"""Surfaces of images that another array colours: traced as flying edges' mesh is drawn, through the same tables."""

import math
import unittest

import vtksvo
from backend import OPENGL, new_pass
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, makes render windows
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkLookupTable, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkElevationFilter, vtkFlyingEdges3D
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
    vtkWindowToImageFilter)

EDGE = 41


def image():
    """Distances from a ball, a slope and colours."""
    made = vtkImageData()
    made.SetDimensions(EDGE, EDGE, EDGE)
    made.SetOrigin(-1, -1, -1)
    made.SetSpacing([2 / (EDGE - 1)] * 3)
    distance, slope, colors = vtkFloatArray(), vtkFloatArray(), vtkUnsignedCharArray()
    distance.SetName("distance")
    slope.SetName("slope")
    colors.SetName("colors")
    colors.SetNumberOfComponents(3)
    for i in range(made.GetNumberOfPoints()):
        x, y, z = made.GetPoint(i)
        distance.InsertNextValue(math.sqrt(x * x + y * y + z * z) - 0.8)
        slope.InsertNextValue(1.5 + x + 0.3 * z)
        colors.InsertNextTuple3(100 + 90 * x, 100 + 90 * y, 100 + 90 * z)
    made.GetPointData().SetScalars(distance)
    made.GetPointData().AddArray(slope)
    made.GetPointData().AddArray(colors)
    return made


def table(**settings):
    made = vtkLookupTable()
    made.SetNumberOfTableValues(9)
    made.SetTableRange(0.6, 2.1)
    for name, value in settings.items():
        getattr(made, name)(*value)
    made.Build()
    return made


class View:
    """A picture without lighting, so that colours are those of the table."""

    def __init__(self, port, traced, name, colors=None):
        self.mapper, self.actor = vtkPolyDataMapper(), vtkActor()
        self.mapper.SetInputConnection(port)
        if traced:
            self.mapper.SetScalarModeToUseCellFieldData()
        else:
            self.mapper.SetScalarModeToUsePointFieldData()
            self.mapper.SetInterpolateScalarsBeforeMapping(colors is not None)
        self.mapper.SelectColorArray(name)
        if colors:
            self.mapper.SetLookupTable(colors)
            self.mapper.UseLookupTableScalarRangeOn()
        else:
            self.mapper.SetColorModeToDirectScalars()
        self.actor.SetMapper(self.mapper)
        self.actor.GetProperty().LightingOff()
        self.renderer, self.window = vtkRenderer(), vtkRenderWindow()
        self.renderer.AddActor(self.actor)
        self.renderer.SetBackground(0.1, 0.1, 0.1)
        if traced:
            self.tracer = new_pass()
            self.tracer.SetShadowTechniqueToNone()
            self.renderer.SetPass(self.tracer)
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(200, 200)
        self.window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(2, -3, 1.5)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewUp(0, 0, 1)

    def pixels(self):
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        flat = bytes(memoryview(grab.GetOutput().GetPointData().GetScalars()))
        return [flat[i:i + 3] for i in range(0, len(flat), 3)]


def differing(a, b, most):
    return sum(max(abs(x - y) for x, y in zip(p, q)) > most for p, q in zip(a, b))


class LeafColors(unittest.TestCase):
    def setUp(self):
        self.image = image()
        self.edges = vtkFlyingEdges3D()
        self.edges.SetInputData(self.image)
        self.edges.SetValue(0, 0.0)
        self.edges.InterpolateAttributesOn()
        self.views = []

    def tearDown(self):
        for view in self.views:
            view.window.Finalize()

    def view(self, *arguments):
        self.views.append(View(*arguments))
        return self.views[-1]

    def octree(self, name, level=8):
        made = vtksvo.vtkImageToSVO()
        made.SetInputData(self.image)
        made.SetColorArrayName(name)
        made.SetMaximumLevel(level)
        self.filter = made
        return made.GetOutputPort()

    def check(self, name, colors, most=0, share=0.05):
        drawn = self.view(self.edges.GetOutputPort(), False, name, colors).pixels()
        traced = self.view(self.octree(name), True, name, colors)
        pixels = traced.pixels()
        self.assertEqual(traced.tracer.GetNumberOfRasterizedActors(), 0)
        surface = sum(p != drawn[0] for p in drawn)
        self.assertGreater(surface, 8000)
        self.assertGreater(len(set(drawn)), 5)
        # Borders between colours, and the outline.
        self.assertLess(differing(drawn, pixels, most), share * surface)
        return traced, pixels

    def test_array_that_a_filter_added_to_the_mesh(self):
        slope = vtkElevationFilter()
        slope.SetInputConnection(self.octree("slope"))
        slope.SetLowPoint(-1, 0, 0)
        slope.SetHighPoint(1, 0, 0)
        traced = self.view(slope.GetOutputPort(), True, "Elevation", table(SetTableRange=(0, 1)))
        traced.mapper.SetScalarModeToUsePointFieldData()
        shown = traced.pixels()
        self.assertEqual(traced.tracer.GetNumberOfRasterizedActors(), 1)
        self.assertIn("no values", traced.tracer.GetReason(traced.actor))
        traced.renderer.SetPass(None)
        self.assertEqual(shown, traced.pixels())
        self.assertGreater(len(set(shown)), 5)

    def test_table_of_few_colors(self):
        self.check("slope", table())

    def test_logarithm_beyond_the_range_and_its_colors(self):
        self.check("slope", table(SetScaleToLog10=(), SetUseBelowRangeColor=(1,),
                                  SetBelowRangeColor=(1, 1, 1, 1), SetUseAboveRangeColor=(1,),
                                  SetAboveRangeColor=(0, 0, 0, 1)))

    def test_transfer_function(self):
        function = vtkColorTransferFunction()
        function.AddRGBPoint(0.6, 1, 0, 0)
        function.AddRGBPoint(2.1, 0, 1, 1)
        self.check("slope", function, most=6)

    def test_colors_of_bytes(self):
        # Flying edges makes floats of them, so the ball itself is the reference.
        pixels = self.view(self.octree("colors"), True, "colors").pixels()
        away = math.hypot(2, -3, 1.5)
        middle = pixels[100 * 200 + 100]
        for value, coordinate in zip(middle, (2, -3, 1.5)):
            self.assertAlmostEqual(value, 100 + 90 * 0.8 * coordinate / away, delta=4)

    def test_no_value_has_the_color_of_nan(self):
        slope = self.image.GetPointData().GetArray("slope")
        for i in range(slope.GetNumberOfTuples()):
            slope.SetValue(i, math.nan if self.image.GetPoint(i)[0] > 0 else 1.0)
        slope.Modified()
        view = self.view(self.octree("slope"), True, "slope", table(SetNanColor=(0, 0, 1, 1)))
        nan = sum(p == bytes((0, 0, 255)) for p in view.pixels())
        self.assertTrue(0.7 < nan / 19141 < 0.85, nan)  # of the ball's pixels

    def test_new_table_new_picture(self):
        colors = table()
        view, before = self.check("slope", colors)
        self.assertEqual(before, view.pixels())
        colors.SetTableRange(0.0, 3.0)
        colors.Build()
        after = view.pixels()
        self.assertGreater(differing(before, after, 0), 5000)
        afresh = self.view(self.octree("slope"), True, "slope", colors).pixels()
        self.assertEqual(after, afresh)

    def test_hull_and_other_arrays_as_ever(self):
        view = self.view(self.octree("slope"), True, "slope", table())
        view.mapper.ScalarVisibilityOff()
        view.actor.GetProperty().SetColor(0, 1, 0)
        self.assertEqual(len(set(view.pixels())), 2)
        view.mapper.ScalarVisibilityOn()
        view.renderer.SetPass(None)
        hull = view.pixels()
        self.assertGreater(len(set(hull)), 4)

    def test_coarse_nodes_have_the_color_of_a_voxel_in_them(self):
        view = self.view(self.octree("slope", 9), True, "slope", table())
        fine = view.pixels()
        view.tracer.SetPixelError(6.0)
        coarse = view.pixels()
        surface = sum(p != fine[0] for p in fine)
        self.assertLess(differing(fine, coarse, 0), 0.25 * surface)
        if not OPENGL:  # which stops at no nodes
            self.assertLessEqual(len(set(coarse)), 10)  # of the table, and the background

    def test_translucent_colors_leave_it_to_the_rasteriser(self):
        view = self.view(self.octree("slope"), True, "slope", table(SetAlphaRange=(0.3, 1.0)))
        view.pixels()
        self.assertEqual(view.tracer.GetNumberOfRasterizedActors(), 1)

    def test_translucent_colors_cast_as_light_as_they_are(self):
        """A ball 2 above a ground, the light from aside: of each place the nearer side of the ball counts."""
        renderer, window, tracer = vtkRenderer(), vtkRenderWindow(), new_pass()
        window.SetOffScreenRendering(True)
        window.SetMultiSamples(0)
        window.SetSize(120, 60)
        window.AddRenderer(renderer)
        renderer.SetPass(tracer)
        alphas = table(SetNumberOfTableValues=(256,), SetTableRange=(0.4, 2.6), SetAlphaRange=(0.0, 1.0))
        mapper, ball = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(self.octree("slope"))
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("slope")
        mapper.SetLookupTable(alphas)
        mapper.UseLookupTableScalarRangeOn()
        ball.SetMapper(mapper)
        ball.SetPosition(0, 0, 2)
        source, ground, ofGround = vtkPlaneSource(), vtkActor(), vtkPolyDataMapper()
        source.SetOrigin(-4, -2, 0)
        source.SetPoint1(4, -2, 0)
        source.SetPoint2(-4, 2, 0)
        ofGround.SetInputConnection(source.GetOutputPort())
        ground.SetMapper(ofGround)
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(1, 0, 1)
        renderer.AddLight(light)
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(1)
        camera.SetPosition(-2, 0, 9)
        camera.SetFocalPoint(-2, 0, 0)
        camera.SetClippingRange(1, 12)
        renderer.AddActor(ground)
        lit = None
        for technique in None, tracer.SHADOW_BUFFER, tracer.SHADOW_RAYS:
            if technique is not None:
                renderer.AddActor(ball)
                tracer.SetShadowTechnique(technique)
            grab = vtkWindowToImageFilter()
            grab.SetInput(window)
            grab.ReadFrontBufferOff()
            grab.Update()
            pixels = grab.GetOutput().GetPointData().GetScalars()
            grey = [pixels.GetComponent(i, 0) for i in range(pixels.GetNumberOfTuples())]
            lit = lit or grey
            asked = 0
            for i, value in enumerate(grey if technique is not None else []):
                x, y = (i % 120 + 0.5) / 30 - 4, (i // 120 + 0.5) / 30 - 1
                along = (2 - x) / math.sqrt(2)
                squared = 0.64 - (x * x + y * y + 4 - along * along)
                if x < -1 and squared > 0.06:
                    step = (along + math.sqrt(squared)) / math.sqrt(2)
                    slope = 1.5 + (x + step) + 0.3 * (step - 2)
                    asked += 1
                    share = 1 - (slope - 0.4) / 2.2
                    self.assertAlmostEqual(value / lit[i], share, delta=0.06)
            self.assertTrue(technique is None or asked > 700, asked)


if __name__ == "__main__":
    unittest.main()
