"""What the rasteriser has drawn, draws next to traced surfaces, or draws with what it shares with
them is in the picture as it is without the pass."""
import unittest

import vtk
import vtksvo
from backend import new_pass, traced
from vtkmodules.util.numpy_support import vtk_to_numpy


def new_window(*renderers, samples=0):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(samples)
    for renderer in renderers:
        window.AddRenderer(renderer)
    return window


def new_renderer(traced):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0.2, 0.3, 0.5)
    if traced:
        svo = new_pass()
        svo.SetShadowTechniqueToNone()
        renderer.SetPass(svo)
    return renderer


def new_actor(mapper):
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    return actor


def mapper_of(source):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    return mapper


def picture(window):
    reader = vtk.vtkWindowToImageFilter()
    reader.SetInput(window)
    reader.ShouldRerenderOff()
    reader.ReadFrontBufferOff()
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


def depths(window):
    values = vtk.vtkFloatArray()
    width, height = window.GetSize()
    window.GetZbufferData(0, 0, width - 1, height - 1, values)
    return vtk_to_numpy(values).copy()


def share(a, b):
    """Of the pixels that differ by more than 8 levels."""
    return (abs(a - b).max(axis=1) > 8).mean()


class KeptDepth(unittest.TestCase):
    """Where the framebuffer is not cleared, what it has kept hides and is hidden."""

    def pictures(self, prepare, before=None):
        result = []
        for traced in (False, True):
            renderer = new_renderer(traced)
            renderer.AddActor(new_actor(mapper_of(vtk.vtkConeSource())))
            window = new_window(*([before()] if before else []), renderer)
            prepare(window, renderer)
            result.append(picture(window))
        return result

    def expect_same(self, prepare, before=None):
        plain, traced = self.pictures(prepare, before)
        self.assertLess(share(plain, traced), 0.001)

    @staticmethod
    def turn(window, renderer):
        renderer.GetActiveCamera().Azimuth(60)
        window.Render()

    def test_window_without_erase(self):
        def prepare(window, renderer):
            window.Render()
            window.EraseOff()
            self.turn(window, renderer)
        self.expect_same(prepare)

    def test_renderer_without_erase(self):
        def prepare(window, renderer):
            window.Render()
            renderer.EraseOff()
            self.turn(window, renderer)
        self.expect_same(prepare)

    def test_preserved_depth(self):
        def prepare(window, renderer):
            window.Render()
            renderer.PreserveDepthBufferOn()
            self.turn(window, renderer)
        self.expect_same(prepare)

    def test_erased_again(self):
        def prepare(window, renderer):
            window.EraseOff()
            self.turn(window, renderer)
            window.EraseOn()
            self.turn(window, renderer)
        self.expect_same(prepare)

    def test_layers(self):
        for depth_is_kept in (False, True):
            def below():
                renderer = vtk.vtkRenderer()
                ball = vtk.vtkSphereSource()
                ball.SetRadius(0.45)
                renderer.AddActor(new_actor(mapper_of(ball)))
                return renderer

            def prepare(window, renderer):
                window.SetNumberOfLayers(2)
                renderer.SetLayer(1)
                renderer.SetPreserveDepthBuffer(depth_is_kept)
                other = window.GetRenderers().GetFirstRenderer()
                other.ResetCamera()
                renderer.SetActiveCamera(other.GetActiveCamera())
                window.Render()
            with self.subTest(depth_is_kept=depth_is_kept):
                self.expect_same(prepare, below)


