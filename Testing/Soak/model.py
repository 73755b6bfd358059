"""Scenes as data: everything of a scene that can be set stands in plain dictionaries, and what is shown is made of
them. So a scene that was edited a thousand times can be made afresh."""

import random

from vtkmodules.vtkCommonCore import (
    VTK_UNSIGNED_CHAR, vtkFloatArray, vtkLookupTable, vtkPoints, vtkUnsignedCharArray)
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane, vtkPolyData, vtkSphere
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersSources import (
    vtkConeSource, vtkCubeSource, vtkLineSource, vtkPlaneSource, vtkPlatonicSolidSource, vtkSphereSource,
    vtkSuperquadricSource)
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTexture)
from vtksvo import vtkImplicitFunctionToSVO, vtkSVORenderPass


def sphere(size):
    source = vtkSphereSource()
    source.SetThetaResolution(3 + size)
    source.SetPhiResolution(3 + size // 2)
    return source


def cone(size):
    source = vtkConeSource()
    source.SetResolution(3 + size)
    return source


def quadric(size):
    source = vtkSuperquadricSource()
    source.ToroidalOn()
    source.SetThetaResolution(8 + size)
    source.SetPhiResolution(8 + size // 2)
    return source


def plane(size):
    source = vtkPlaneSource()
    source.SetResolution(1 + size // 8, 1 + size // 6)
    return source


def line(size):
    source = vtkLineSource()
    source.SetResolution(1 + size // 4)
    return source


def solid(size):
    source = vtkPlatonicSolidSource()
    source.SetSolidType(size % 5)
    return source


def surface(size):
    """An octree of a function, in a hull."""
    function, source = vtkSphere(), vtkImplicitFunctionToSVO()
    function.SetRadius(0.3 + size / 200)
    source.SetImplicitFunction(function)
    source.SetModelBounds(-0.7, 0.7, -0.7, 0.7, -0.7, 0.7 if size % 2 else 0.1)
    source.SetMaximumLevel(6)
    return source


SOURCES = {"surface": surface, "sphere": sphere, "cone": cone, "quadric": quadric, "plane": plane, "line": line, "solid": solid,
           "cube": lambda size: vtkCubeSource()}


def shift_points(mesh, seed):
    """Points are moved in place; by how much depends on the seed and on nothing before. A hull's stay."""
    original = mesh.original_points
    if not original:
        return
    rng = random.Random(seed)
    shift, points = [rng.uniform(-0.1, 0.1) for _ in range(9)], mesh.GetPoints()
    for i in range(points.GetNumberOfPoints()):
        place = original.GetPoint(i)
        points.SetPoint(i, *(place[k] + sum(shift[3 * k + m] * place[m] for m in range(3)) for k in range(3)))
    points.Modified()
    mesh.Modified()


def mesh_of(data):
    """A mesh of its own, with scalars at points and cells; None of an empty one."""
    source = SOURCES[data["kind"]](data["size"])
    source.Update()
    mesh = vtkPolyData()
    mesh.DeepCopy(source.GetOutput())
    if data["kind"] == "surface":
        mesh.original_points = None
        return mesh
    if not data["normals"]:
        mesh.GetPointData().SetNormals(None)
    for attributes, number in ((mesh.GetPointData(), mesh.GetNumberOfPoints()),
                               (mesh.GetCellData(), mesh.GetNumberOfCells())):
        values = vtkFloatArray()
        values.SetName("values")
        values.SetNumberOfValues(number)
        for i in range(number):
            values.SetValue(i, (7 * i % 11) / 10)
        attributes.SetScalars(values)
    mesh.original_points = vtkPoints()
    mesh.original_points.DeepCopy(mesh.GetPoints())
    if data["shift"] is not None:
        shift_points(mesh, data["shift"])
    return mesh


def set_mapper(actor, data, meshes):
    # VTK's other mappers (glyphs, blocks) crash now and then while they are edited, also without a pass; so does an
    # actor that loses its backface property.
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(meshes[data["mesh"]])
    actor.SetMapper(mapper)


def texture_of(color):
    if color is None:
        return None
    image, texture = vtkImageData(), vtkTexture()
    image.SetDimensions(2, 2, 1)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    for i in range(12):
        image.GetPointData().GetScalars().SetValue(i, int(255 * color[i % 3]) // (1 + i // 6))
    texture.SetInputData(image)
    return texture


def matrix_of(values):
    if values is None:
        return None
    matrix = vtkMatrix4x4()
    for i in range(3):
        for j in range(3):
            matrix.SetElement(i, j, values[3 * i + j])
    return matrix


def set_colors(actor, kind):
    mapper = actor.GetMapper()
    mapper.SetScalarVisibility(kind != "none")
    if kind == "cells":
        mapper.SetScalarModeToUseCellData()
    else:
        mapper.SetScalarModeToUsePointData()
    mapper.SetInterpolateScalarsBeforeMapping(kind == "table")
    table = vtkLookupTable()
    table.SetNumberOfTableValues(6 if kind == "table" else 256)
    if kind == "holes":
        table.SetAlphaRange(0.2, 1)
    table.Build()
    mapper.SetLookupTable(table)


def set_clipping(actor, height):
    actor.GetMapper().RemoveAllClippingPlanes()
    if height is not None:
        cut = vtkPlane()
        cut.SetOrigin(0, 0, height)
        cut.SetNormal(0, 0, -1)
        actor.GetMapper().AddClippingPlane(cut)


def set_texture(actor, color):
    # VTK may draw with a texture and buffers that were made without its coordinates, and crash.
    actor.SetTexture(texture_of(color))
    actor.GetMapper().Modified()


def set_lit(actor, how):
    # Not both: VTK's shader of edges as tubes does not compile without lighting, and VTK crashes.
    actor.GetProperty().SetLighting(how != "flat")
    actor.GetProperty().SetRenderLinesAsTubes(how == "tubes")


def set_light_type(light, kind):
    # VTK moves headlights and camera lights; what they become next begins where its data says.
    light.SetLightType(kind)
    light.SetTransformMatrix(None)


# What is set of an actor after its mapper, by name.
ACTOR = {
    "position": lambda a, v: a.SetPosition(v),
    "orientation": lambda a, v: a.SetOrientation(v),
    "scale": lambda a, v: a.SetScale(v),
    "matrix": lambda a, v: a.SetUserMatrix(matrix_of(v)),
    "visible": lambda a, v: a.SetVisibility(v),
    "color": lambda a, v: a.GetProperty().SetColor(v),
    "opacity": lambda a, v: a.GetProperty().SetOpacity(v),
    "ambient": lambda a, v: a.GetProperty().SetAmbient(v),
    "specular": lambda a, v: a.GetProperty().SetSpecular(v),
    "power": lambda a, v: a.GetProperty().SetSpecularPower(v),
    "lit": set_lit,
    "interpolation": lambda a, v: a.GetProperty().SetInterpolation(v),
    "representation": lambda a, v: a.GetProperty().SetRepresentation(v),
    "edges": lambda a, v: a.GetProperty().SetEdgeVisibility(v),
    "width": lambda a, v: a.GetProperty().SetLineWidth(v),
    "culled": lambda a, v: a.GetProperty().SetBackfaceCulling(v),
    "texture": set_texture,
    "colors": set_colors,
    "clipped": set_clipping,
    "casts": lambda a, v: vtkSVORenderPass.SetCastShadow(v, a),
    "receives": lambda a, v: vtkSVORenderPass.SetReceiveShadow(v, a),
    "traced": lambda a, v: vtkSVORenderPass.SetUseSVO(v, a),
    "catcher": lambda a, v: vtkSVORenderPass.SetShadowCatcher(v, a),
    "pixel error": lambda a, v: vtkSVORenderPass.SetPropPixelError(v, a),
}
LIGHT = {
    "type": set_light_type,
    "position": lambda l, v: l.SetPosition(v),
    "focus": lambda l, v: l.SetFocalPoint(v),
    "positional": lambda l, v: l.SetPositional(v),
    "cone": lambda l, v: l.SetConeAngle(v),
    "exponent": lambda l, v: l.SetExponent(v),
    "color": lambda l, v: l.SetDiffuseColor(v),
    "intensity": lambda l, v: l.SetIntensity(v),
    "on": lambda l, v: l.SetSwitch(v),
    "casts": lambda l, v: vtkSVORenderPass.SetCastShadow(v, l),
}
CAMERA = {
    "position": lambda c, v: c.SetPosition(v),
    "focus": lambda c, v: c.SetFocalPoint(v),
    "up": lambda c, v: c.SetViewUp(v),
    "angle": lambda c, v: c.SetViewAngle(v),
    "parallel": lambda c, v: c.SetParallelProjection(v),
    "scale": lambda c, v: c.SetParallelScale(v),
    "range": lambda c, v: c.SetClippingRange(v),
}
PASS = {name: lambda p, v, name=name: getattr(p, "Set" + name)(v) for name in (
    "ShadowTechnique", "ShadowBufferResolution", "AutomaticShadowBias", "ShadowBias", "ShadowIntensity",
    "TranslucentShadows", "PixelError", "ConvertPolyData", "MaximumLevel", "LeafGeometry", "OctreeMemoryLimit",
    "FrameCoherence", "LayerMemoryLimit", "AntiAliasing", "ViewCulling", "OcclusionCulling",
    "ShadowsForEverything", "Backend", "GPUMemoryLimit")}


def apply(table, target, data):
    for name, set_value in table.items():
        set_value(target, data[name])


class View:
    """A window with its renderer, pass, actors and lights, made of a dictionary."""

    def __init__(self, data, meshes):
        self.data, self.meshes = data, meshes
        self.renderer, self.svo = vtkRenderer(), vtkSVORenderPass()
        self.renderer.AutomaticLightCreationOff()
        self.actors, self.lights = [], []
        apply(PASS, self.svo, data["pass"])
        apply(CAMERA, self.renderer.GetActiveCamera(), data["camera"])
        for one in data["actors"]:
            self.add_actor(one)
        for one in data["lights"]:
            self.add_light(one)
        self.set_background(data["background"])
        self.set_traced(data["traced"])
        self.open()

    def open(self):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(self.data["samples"])
        self.window.SetSize(self.data["size"])
        self.window.AddRenderer(self.renderer)

    def close(self):
        self.window.RemoveRenderer(self.renderer)
        self.window.Finalize()
        self.window = None

    def set_traced(self, traced):
        self.renderer.SetPass(self.svo if traced else None)

    def set_background(self, color):
        self.renderer.SetBackground(color)

    def add_actor(self, data):
        actor = vtkActor()
        set_mapper(actor, data, self.meshes)
        apply(ACTOR, actor, data)
        self.renderer.AddActor(actor)
        self.actors.append(actor)

    def add_light(self, data):
        light = vtkLight()
        apply(LIGHT, light, data)
        self.renderer.AddLight(light)
        self.lights.append(light)

    def set_mesh(self, i):
        """Actor i shows another mesh, or shows it in another way."""
        data = self.data["actors"][i]
        set_mapper(self.actors[i], data, self.meshes)
        for name in ("colors", "clipped"):
            ACTOR[name](self.actors[i], data[name])

    def remove_actor(self, i):
        self.renderer.RemoveActor(self.actors.pop(i))

    def remove_light(self, i):
        self.renderer.RemoveLight(self.lights.pop(i))

    def picture(self):
        self.window.Render()
        width, height = self.data["size"]
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
        return bytes(memoryview(pixels))
