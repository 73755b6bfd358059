"""Shadows As Data: lights from properties, casters as second input, composite ones, time series."""

import math
import unittest

import paraview.simple as pv
import scene
import series
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy


def values(source, name="Exposure", time=None):
    """An array of the cells, by components."""
    source.UpdatePipeline(time) if time is not None else source.UpdatePipeline()
    array = servermanager.Fetch(source).GetCellData().GetArray(name)
    return None if array is None else vtk_to_numpy(array)


class TestShadowData(unittest.TestCase):
    def setUp(self):
        self.ground = pv.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0])
        self.board = pv.Plane(Origin=[-0.5, -0.5, 1], Point1=[0.5, -0.5, 1], Point2=[-0.5, 0.5, 1])

    def tearDown(self):
        pv.ResetSession()

    def shadows(self, **properties):
        return pv.ShadowsAsData(Input=self.ground, **properties)

    def test_a_sun_path_is_the_default(self):
        filtered = self.shadows(Date=[2024, 3, 20], Step=1.0)
        self.assertAlmostEqual(values(filtered)[0], 12.07, delta=0.03)
        self.assertEqual(scene.statistic(filtered, "NumberOfLights"), values(filtered, "Shadow").size)
        filtered.Latitude, filtered.Date = 80.0, [2024, 12, 21]
        self.assertEqual(values(filtered)[0], 0.0)

    def test_a_sky(self):
        filtered = self.shadows(LightSource="Sky", SkyType="Overcast", CosineWeighted=1)
        self.assertAlmostEqual(values(filtered)[0], 1.0, delta=1e-12)
        filtered.WriteShadow = 0
        self.assertIsNone(values(filtered, "Shadow"))

    def test_casters_and_directions(self):
        filtered = self.shadows(LightSource="Directions", Directions=[0, 0, 1, 3, 0, 1],
                                SamplesPerCell=4096)
        self.assertEqual(values(filtered)[0], 2.0)
        filtered.Casters = [self.board]
        shadow = values(filtered, "Shadow")[0]
        self.assertAlmostEqual(shadow[0], 1 / 16, delta=2e-3)
        self.assertEqual(shadow[1], 0.0)
        second = pv.Transform(Input=self.board)
        second.Transform.Translate = [1.2, 0, 0]
        filtered.Casters = [self.board, second]
        self.assertAlmostEqual(values(filtered, "Shadow")[0][0], 2 / 16, delta=3e-3)
        filtered.Casters = []
        self.assertEqual(values(filtered)[0], 2.0)

    def test_composite_casters(self):
        second = pv.Transform(Input=self.board)
        second.Transform.Translate = [1.2, 0, 0]
        filtered = self.shadows(LightSource="Directions", Directions=[0, 0, 1], SamplesPerCell=4096,
                                Casters=[pv.GroupDatasets(Input=[self.board, second])])
        self.assertAlmostEqual(values(filtered)[0], 1 - 2 / 16, delta=3e-3)

    def test_positions(self):
        filtered = self.shadows(LightSource="Positions", Positions=[0, 0, 2], SamplesPerCell=4096,
                                Casters=[self.board])
        self.assertAlmostEqual(values(filtered)[0], 1 - 4 / 16, delta=3e-3)

    def test_octrees_of_the_other_filter(self):
        ball = pv.Sphere(Center=[0, 0, 1], ThetaResolution=64, PhiResolution=64)
        octree = pv.PolyDataToSVO(Input=ball, MaximumLevel=6, LeafGeometry="Voxel")
        filtered = self.shadows(LightSource="Directions", Directions=[0, 0, 1], SamplesPerCell=4096,
                                Casters=[octree])
        self.assertAlmostEqual(values(filtered)[0], 1 - math.pi * 0.25 / 16, delta=2e-3)

    def test_time_series_of_a_caster(self):
        moving = pv.PVDReader(FileName=series.write(scene.output("breathing"), series.breathing_ball(3)))
        filtered = self.shadows(LightSource="Directions", Directions=[0, 0, 1], SamplesPerCell=4096,
                                Casters=[moving])
        filtered.UpdatePipelineInformation()
        self.assertEqual(list(filtered.TimestepValues), [0.0, 1.0, 2.0])
        found = [values(filtered, time=t)[0] for t in (0.0, 1.0, 2.0, 0.0)]
        for value in found:  # the wave around the ball makes its outline larger by a fiftieth
            self.assertAlmostEqual(value, 1 - 1.02 * math.pi * 0.45**2 / 16, delta=2e-3)
        self.assertEqual(found[0], found[3])
        self.assertNotEqual(found[0], found[1])

    def test_a_picture(self):
        view = scene.make_view()
        filtered = pv.ShadowsAsData(Input=pv.Sphere(ThetaResolution=64, PhiResolution=64, Radius=0.8),
                                    LightSource="Directions", Directions=[1, 1, 0.2])
        display = pv.Show(filtered, view)
        pv.ColorBy(display, ("CELLS", "Exposure"))
        pv.ResetCamera(view)
        picture = scene.picture(view, "exposure").astype(int)
        lit = picture[..., 0] - picture[..., 2] > 60  # red, as ParaView's own table has the largest value
        dark = picture[..., 2] - picture[..., 0] > 60
        self.assertGreater(lit.sum(), 1000)
        self.assertGreater(dark.sum(), 1000)


scene.load_plugin()
scene.run_tests()