class SharedMapper(unittest.TestCase):
    """VTK's mapper keeps a shader from one actor to the next."""

    LOOKS = {
        "surface": lambda p: None,
        "wireframe": lambda p: (p.SetRepresentationToWireframe(), p.SetColor(0, 0, 0)),
        "edges": lambda p: p.EdgeVisibilityOn(),
        "points": lambda p: (p.SetRepresentationToPoints(), p.SetPointSize(5)),
        "culled": lambda p: (p.BackfaceCullingOn(), p.SetColor(0, 1, 0)),
        "translucent": lambda p: (p.SetOpacity(0.5), p.SetColor(1, 0, 0)),
    }

    def frames(self, looks, traced, change):
        """Two frames of actors next to each other, with one mapper, and how many errors were said: VTK 9.6 gives the
        shader that is kept a texture too little where edges come after another look, without the pass, too."""
        said = []

        def listen(speaker):
            speaker.AddObserver("ErrorEvent", lambda *_: said.append(1))
        cube = vtk.vtkCubeSource()
        cube.Update()
        cube.GetOutput().GetPointData().SetNormals(None)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(cube.GetOutput())
        listen(mapper)
        renderer = new_renderer(traced)
        actors = []
        for i, look in enumerate(looks):
            actor = new_actor(mapper)
            actor.SetPosition(0.7 * i, 0, 0)
            self.LOOKS[look](actor.GetProperty())
            change(look, actor)
            listen(actor)
            renderer.AddActor(actor)
            actors.append(actor)
        renderer.GetActiveCamera().SetPosition(4, 3, 6)
        renderer.ResetCamera()
        window = new_window(renderer)
        result = []
        for i in range(2):
            window.Render()
            result.append(picture(window))
        return result, len(said)

    def expect_same(self, looks, change=lambda look, actor: None):
        with self.subTest(looks=looks):
            plain, plainly_said = self.frames(looks, False, change)
            traced, said = self.frames(looks, True, change)
            for i, frame in enumerate(traced):
                self.assertLess(share(plain[i], frame), 0.002, "frame %d" % i)
            self.assertLessEqual(said, plainly_said)

    def test_two_actors(self):
        for other in ("wireframe", "edges", "culled"):
            self.expect_same(("surface", other))
            self.expect_same((other, "surface"))
        self.expect_same(("wireframe", "edges"))
        self.expect_same(("edges", "wireframe"))

    def test_three_actors(self):
        for looks in (("surface", "wireframe", "edges"), ("wireframe", "surface", "points"),
                      ("surface", "surface", "wireframe"), ("culled", "surface", "translucent")):
            self.expect_same(looks)

    def test_backface_property(self):
        def change(look, actor):
            if look == "surface":
                back = vtk.vtkProperty()
                back.SetColor(1, 0, 0)
                actor.SetBackfaceProperty(back)
        # VTK itself crashes with the other order.
        self.expect_same(("surface", "wireframe"), change)

    def test_told_not_to_be_traced(self):
        def change(look, actor):
            if look == "surface":
                vtksvo.vtkSVORenderPass.SetUseSVO(False, actor)
        self.expect_same(("wireframe", "surface"), change)
        self.expect_same(("surface", "wireframe"), change)

    def test_only_those_that_draw_count(self):
        cube = vtk.vtkCubeSource()
        mapper = mapper_of(cube)
        renderer = new_renderer(True)
        surface, other = new_actor(mapper), new_actor(mapper)
        other.SetPosition(1.5, 0, 0)
        renderer.AddActor(surface)
        renderer.AddActor(other)
        window = new_window(renderer)
        svo = renderer.GetPass()

        def count():
            window.Render()
            return svo.GetNumberOfTracedActors()
        self.assertEqual(count(), traced(2))
        other.GetProperty().SetRepresentationToWireframe()
        self.assertEqual(count(), traced(0))
        other.VisibilityOff()
        self.assertEqual(count(), traced(1))
        other.VisibilityOn()
        self.assertEqual(count(), traced(0))
        other.SetMapper(mapper_of(cube))
        self.assertEqual(count(), traced(1))
        other.SetMapper(mapper)
        self.assertEqual(count(), traced(0))
        # An assembly is drawn as a whole.
        parts = vtk.vtkAssembly()
        second = mapper_of(cube)
        for each in (mapper, second):
            parts.AddPart(new_actor(each))
        renderer.AddActor(parts)
        third = new_actor(second)
        renderer.AddActor(third)
        self.assertEqual(count(), traced(0))
        renderer.RemoveActor(other)
        self.assertEqual(count(), traced(4))


