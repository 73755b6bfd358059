"""The filters from Python: source, octree, questions to it, its cells, and a file in between."""

import math
import os
import tempfile
import unittest

import vtksvo
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def sphere_with_octree(level=6):
    source = vtkSphereSource()
    source.SetRadius(1.0)
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    convert = vtksvo.vtkPolyDataToSVO()
    convert.SetInputConnection(source.GetOutputPort())
    convert.SetMaximumLevel(level)
    convert.Update()
    return convert


class Filters(unittest.TestCase):
    def test_the_mesh_passes_through_unchanged(self):
        convert = sphere_with_octree()
        mesh, output = convert.GetInput(), convert.GetOutput()
        self.assertEqual(output.GetNumberOfPoints(), mesh.GetNumberOfPoints())
        self.assertEqual(output.GetNumberOfPolys(), mesh.GetNumberOfPolys())
        self.assertGreater(output.GetFieldData().GetNumberOfArrays(), 0)

    def test_an_octree_that_comes_along_can_be_kept(self):
        first, second = sphere_with_octree(5), vtksvo.vtkPolyDataToSVO()
        second.SetInputConnection(first.GetOutputPort())
        second.SetMaximumLevel(7)
        second.SetKeepOctrees(True)
        second.Update()
        self.assertEqual(second.GetNumberOfBuilds(), 0)
        self.assertEqual(second.GetNumberOfVoxels(), first.GetNumberOfVoxels())
        second.SetKeepOctrees(False)
        second.Update()
        self.assertEqual(second.GetNumberOfBuilds(), 1)

    def test_statistics_in_field_data(self):
        convert = sphere_with_octree(5)
        self.assertIsNone(convert.GetOutput().GetFieldData().GetArray("SVO Level"))
        convert.SetWriteStatistics(True)
        convert.Update()
        fields = convert.GetOutput().GetFieldData()
        self.assertEqual(fields.GetArray("SVO Level").GetValue(0), 5)
        self.assertEqual(fields.GetArray("SVO Voxels").GetValue(0), convert.GetNumberOfVoxels())
        self.assertGreater(fields.GetArray("SVO Memory").GetValue(0), 0)

    def test_octree_answers(self):
        octree = vtksvo.vtkSparseVoxelOctree()
        self.assertTrue(octree.Initialize(sphere_with_octree(6).GetOutput()))
        self.assertEqual(octree.GetNumberOfLevels(), 6)
        # A unit square of any direction touches |nx| + |ny| + |nz| cells, 1.5 on average; the sphere
        # that fills its cube has pi 4^level of them.
        voxels = 1.5 * math.pi * 4**6
        self.assertAlmostEqual(octree.GetNumberOfVoxels(), voxels, delta=0.05 * voxels)
        self.assertGreater(octree.GetActualMemorySize(), 0)
        bounds = [0.0] * 6
        octree.GetBounds(bounds)
        edge = bounds[1] - bounds[0]
        self.assertAlmostEqual(octree.GetVoxelSize(), edge / 64, places=9)
        self.assertTrue(octree.IsOccupied([0.0, 0.0, 1.0], 6))
        self.assertFalse(octree.IsOccupied([0.0, 0.0, 0.0], 6))
        self.assertFalse(octree.IsOccupied([0.0, 0.0, 9.0], 6))

    def test_line_meets_the_surface_where_the_sphere_is(self):
        octree = vtksvo.vtkSparseVoxelOctree()
        octree.Initialize(sphere_with_octree(7).GetOutput())
        t, x, cell = reference(-1.0), [0.0, 0.0, 0.0], reference(-1)
        hit = octree.IntersectWithLine([3.0, 0.1, 0.2], [-1.0, 0.1, 0.2], t, x, cell)
        self.assertEqual(hit, 1)
        self.assertAlmostEqual(sum(c * c for c in x) ** 0.5, 1.0, delta=0.02)
        self.assertAlmostEqual(float(t), (3.0 - x[0]) / 4.0, places=5)
        self.assertGreaterEqual(int(cell), 0)
        self.assertEqual(octree.IntersectWithLine([3, 2, 0], [-1, 2, 0], t, x, cell), 0)
        # The line ends before the surface.
        self.assertEqual(octree.IntersectWithLine([3, 0, 0], [2, 0, 0], t, x, cell), 0)

    def test_an_implicit_function_has_an_octree(self):
        function = vtkSphere()
        function.SetRadius(0.8)
        convert = vtksvo.vtkImplicitFunctionToSVO()
        convert.SetImplicitFunction(function)
        convert.SetModelBounds(-1, 1, -1, 1, -1, 1)
        convert.SetMaximumLevel(6)
        convert.SetGradientBound(4.0)
        convert.Update()
        octree = vtksvo.vtkSparseVoxelOctree()
        self.assertTrue(octree.Initialize(convert.GetOutput()))
        self.assertEqual(octree.GetNumberOfVoxels(), convert.GetNumberOfVoxels())
        voxels = 1.5 * math.pi * (0.8 * 2**6) ** 2
        self.assertAlmostEqual(octree.GetNumberOfVoxels(), voxels, delta=0.05 * voxels)
        t, x, cell = reference(-1.0), [0.0, 0.0, 0.0], reference(7)
        self.assertEqual(octree.IntersectWithLine([3, 0.1, 0.2], [-1, 0.1, 0.2], t, x, cell), 1)
        self.assertAlmostEqual(sum(c * c for c in x) ** 0.5, 0.8, delta=1e-4)
        self.assertEqual(int(cell), -1)

    def test_octree_travels_in_a_file(self):
        mesh = sphere_with_octree(5).GetOutput()
        octree = vtksvo.vtkSparseVoxelOctree()
        octree.Initialize(mesh)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sphere.vtp")
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(path)
            writer.SetInputData(mesh)
            self.assertEqual(writer.Write(), 1)
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(path)
            reader.Update()
        again = vtksvo.vtkSparseVoxelOctree()
        self.assertTrue(again.Initialize(reader.GetOutput()))
        self.assertEqual(again.GetNumberOfVoxels(), octree.GetNumberOfVoxels())

    def test_a_mesh_without_octree_is_an_error_once(self):
        octree = vtksvo.vtkSparseVoxelOctree()
        errors = []
        octree.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        self.assertFalse(octree.Initialize(vtkPolyData()))
        self.assertEqual(len(errors), 1)

    def test_voxels_as_a_surface(self):
        convert = sphere_with_octree(4)  # a port does not keep its filter alive
        cells = vtksvo.vtkSVOToPolyData()
        cells.SetInputConnection(convert.GetOutputPort())
        cells.Update()
        surface = cells.GetOutput()
        self.assertGreater(surface.GetNumberOfPolys(), 100)
        for low, high in zip(surface.GetBounds()[::2], surface.GetBounds()[1::2]):
            self.assertLess(low, -0.99)
            self.assertGreater(high, 0.99)

    def test_poses_are_built_once(self):
        source = vtkSphereSource()
        convert = vtksvo.vtkPolyDataToSVO()
        convert.SetMaximumLevel(5)
        convert.SetLeafGeometryToTriangle()
        convert.SetInputConnection(source.GetOutputPort())
        for radius in (1.0, 2.0, 3.0) * 2:
            source.SetRadius(radius)
            convert.Update()
        self.assertEqual(convert.GetNumberOfBuilds(), 3)
        self.assertEqual(convert.GetNumberOfCachedOctrees(), 3)
        self.assertGreater(convert.GetCacheMemorySize(), 0)
        convert.SetCacheTimeSteps(False)
        self.assertEqual(convert.GetCacheMemorySize(), 0)

    def test_points_edited_in_place_make_the_octree_foreign(self):
        mesh = sphere_with_octree(4).GetOutput()
        mesh.GetPoints().SetPoint(0, 0.0, 0.0, 2.0)
        mesh.GetPoints().Modified()
        octree = vtksvo.vtkSparseVoxelOctree()
        errors = []
        octree.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        self.assertFalse(octree.Initialize(mesh))
        self.assertEqual(len(errors), 1)
        self.assertEqual(octree.GetNumberOfVoxels(), 0)

    def test_octrees_travel_in_files(self):
        converted = sphere_with_octree(4).GetOutput()

        def travels(writer, reader, name):
            with tempfile.TemporaryDirectory() as folder:
                for end in (writer, reader):
                    end.SetFileName(os.path.join(folder, name))
                writer.SetInputData(converted)
                writer.Write()
                reader.Update()
            octree = vtksvo.vtkSparseVoxelOctree()
            octree.AddObserver("ErrorEvent", lambda *_: None)
            return octree.Initialize(reader.GetOutput())

        for mode in ("Ascii", "Binary", "Appended"):
            writer = vtkXMLPolyDataWriter()
            getattr(writer, f"SetDataModeTo{mode}")()
            self.assertTrue(travels(writer, vtkXMLPolyDataReader(), "mesh.vtp"), mode)
        writer = vtkPolyDataWriter()
        writer.SetFileTypeToBinary()
        self.assertTrue(travels(writer, vtkPolyDataReader(), "mesh.vtk"))
        # The guide says so: it rounds the points.
        writer.SetFileTypeToASCII()
        self.assertFalse(travels(writer, vtkPolyDataReader(), "mesh.vtk"))


if __name__ == "__main__":
    unittest.main()
