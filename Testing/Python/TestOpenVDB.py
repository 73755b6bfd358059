"""Files for OpenVDB's own programs and from its own Python module, as Debian has them."""

import os
import shutil
import subprocess
import tempfile
import unittest

import vtksvo
from backend import new_pass
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

try:
    import pyopenvdb as openvdb  # up to OpenVDB 10
except ImportError:
    try:
        import openvdb
    except ImportError:
        openvdb = None


def octree_of(mesh):
    octree = vtksvo.vtkSparseVoxelOctree()
    assert octree.Initialize(mesh)
    return octree


def hit(octree, p1, p2):
    t, x, cell = reference(0.0), [0.0] * 3, reference(0)
    return x if octree.IntersectWithLine(p1, p2, t, x, cell) else None


class OpenVDB(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "grids.vdb")

    def write(self):
        ball = vtkSphereSource()
        ball.SetCenter(4.0, 5.0, 6.0)
        ball.SetRadius(2.0)
        ball.SetThetaResolution(64)
        ball.SetPhiResolution(64)
        convert = vtksvo.vtkPolyDataToSVO()
        convert.SetInputConnection(ball.GetOutputPort())
        convert.SetMaximumLevel(6)
        writer = vtksvo.vtkSVOVDBWriter()
        writer.SetInputConnection(convert.GetOutputPort())
        writer.SetFileName(self.path)
        writer.WriteLevelSetOn()
        writer.SetHalfWidth(4.0)
        self.assertEqual(writer.Write(), 1)
        return convert

    def draw(self, shape, name, traced=True, shadows=True):
        """Turned and stretched, on a ground."""
        mapper, actor, ground = vtkPolyDataMapper(), vtkActor(), vtkPlaneSource()
        mapper.SetInputConnection(shape.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor.SetMapper(mapper)
        actor.SetScale(1.0, 1.3, 0.8)
        actor.RotateZ(30.0)
        ground.SetOrigin(-40, -40, -2)
        ground.SetPoint1(60, -40, -2)
        ground.SetPoint2(-40, 60, -2)
        below, floor = vtkPolyDataMapper(), vtkActor()
        below.SetInputConnection(ground.GetOutputPort())
        floor.SetMapper(below)
        renderer, light, window = vtkRenderer(), vtkLight(), vtkRenderWindow()
        light.SetLightTypeToSceneLight()
        light.SetPosition(20, -10, 40)
        light.SetFocalPoint(2, 10, 7)
        renderer.AddLight(light)
        renderer.AddActor(actor)
        renderer.AddActor(floor)
        if traced:
            renderer.SetPass(new_pass())
            if not shadows:
                renderer.GetPass().SetShadowTechniqueToNone()
        renderer.GetActiveCamera().SetPosition(30, -35, 30)
        renderer.GetActiveCamera().SetFocalPoint(4, 10, 4)
        renderer.GetActiveCamera().SetViewUp(0, 0, 1)
        renderer.ResetCameraClippingRange()
        window.SetOffScreenRendering(True)
        window.SetMultiSamples(0)
        window.SetSize(300, 200)
        window.AddRenderer(renderer)
        window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.Update()
        if "VTKSVO_PICTURES" in os.environ:
            writer = vtkPNGWriter()
            writer.SetInputConnection(grab.GetOutputPort())
            writer.SetFileName(os.path.join(os.environ["VTKSVO_PICTURES"], name + ".png"))
            writer.Write()
        return bytes(memoryview(grab.GetOutput().GetPointData().GetScalars()))

    def test_there_and_back(self):
        convert = self.write()
        reader = vtksvo.vtkSVOVDBReader()
        reader.SetFileName(self.path)
        self.assertEqual([reader.GetGridName(i) for i in range(reader.GetNumberOfGrids())],
                         ["leaves", "surface"])
        reader.Update()
        self.assertEqual(reader.GetNumberOfVoxels(), convert.GetNumberOfVoxels())
        self.assertEqual(octree_of(reader.GetOutput()).GetBounds(), octree_of(convert.GetOutput()).GetBounds())
        self.assertIn("vtksvo_source: triangles", reader.GetMetaData())
        self.assertIn("creator: vtkSVO", reader.GetMetaData())
        reader.SetGridName("surface")
        reader.Update()
        self.assertAlmostEqual(hit(octree_of(reader.GetOutput()), (10, 5, 6), (4, 5, 6))[0], 6.0, delta=0.05)

    @unittest.skipUnless(shutil.which("vdb_print"), "libopenvdb-tools is not installed")
    def test_openvdbs_program_prints_our_file(self):
        convert = self.write()
        said = subprocess.run(["vdb_print", "-l", self.path], capture_output=True, text=True, check=True)
        self.assertEqual(said.stderr, "")
        self.assertIn(f"Number of active voxels:       {convert.GetNumberOfVoxels():,}", said.stdout)
        for text in ("Name: leaves", "Name: surface", "class: level set", "vtksvo_level: 6"):
            self.assertIn(text, said.stdout)

    @unittest.skipUnless(openvdb, "python3-openvdb is not installed")
    def test_openvdbs_module_reads_our_file(self):
        convert = self.write()
        leaves, surface = openvdb.read(self.path, "leaves"), openvdb.read(self.path, "surface")
        self.assertEqual(leaves.activeVoxelCount(), convert.GetNumberOfVoxels())
        self.assertEqual(surface.gridClass, "level set")
        octree = octree_of(convert.GetOutput())
        for item in list(leaves.iterOnValues())[::97]:
            self.assertTrue(octree.IsOccupied(leaves.transform.indexToWorld(item.min), 6))
        accessor = surface.getConstAccessor()
        for x, distance in ((6.1, 0.1), (5.9, -0.1), (6.0, 0.0)):
            index = surface.transform.worldToIndexCellCentered((x, 5.0, 6.0))
            at = surface.transform.indexToWorld(index)
            exact = sum((a - b) ** 2 for a, b in zip(at, (4.0, 5.0, 6.0))) ** 0.5 - 2.0
            self.assertAlmostEqual(accessor.getValue(index), exact, delta=0.01)  # the mesh is no sphere

    @unittest.skipUnless(openvdb, "python3-openvdb is not installed")
    def test_reads_what_openvdbs_module_writes(self):
        ball = openvdb.createLevelSetSphere(radius=2.0, center=(1.0, -2.0, 3.0), voxelSize=0.05)
        ball.name = "ball"
        stretched = openvdb.FloatGrid()
        stretched.fill((0, 0, 0), (9, 9, 9), 0.7, True)
        stretched.name = "density"
        stretched.transform = openvdb.createLinearTransform(
            [[0.1, 0, 0, 0], [0.05, 0.2, 0, 0], [0, 0, 0.4, 0], [7, 8, 9, 1]])
        openvdb.write(self.path, grids=[ball, stretched], metadata={"scene": "one"})
        reader = vtksvo.vtkSVOVDBReader()
        reader.SetFileName(self.path)
        reader.SetGridName("ball")
        reader.Update()
        octree = octree_of(reader.GetOutput())
        self.assertAlmostEqual(hit(octree, (9, -2, 3), (1, -2, 3))[0], 3.0, delta=0.005)
        self.assertAlmostEqual(octree.GetVoxelSize(), 0.05)
        self.assertIn("scene: one", reader.GetMetaData())
        reader.SetGridName("density")
        reader.SetThreshold(0.5)
        reader.Update()
        self.assertEqual(reader.GetNumberOfVoxels(), 1000)
        octree = octree_of(reader.GetOutput())
        inside = stretched.transform.indexToWorld((4, 9, 2))
        outside = stretched.transform.indexToWorld((4, 10, 2))
        self.assertTrue(octree.IsOccupied(inside, 20))
        self.assertFalse(octree.IsOccupied(outside, 20))
        bounds = octree.GetBounds()
        self.assertTrue(all(bounds[2 * i] < inside[i] < bounds[2 * i + 1] for i in range(3)))

    @unittest.skipUnless(openvdb, "python3-openvdb is not installed")
    def test_a_sheared_grid_looks_as_the_sheared_mesh(self):
        rows = [[0.1, 0, 0.02, 0], [0.05, 0.2, 0, 0], [0, 0.03, 0.15, 0], [7, 8, 9, 1]]
        ball = openvdb.createLevelSetSphere(radius=30.0, voxelSize=1.0)
        ball.transform = openvdb.createLinearTransform(rows)
        openvdb.write(self.path, grids=[ball])
        reader = vtksvo.vtkSVOVDBReader()
        reader.SetFileName(self.path)
        source, transform, sheared = vtkSphereSource(), vtkTransform(), vtkTransformPolyDataFilter()
        source.SetRadius(30.0)
        source.SetThetaResolution(200)
        source.SetPhiResolution(200)
        transform.SetMatrix([rows[column][row] for row in range(4) for column in range(4)])
        sheared.SetTransform(transform)
        sheared.SetInputConnection(source.GetOutputPort())
        pictures = []
        for shape, name in (reader, "sheared-grid"), (sheared, "sheared-mesh"):
            pictures.append(self.draw(shape, name))
        differing = sum(abs(a - b) > 32 for a, b in zip(*pictures))
        self.assertGreater(len(set(pictures[1])), 20)
        self.assertLess(differing, 0.01 * len(pictures[0]))

    def test_voxels_are_shaded_as_cubes(self):
        """As VTK's rasteriser draws the same cubes, faces and all."""
        self.write()
        reader, cubes = vtksvo.vtkSVOVDBReader(), vtksvo.vtkSVOToPolyData()
        reader.SetFileName(self.path)
        reader.SetGridName("leaves")
        cubes.SetInputConnection(reader.GetOutputPort())
        traced = self.draw(reader, "cubes-traced", shadows=False)
        raster = self.draw(cubes, "cubes-raster", traced=False)
        differing = sum(abs(a - b) > 8 for a, b in zip(traced, raster))
        self.assertGreater(len(set(raster)), 3)  # ground and faces
        self.assertLess(differing, 0.0005 * len(raster))


if __name__ == "__main__":
    unittest.main()