class NoMeshes(unittest.TestCase):
    """A composite mapper is asked nothing about what VTK does not draw either."""

    @staticmethod
    def inputs():
        cells = vtk.vtkCellTypeSource()
        cells.Update()
        grid = cells.GetOutput()
        ball = vtk.vtkSphereSource()
        ball.Update()
        tree = vtk.vtkMultiBlockDataSet()
        tree.SetBlock(0, grid)
        nested = vtk.vtkMultiBlockDataSet()
        nested.SetBlock(1, tree)
        mixed = vtk.vtkMultiBlockDataSet()
        mixed.SetBlock(0, ball.GetOutput())
        mixed.SetBlock(1, nested)
        kinds = {"grid": grid, "table": vtk.vtkTable(), "nested": nested, "mixed": mixed}
        if vtk.vtkVersion.GetVTKMajorVersion() * 100 + vtk.vtkVersion.GetVTKMinorVersion() >= 903:
            del kinds["nested"], kinds["mixed"]  # VTK 9.3 crashes, without the pass, too
        return kinds

    def test_as_silent_as_vtk(self):
        for name in ("vtkCompositePolyDataMapper", "vtkCompositePolyDataMapper2"):
            if not hasattr(vtk, name):
                continue
            for kind, data in self.inputs().items():
                said, pictures = [], []
                for traced in (False, True):
                    mapper = getattr(vtk, name)()
                    mapper.SetInputDataObject(data)
                    said.append([])
                    mapper.AddObserver("ErrorEvent", lambda *_: said[-1].append(1))
                    renderer = new_renderer(traced)
                    renderer.AddActor(new_actor(mapper))
                    window = new_window(renderer)
                    window.Render()
                    window.Render()
                    pictures.append(picture(window))
                with self.subTest(mapper=name, data=kind):
                    self.assertEqual(len(said[0]), len(said[1]))
                    self.assertLess(share(*pictures), 0.002)


class Multisampling(unittest.TestCase):
    """Each sample of a pixel has the depth that it has on the facet."""

    @staticmethod
    def scene(source, traced, lines, change, samples):
        renderer = new_renderer(traced)
        for each, colour in [(source, (1, 1, 1))] + ([(lines, (0, 0, 0))] if lines else []):
            mapper = mapper_of(each)
            mapper.ScalarVisibilityOff()
            actor = new_actor(mapper)
            actor.GetProperty().SetColor(colour)
            renderer.AddActor(actor)
            if each is source:
                change(actor)
        renderer.ResetCamera()
        renderer.GetActiveCamera().Elevation(30)
        renderer.GetActiveCamera().Azimuth(20)
        renderer.ResetCameraClippingRange()
        window = new_window(renderer, samples=samples)
        window.Render()
        return window

    def compare(self, source, lines=None, change=lambda actor: None):
        """Share of pixels that differ, and of depths that do by more than 1e-6."""
        windows = [self.scene(source, traced, lines, change, 4) for traced in (False, True)]
        near = [depths(window) for window in windows]
        both = (near[0] < 1) & (near[1] < 1)
        apart = (abs(near[0] - near[1])[both] > 1e-6).mean()
        return share(*(picture(window) for window in windows)), apart

    def contoured(self, source):
        heights = vtk.vtkElevationFilter()
        heights.SetInputConnection(source.GetOutputPort())
        heights.SetLowPoint(0, -0.5, 0)
        heights.SetHighPoint(0, 0.5, 0)
        lines = vtk.vtkContourFilter()
        lines.SetInputConnection(heights.GetOutputPort())
        lines.GenerateValues(12, 0.02, 0.98)
        return heights, lines

    def test_lines_on_a_plane(self):
        plane = vtk.vtkPlaneSource()
        plane.SetResolution(5, 5)
        different, apart = self.compare(*self.contoured(plane))
        self.assertLess(different, 0.002)
        self.assertLess(apart, 0.002)

    def test_lines_on_facets(self):
        for resolution in (8, 24):
            ball = vtk.vtkSphereSource()
            ball.SetThetaResolution(resolution)
            ball.SetPhiResolution(resolution)
            for flat in (False, True):
                def change(actor):
                    if flat:
                        actor.GetProperty().SetInterpolationToFlat()
                with self.subTest(resolution=resolution, flat=flat):
                    different, apart = self.compare(*self.contoured(ball), change)
                    self.assertLess(different, 0.01)
                    self.assertLess(apart, 0.02)

    def test_depths_of_a_box(self):
        """Creases, too, where no light shows them."""
        different, apart = self.compare(
            vtk.vtkCubeSource(), None, lambda actor: actor.GetProperty().LightingOff())
        self.assertLess(different, 0.002)
        self.assertLess(apart, 0.01)

    def test_offsets(self):
        """VTK adds them to the depth of the pixel's centre."""
        mode = vtk.vtkMapper.GetResolveCoincidentTopology()
        vtk.vtkMapper.SetResolveCoincidentTopologyToPolygonOffset()
        try:
            plane = vtk.vtkPlaneSource()
            different, apart = self.compare(*self.contoured(plane))
            self.assertLess(different, 0.01)
            self.assertLess(apart, 0.01)
        finally:
            vtk.vtkMapper.SetResolveCoincidentTopology(mode)


