#!/usr/bin/python3
"""A room of objects to move about by the keyboard, as in Huang and Cheng's paper.

Usage: interactive.py [mesh file...]   (.stl .ply .obj .vtk .vtp ..., z up; default: three shapes)
The keys are written in the window; the mouse moves the camera. --frames N shows N frames and ends.
"""

import argparse
import os
import sys

import vtk
import vtksvo

HELP = """\
Tab          select the next object
arrows       move it on the ground
, and .      turn it
Space        its own spin, on or off
s            shadows, on or off
i            statistics, on or off
h            this help, on or off
q            quit"""
STEP = 0.08  # of an object's size
TURN = 6  # degrees
SPIN = 2  # degrees a frame
FRAME_MILLISECONDS = 20
COLOURS = [(0.36, 0.64, 0.56), (0.93, 0.42, 0.33), (0.50, 0.58, 0.70), (0.90, 0.82, 0.68)]


def read(path):
    """The surface of a mesh file; ends the program with one message if it cannot be read."""
    readers = {".stl": vtk.vtkSTLReader, ".ply": vtk.vtkPLYReader, ".obj": vtk.vtkOBJReader,
               ".vtk": vtk.vtkGenericDataObjectReader}
    if not os.path.isfile(path):
        sys.exit(f"interactive.py: there is no file {path}")
    reader = readers.get(os.path.splitext(path)[1].lower(), vtk.vtkXMLGenericDataObjectReader)()
    reader.SetFileName(path)
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    if surface.GetOutput().GetNumberOfPolys() == 0:
        sys.exit(f"interactive.py: {path} holds no polygons")
    return surface.GetOutput()


def stand_ins():
    """A ring, a rounded box and a spiky ball."""
    ring, box, ball = (vtk.vtkSuperquadricSource() for _ in range(3))
    ring.ToroidalOn()
    box.SetPhiRoundness(0.3)
    box.SetThetaRoundness(0.3)
    ball.SetPhiRoundness(2.2)
    ball.SetThetaRoundness(1.6)
    for source in ring, box, ball:
        source.SetThetaResolution(64)
        source.SetPhiResolution(64)
        source.Update()
        yield source.GetOutput()


class Thing:
    """An object that stands on the ground: a mesh, an actor and what it does by itself."""

    def __init__(self, mesh, position, colour):
        self.spins = False
        x, y, _ = mesh.GetCenter()
        bottom = mesh.GetBounds()[4]
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        self.actor = vtk.vtkActor()
        self.actor.SetMapper(mapper)
        self.actor.SetOrigin(x, y, bottom)
        self.actor.SetScale(1 / mesh.GetLength())
        self.actor.SetPosition(position - x, -y, -bottom)
        self.actor.GetProperty().SetColor(colour)
        self.actor.GetProperty().SetAmbient(0.15)
        self.actor.GetProperty().SetDiffuse(0.85)

    def move(self, right, back):
        self.actor.AddPosition(right * STEP, back * STEP, 0)

    def turn(self, degrees):
        self.actor.RotateZ(degrees)

    def select(self, selected):
        self.actor.GetProperty().SetAmbient(0.35 if selected else 0.15)


