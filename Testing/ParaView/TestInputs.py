"""What the filter and the representation take: surfaces of every kind of composite dataset, AMR, hyper tree grids;
progress while an octree is built, and aborting it."""

import unittest

import paraview.simple as pv
import scene
import series
from vtkmodules.vtkCommonDataModel import (
    vtkDataObjectTreeIterator, vtkHyperTreeGrid, vtkImageData, vtkMultiBlockDataSet,
    vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData, vtkUnstructuredGrid)

COMPOSITES = ("vtkMultiBlockDataSet", "vtkPartitionedDataSet", "vtkPartitionedDataSetCollection")
OCTREE = "SparseVoxelOctree"


def with_gaps():
    """Composite datasets of a ball, of a surface without cells, and of places where nothing is."""
    ball, = series.breathing_ball(1)
    blocks, empty = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    blocks.SetBlock(1, ball)
    blocks.SetBlock(3, vtkPolyData())
    empty.SetNumberOfBlocks(1)
    blocks.SetBlock(4, empty)
    partitions = vtkPartitionedDataSet()
    partitions.SetNumberOfPartitions(3)
    partitions.SetPartition(1, ball)
    partitions.SetPartition(2, vtkPolyData())
    collection = vtkPartitionedDataSetCollection()
    collection.SetNumberOfPartitionedDataSets(3)
    collection.SetPartition(0, 0, ball)
    collection.SetNumberOfPartitions(2, 2)
    collection.SetPartition(2, 1, vtkPolyData())
    return blocks, partitions, collection


def surfaces(display):
    """How many surfaces there are in what a display of this process draws. One of AMR was one surface before
    ParaView 5.13, and has been one for each of its boxes since."""
    blocks = vtkDataObjectTreeIterator()
    blocks.SetDataSet(
        display.GetClientSideObject().GetActiveRepresentation().GetRenderedDataObject(0))
    blocks.InitTraversal()
    number = 0
    while not blocks.IsDoneWithTraversal():
        number += blocks.GetCurrentDataObject().GetNumberOfPolys() > 0
        blocks.GoToNextItem()
    return number


