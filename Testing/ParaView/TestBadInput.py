"""Series with empty steps, missing files and blocks without polygons: at most one message, and an
otherwise complete frame."""

import os
import unittest

import paraview.simple as pv
import scene
import series
from messages import Output
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData


class TestBadInput(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((300, 200))
        scene.add_sun(self.view)
        scene.show(scene.make_ground(), self.view)
        self.ground = scene.picture(self.view, "ground")

    def tearDown(self):
        pv.ResetSession()

    def play(self, meshes, name, kind="SVO"):
        """The pictures of all steps, and what was said about them."""
        path = series.write(scene.output(name), meshes)
        with Output() as output:
            reader = pv.PVDReader(FileName=path)
            animation = pv.GetAnimationScene()
            animation.UpdateAnimationUsingDataTimeSteps()
            scene.show(reader, self.view, kind)
            pictures = []
            for time in range(len(meshes)):
                animation.AnimationTime = time
                pictures.append(scene.picture(self.view, f"{name}-{time}"))
            pv.Hide(reader, self.view)
        return pictures, output

    def shows_ball(self, picture):
        return scene.differing(picture, self.ground) > 0.02

    def test_empty_step(self):
        first, second, third = series.breathing_ball(3)
        empty = vtkPolyData()
        empty.SetPoints(vtkPoints())
        pictures, output = self.play([first, empty, third], "empty-step")
        self.assertEqual([self.shows_ball(p) for p in pictures], [True, False, True])
        self.assertEqual(output.messages(), [])

    def test_removed_file(self):
        first, second, third = series.breathing_ball(3)
        pictures, output = self.play([first, None, third], "removed-file")
        self.assertEqual([self.shows_ball(p) for p in pictures], [True, False, True])
        self.assertEqual(scene.differing(pictures[1], self.ground, 0), 0)
        # The reader complains whenever it is asked, and its executive with it; no one else.
        lines = output.messages()
        files = {line.split("Error opening file")[1].strip()
                 for line in lines if "Error opening file" in line}
        self.assertEqual(len(files), 1, output.text)
        self.assertIn("step001.vtp", files.pop())
        self.assertTrue(all("vtkXMLPolyDataReader" in line for line in lines), output.text)
        _, ordinary = self.play([first, None, third], "removed-file", "Surface")
        self.assertEqual(len(lines), len(ordinary.messages()), output.text)

    def test_block_without_polygons(self):
        line = pv.Line(Point1=[-1, 0, 1], Point2=[1, 0, 1])
        with Output() as output:
            group = pv.GroupDatasets(Input=[scene.make_ball(), line],
                                     OutputType="vtkMultiBlockDataSet")
            scene.show(group, self.view)
            picture = scene.picture(self.view, "line-block")
        self.assertTrue(self.shows_ball(picture))
        self.assertEqual(output.messages(), [])

    def test_series_with_points_that_are_not_finite(self):
        meshes = list(series.breathing_ball(3))
        for mesh in meshes:
            mesh.GetPoints().SetPoint(100, float("nan"), 0.0, 0.0)
        pictures, output = self.play(meshes, "not-finite-series")
        self.assertEqual([self.shows_ball(p) for p in pictures], [True] * 3)
        self.assertEqual(len(output.messages()), 1, output.text)

    def test_points_that_are_not_finite(self):
        ball, = series.breathing_ball(1)
        ball.GetPoints().SetPoint(100, float("nan"), 0.0, 0.0)
        with Output() as output:
            producer = pv.TrivialProducer()
            producer.GetClientSideObject().SetOutput(ball)
            producer.MarkModified(None)
            scene.show(producer, self.view)
            picture = scene.picture(self.view, "not-finite")
        self.assertTrue(self.shows_ball(picture))
        self.assertLessEqual(len(output.messages()), 1, output.text)


scene.load_plugin()
scene.run_tests()
