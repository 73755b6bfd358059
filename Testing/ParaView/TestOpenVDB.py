"""OpenVDB files in ParaView: written and opened by their extension, grids by name, series as time steps."""

import os
import unittest

import paraview.simple as pv
import scene
from messages import Output


class TestOpenVDB(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((300, 200))
        scene.add_sun(self.view)
        scene.show(scene.make_ground(), self.view)
        self.ground = scene.picture(self.view, "ground")

    def tearDown(self):
        pv.ResetSession()

    def write(self, name, radius=scene.RADIUS):
        path = scene.output(name)
        if os.path.exists(path):
            os.remove(path)
        ball = pv.Sphere(Center=list(scene.CENTER), Radius=radius, ThetaResolution=64, PhiResolution=64)
        octree = pv.PolyDataToSVO(Input=ball, MaximumLevel=8)
        # By its name: ParaView may have a writer of its own for the extension.
        writer = pv.SVOVDBWriter(Input=octree, FileName=path, WriteLevelSet=1)
        writer.UpdatePipeline()
        self.assertTrue(os.path.exists(path))
        return path

    def test_traced_as_the_mesh_is(self):
        path = self.write("ball.vdb")
        display = scene.show(scene.make_ball(), self.view)
        mesh = scene.picture(self.view, "mesh")
        display.Visibility = 0
        with Output() as output:
            reader = pv.SVOVDBReader(FileNames=[path])
            reader.UpdatePipelineInformation()
            self.assertEqual(list(reader.GetProperty("GridNames")), ["leaves", "surface"])
            self.assertEqual(list(reader.GetProperty("GridName").GetAvailable()), ["leaves", "surface"])
            reader.GridName = "surface"
            scene.show(reader, self.view)
            surface = scene.picture(self.view, "surface")
            reader.GridName = "leaves"
            leaves = scene.picture(self.view, "leaves")
        self.assertEqual(output.messages(), [])
        self.assertGreater(scene.differing(surface, self.ground), 0.02)
        self.assertLess(scene.differing(surface, mesh, 24), 0.004)
        self.assertGreater(scene.differing(leaves, self.ground), 0.02)
        self.assertGreater(scene.differing(leaves, surface), 0.001)
        field = reader.GetFieldDataInformation()
        self.assertIn("VDBMetadata", field.keys())
        # For the Information panel.
        self.assertEqual(field["SVO Voxels"].GetRange()[0], scene.statistic(reader, "NumberOfVoxels"))
        self.assertGreater(field["SVO Memory"].GetRange()[0], 0)

    @unittest.skipIf(scene.OPENGL, "files and their times, whoever draws")
    def test_opened_by_extension(self):
        paths = [self.write(f"series_{i}.vdb", 0.2 + 0.1 * i) for i in range(3)]
        reader = pv.OpenDataFile(paths)
        if reader.GetXMLName() != "SVOVDBReader":  # ParaView has one of its own; a user is asked which
            reader = pv.SVOVDBReader(FileNames=paths)
        reader.GridName = "surface"
        reader.UpdatePipelineInformation()
        self.assertEqual(list(reader.TimestepValues), [0.0, 1.0, 2.0])
        animation = pv.GetAnimationScene()
        animation.UpdateAnimationUsingDataTimeSteps()
        # The representation that it is shown as by default.
        self.assertEqual(pv.Show(reader, self.view).Representation, "SVO")
        seen = []
        for time in range(3):
            animation.AnimationTime = time
            seen.append(scene.differing(scene.picture(self.view, f"step-{time}"), self.ground))
        self.assertLess(seen[0], seen[1])
        self.assertLess(seen[1], seen[2])

    @unittest.skipIf(scene.OPENGL, "nothing is drawn")
    def test_threshold_and_conversion(self):
        path = self.write("kinds.vdb")
        reader = pv.SVOVDBReader(FileNames=[path], GridName="surface", Conversion="Voxels", Threshold=-1.0)
        reader.UpdatePipeline()
        reader.UpdatePropertyInformation()
        all_voxels = reader.GetProperty("NumberOfVoxels").GetData()
        reader.Threshold = 0.0
        reader.UpdatePipeline()
        reader.UpdatePropertyInformation()
        self.assertGreater(reader.GetProperty("NumberOfVoxels").GetData(), 0)
        self.assertLess(reader.GetProperty("NumberOfVoxels").GetData(), all_voxels)

    def test_color_grid(self):
        """Another grid of the file, as cell data and on the screen."""
        reader = pv.SVOVDBReader(FileNames=[self.write("colors.vdb")], GridName="leaves")
        reader.UpdatePipelineInformation()
        self.assertEqual(list(reader.GetProperty("ColorGridName").GetAvailable()),
                         ["None", "leaves", "surface"])
        self.assertEqual(reader.ColorGrid, "None")
        display = scene.show(reader, self.view)
        plain = scene.picture(self.view, "no-color-grid")
        self.assertNotIn("surface", reader.CellData.keys())
        with Output() as output:
            reader.ColorGrid = "surface"
            reader.UpdatePipeline()
            low, high = reader.CellData["surface"].GetRange()
            pv.ColorBy(display, ("CELLS", "surface"))
            colored = scene.picture(self.view, "color-grid")
        self.assertEqual(output.messages(), [])
        self.assertLess(low, 0.0)
        self.assertGreater(high, 0.0)
        self.assertGreater(scene.differing(plain, colored, 24), 0.02)

    @unittest.skipIf(scene.OPENGL, "nothing is drawn")
    def test_missing_file_is_one_message(self):
        with Output() as output:
            reader = pv.SVOVDBReader(FileNames=[scene.output("missing.vdb")])
            reader.UpdatePipeline()
        own = [line for line in output.messages() if "cannot be read" in line]
        self.assertEqual(len(own), 1, output.text)


scene.load_plugin()
scene.run_tests()