class Tubes(unittest.TestCase):
    """Lines as tubes that receive shadows, before a plane."""

    def drawn(self):
        """Depths of the picture."""
        renderer = vtk.vtkRenderer()
        svo = new_pass()
        renderer.SetPass(svo)
        plane, line, heights = vtk.vtkPlaneSource(), vtk.vtkLineSource(), vtk.vtkElevationFilter()
        line.SetPoint1(-0.4, -0.4, 0.2)
        line.SetPoint2(0.4, 0.3, 0.3)
        heights.SetInputConnection(line.GetOutputPort())
        for source in plane, heights:
            mapper = mapper_of(source)
            mapper.InterpolateScalarsBeforeMappingOn()
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, -4.0)
            actor = new_actor(mapper)
            actor.GetProperty().SetLineWidth(12)
            actor.GetProperty().RenderLinesAsTubesOn()
            renderer.AddActor(actor)
        light = vtk.vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(1, 2, 5)
        renderer.AddLight(light)
        renderer.GetActiveCamera().Elevation(30)
        renderer.ResetCamera()
        window = new_window(renderer)
        window.Render()
        return depths(window)

    def test_a_small_offset_moves_them_a_little(self):
        """VTK's shaders take the slope of a depth that is not written yet."""
        before = self.drawn()
        mode = vtk.vtkMapper.GetResolveCoincidentTopology()
        vtk.vtkMapper.SetResolveCoincidentTopologyToPolygonOffset()
        try:
            self.assertLess(abs(self.drawn() - before).max(), 0.01)
        finally:
            vtk.vtkMapper.SetResolveCoincidentTopology(mode)


class OtherWindows(unittest.TestCase):
    """What a pass has in OpenGL it has in one window, and nobody else's goes with it."""

    @staticmethod
    def balls(traced, samples, count):
        renderer = new_renderer(traced)
        for i in range(count):
            ball = vtk.vtkSphereSource()
            ball.SetCenter(i, 0, 0)
            renderer.AddActor(new_actor(mapper_of(ball)))
        window = new_window(renderer, samples=samples)
        window.Render()
        return renderer, window

    def expect_untouched(self, let_go):
        for samples in (0, 4):
            with self.subTest(samples=samples):
                renderer, window = self.balls(True, samples, 1)
                other = self.balls(False, samples, 20)[1]
                before = picture(other)
                let_go(renderer, window, other)
                other.Render()
                self.assertEqual(abs(before - picture(other)).max(), 0)

    def test_a_pass_that_goes(self):
        def let_go(renderer, window, other):
            renderer.SetPass(None)
        self.expect_untouched(let_go)

    def test_resources_that_are_released(self):
        def let_go(renderer, window, other):
            renderer.GetPass().ReleaseGraphicsResources(other)
        self.expect_untouched(let_go)

    def test_a_window_that_goes(self):
        def let_go(renderer, window, other):
            window.Finalize()
        self.expect_untouched(let_go)

    def test_one_pass_in_two_windows(self):
        renderer, window = self.balls(True, 0, 1)
        second, other = self.balls(False, 0, 2)
        plain = picture(other)
        second.SetPass(renderer.GetPass())
        other.Render()
        self.assertLess(share(plain, picture(other)), 0.001)
        before = picture(window)
        other.RemoveRenderer(second)
        other.Finalize()
        window.Render()
        self.assertEqual(abs(before - picture(window)).max(), 0)


if __name__ == "__main__":
    unittest.main()