class Room:
    """The scene, and what each key does to it."""

    def __init__(self, meshes, offscreen=False):
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(0.16, 0.2, 0.28)
        self.svo = vtksvo.vtkSVORenderPass()
        self.renderer.SetPass(self.svo)
        meshes = list(meshes)
        self.things = [
            Thing(mesh, i - (len(meshes) - 1) / 2, COLOURS[i % len(COLOURS)])
            for i, mesh in enumerate(meshes)
        ]
        for thing in self.things:
            self.renderer.AddActor(thing.actor)
        self.selected = 0
        self.things[0].select(True)
        self.add_ground()
        self.add_light()
        self.help = self.add_text(HELP, top=True)
        self.statistics = self.add_text("", top=False)
        self.statistics.SetVisibility(False)

        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0.8, -2.4 - 0.4 * len(meshes), 1.5)
        camera.SetFocalPoint(0, 0, 0.2)
        camera.SetViewUp(0, 0, 1)

        self.window = vtk.vtkRenderWindow()
        self.window.SetWindowName("vtkSVO")
        self.window.SetSize(1280, 720)
        self.window.SetMultiSamples(0)
        self.window.SetOffScreenRendering(offscreen)
        self.window.AddRenderer(self.renderer)
        self.interactor = vtk.vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(vtk.vtkInteractorStyleTrackballCamera())
        # VTK's own letters (s is "surface" there) would work beside ours.
        self.interactor.RemoveObservers("CharEvent")
        self.interactor.AddObserver("KeyPressEvent", self.on_key)
        self.interactor.AddObserver("TimerEvent", self.on_timer)

        self.keys = {
            "Tab": self.select_next,
            "Left": lambda: self.current().move(-1, 0),
            "Right": lambda: self.current().move(1, 0),
            "Up": lambda: self.current().move(0, 1),
            "Down": lambda: self.current().move(0, -1),
            "comma": lambda: self.current().turn(TURN),
            "period": lambda: self.current().turn(-TURN),
            "space": self.toggle_spin,
            "s": self.toggle_shadows,
            "i": lambda: self.toggle(self.statistics),
            "h": lambda: self.toggle(self.help),
            "q": self.interactor.TerminateApp,
        }

    def add_ground(self):
        ground = vtk.vtkPlaneSource()
        ground.SetOrigin(-20, -20, 0)
        ground.SetPoint1(20, -20, 0)
        ground.SetPoint2(-20, 20, 0)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(ground.GetOutputPort())
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.8, 0.76, 0.7)
        actor.GetProperty().SetAmbient(0.15)
        actor.GetProperty().SetDiffuse(0.85)
        # Nothing lies below the ground: as a caster it would only coarsen the light's map.
        self.svo.SetCastShadow(False, actor)
        self.renderer.AddActor(actor)

    def add_light(self):
        light = vtk.vtkLight()
        light.SetPositional(True)
        light.SetConeAngle(180)
        light.SetPosition(-1.5, -2, 3.5)
        self.renderer.AddLight(light)

    def add_text(self, text, top):
        actor = vtk.vtkTextActor()
        actor.SetInput(text)
        actor.GetTextProperty().SetFontFamilyToCourier()
        actor.GetTextProperty().SetFontSize(16)
        actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedDisplay()
        actor.SetPosition(0.015, 0.98 if top else 0.02)
        if top:
            actor.GetTextProperty().SetVerticalJustificationToTop()
        self.renderer.AddViewProp(actor)
        return actor

    def current(self):
        return self.things[self.selected]

    def select_next(self):
        self.current().select(False)
        self.selected = (self.selected + 1) % len(self.things)
        self.current().select(True)

    def toggle_spin(self):
        self.current().spins = not self.current().spins

    def toggle_shadows(self):
        if self.svo.GetShadowTechnique() == self.svo.SHADOW_NONE:
            self.svo.SetShadowTechniqueToShadowBuffer()
        else:
            self.svo.SetShadowTechniqueToNone()

    @staticmethod
    def toggle(text):
        text.SetVisibility(not text.GetVisibility())

    def on_key(self, interactor, _event):
        action = self.keys.get(interactor.GetKeySym())
        if action:
            action()
            self.draw()

    def on_timer(self, _interactor, _event):
        if any(thing.spins for thing in self.things):
            for thing in self.things:
                if thing.spins:
                    thing.turn(SPIN)
            self.draw()

    def draw(self):
        self.window.Render()
        if self.statistics.GetVisibility():
            # Of the frame just drawn; shown from the next one on.
            self.statistics.SetInput(
                f"{1000 * self.svo.GetTraceTime():6.1f} ms tracing\n"
                f"{1000 * self.svo.GetShadowTime():6.1f} ms shadows\n"
                f"{1000 * self.svo.GetPresentTime():6.1f} ms presenting\n"
                f"{self.svo.GetNumberOfPrimaryRays():9} primary rays\n"
                f"{self.svo.GetNumberOfShadowRays():9} shadow rays\n"
                f"{self.svo.GetNumberOfRetracedLayers():9} layers retraced")

    def run(self):
        self.interactor.Initialize()
        self.interactor.CreateRepeatingTimer(FRAME_MILLISECONDS)
        self.draw()
        self.interactor.Start()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("meshes", nargs="*", help="mesh files; without one, three shapes")
    parser.add_argument("--frames", type=int, default=0, help="offscreen: so many frames, then end")
    options = parser.parse_args()
    room = Room(map(read, options.meshes) if options.meshes else stand_ins(), options.frames > 0)
    if options.frames:
        for _ in range(options.frames):
            room.draw()
    else:
        room.run()


if __name__ == "__main__":
    main()