class TestInputs(unittest.TestCase):
    def setUp(self):
        self.view = scene.make_view((400, 300))
        scene.add_sun(self.view)
        self.view.SVOShadowTechnique = "None"
        self.view.SVOPixelError = 0

    def tearDown(self):
        pv.ResetSession()

    def group(self, kind):
        return pv.GroupDatasets(Input=[scene.make_ball(), scene.make_ground()], OutputType=kind)

    def check(self, source, name, octrees=1, level=10):
        """Traced with so many octrees (None: one for each block that ParaView's own surface has), and as the
        representation Surface looks."""
        source.UpdatePipeline()
        pv.HideAll(self.view)
        display = scene.show(source, self.view, "Surface")
        display.SVOMaximumLevel = level
        pv.ResetCamera(self.view)
        surface = scene.picture(self.view, name + "-surface")
        display.Representation = "SVO"
        traced = scene.picture(self.view, name + "-svo")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfTracedActors"), 1)
        if octrees is None:
            octrees = surfaces(display)
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), octrees)
        self.assertLess(scene.differing(traced, surface, 3), 3e-4)
        background = traced[0, 0]
        self.assertGreater((abs(traced - background).max(axis=2) > 8).mean(), 0.05)
        return display

    def test_composites(self):
        for kind in COMPOSITES:
            with self.subTest(kind=kind):
                source = self.group(kind)
                # Partitions share a cube, that of the whole, which is four times as large as the ball. ParaView
                # keeps them as such from 5.13 on.
                level = 12 if kind == "vtkPartitionedDataSet" else 10
                display = self.check(source, kind, octrees=2, level=level)
                # One for each block, but for those that an earlier kind has made.
                self.assertLessEqual(scene.statistic(display, "SVONumberOfBuilds"), 2)

    def test_blocks_shadow_each_other(self):
        octrees = pv.PolyDataToSVO(Input=self.group(COMPOSITES[0]), MaximumLevel=9)
        self.view.SVOShadowTechnique = "Shadow Buffer"
        scene.show(octrees, self.view)
        picture = scene.picture(self.view, "blocks-with-shadows")
        self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), 2)
        self.assertLess(scene.baseline_difference(picture, "FilteredBlocks"), 1e-3)

    def test_composites_through_the_filter(self):
        for kind in COMPOSITES:
            with self.subTest(kind=kind):
                # Partitions share a cube, that of the whole, so the ball's voxels are coarser there.
                octrees = pv.PolyDataToSVO(Input=self.group(kind), LeafGeometry="Triangle")
                display = self.check(octrees, kind + "-filter", octrees=2)
                self.assertEqual(octrees.GetDataInformation().GetDataSetTypeAsString(), kind)
                self.assertLessEqual(scene.statistic(octrees, "NumberOfBuilds"), 2)
                self.assertEqual(scene.statistic(display, "SVONumberOfBuilds"), 0)

    def test_overlapping_amr(self):
        source = pv.AMRGaussianPulseSource()
        self.check(source, "overlapping-amr", octrees=None)
        self.assertEqual(source.GetDataInformation().GetDataSetTypeAsString(), "vtkOverlappingAMR")

    def test_hierarchical_boxes(self):
        self.check(pv.HierarchicalFractal(), "hierarchical-boxes", octrees=None)

    def test_hyper_tree_grids(self):
        for name in "HyperTreeGrid", "HyperTreeGridRandom":
            with self.subTest(source=name):
                source = getattr(pv.servermanager.sources, name)()
                self.check(source, name)
                self.assertEqual(source.GetDataInformation().GetDataSetTypeAsString(),
                                 "vtkHyperTreeGrid")

    def check_traced(self, data, octrees):
        producer = pv.TrivialProducer()
        producer.GetClientSideObject().SetOutput(data)
        producer.MarkModified(None)
        sources = [producer]
        if data.IsA("vtkPolyData") or data.IsA("vtkCompositeDataSet"):
            sources.append(pv.PolyDataToSVO(Input=producer))
        for source in sources:
            with self.subTest(data=data.GetClassName(), source=source.GetXMLName()):
                pv.HideAll(self.view)
                scene.show(source, self.view)
                pv.Render(self.view)
                self.assertEqual(scene.statistic(self.view, "SVONumberOfInstances"), octrees)

    def test_gaps(self):
        for data in with_gaps():
            self.check_traced(data, 1)

    def test_empty(self):
        for kind in (vtkPolyData, vtkUnstructuredGrid, vtkImageData, vtkHyperTreeGrid,
                     vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection):
            self.check_traced(kind(), 0)

    def test_filter_is_aborted(self):
        octrees = pv.PolyDataToSVO(Input=scene.make_ball(), MaximumLevel=9)
        algorithm = octrees.GetClientSideObject()
        seen = []

        def abort(*_):
            seen.append(algorithm.GetProgress())
            if seen[-1] > 0.2:
                algorithm.SetAbortExecute(1)

        observer = algorithm.AddObserver("ProgressEvent", abort)
        octrees.UpdatePipeline()
        # It stops there, and says that it is over.
        self.assertEqual([progress for progress in seen if progress > 0.2], [seen[-2], 1.0])
        self.assertLess(seen[-2], 0.9)
        self.assertEqual(algorithm.GetOutput().GetNumberOfCells(), 0)
        self.assertEqual(scene.statistic(octrees, "NumberOfBuilds"), 0)
        algorithm.RemoveObserver(observer)
        algorithm.SetAbortExecute(0)
        octrees.MaximumLevel = 8
        octrees.UpdatePipeline()
        self.assertTrue(algorithm.GetOutput().GetFieldData().HasArray(OCTREE))
        self.assertEqual(scene.statistic(octrees, "NumberOfBuilds"), 1)

    def test_progress(self):
        octrees = pv.PolyDataToSVO(Input=scene.make_ball(), MaximumLevel=9)
        algorithm = octrees.GetClientSideObject()
        seen = []
        algorithm.AddObserver("ProgressEvent", lambda *_: seen.append(algorithm.GetProgress()))
        octrees.UpdatePipeline()
        self.assertGreater(len(seen), 5)
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1.0)

    def test_progress_of_the_representation(self):
        ball = scene.make_ball()
        ball.ThetaResolution = 61  # nobody else's, or there would be nothing to be built
        display = scene.show(ball, self.view)
        representation = display.GetClientSideObject().GetActiveRepresentation()
        seen = []
        representation.AddObserver("ProgressEvent",
                                   lambda *_: seen.append(representation.GetProgress()))
        pv.Render(self.view)
        self.assertEqual(scene.statistic(display, "SVONumberOfBuilds"), 1)
        self.assertGreater(sum(0.8 < progress < 0.85 for progress in seen), 5)


scene.load_plugin()
scene.run_tests()
