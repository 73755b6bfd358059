"""The structure of octrees in ParaView: their cells as surfaces and as hyper tree grids, which its own filters
slice and threshold."""

import unittest

import paraview.simple as pv
import scene


class Structure(unittest.TestCase):
    def setUp(self):
        self.octree = pv.PolyDataToSVO(Input=pv.Sphere(ThetaResolution=60, PhiResolution=60),
                                       MaximumLevel=6)
        self.octree.UpdatePipeline()
        self.octree.UpdatePropertyInformation()
        self.voxels = self.octree.GetProperty("NumberOfVoxels").GetData()

    def test_cells_are_a_closed_surface(self):
        cells = pv.SVOToPolyData(Input=self.octree, Level=3)
        edges = pv.FeatureEdges(Input=cells, FeatureEdges=0, NonManifoldEdges=0)
        edges.UpdatePipeline()
        self.assertGreater(cells.GetDataInformation().GetNumberOfCells(), 100)
        self.assertEqual(edges.GetDataInformation().GetNumberOfCells(), 0)

    def test_grid_can_be_sliced_and_thresholded(self):
        grid = pv.SVOToHyperTreeGrid(Input=self.octree)
        leaves = pv.HyperTreeGridToUnstructuredGrid(Input=grid)
        leaves.UpdatePipeline()
        self.assertEqual(leaves.GetDataInformation().GetNumberOfCells(), self.voxels)
        low, high = leaves.CellData["CellId"].GetRange()
        self.assertGreaterEqual(low, 0)
        cut = pv.Slice(Input=leaves)
        cut.SliceType.Normal = [0, 0, 1]
        cut.UpdatePipeline()
        ring = cut.GetDataInformation().GetNumberOfCells()
        self.assertTrue(64 * 2 < ring < 64 * 8, ring)
        few = pv.Threshold(Input=leaves, Scalars=["CELLS", "CellId"], LowerThreshold=low,
                           UpperThreshold=(low + high) / 2)
        few.UpdatePipeline()
        self.assertTrue(0 < few.GetDataInformation().GetNumberOfCells() < self.voxels)
        bounds = leaves.GetDataInformation().GetBounds()
        for low, high in zip(bounds[::2], bounds[1::2]):
            self.assertTrue(-0.52 < low <= -0.499 and 0.499 <= high < 0.52, bounds)


scene.load_plugin()
scene.run_tests()
