"""Runs one script of VTK's with or without the pass, and keeps what its windows showed last.

usage: one_script.py plain|traced samples folder script

Nothing of the script is changed. Its windows are watched from when they are made: before a frame each of their
renderers without a pass of its own gets one that traces without shadows, and after a frame its pixels are kept. An
interactor that is started returns at once. What was never drawn is drawn once at the end, as VTK's tests are.
The folder gets picture-<n>.ppm for each window, in the order in which they were made.
"""

import os
import random
import sys
import types

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

mode, samples, folder, script = sys.argv[1], int(sys.argv[2]), sys.argv[3], os.path.abspath(sys.argv[4])
if mode == "traced":
    import vtksvo

# Classes that hold a window, by the modules that have them: whatever their names are imported from, it is from there.
windows = {"vtkRenderingCore": ["vtkRenderWindow"]}
owners = {
    "vtkInteractionImage": ["vtkImageViewer2", "vtkResliceImageViewer"],
    "vtkViewsContext2D": ["vtkContextView"],
    "vtkViewsCore": ["vtkRenderViewBase"],
    "vtkViewsInfovis": ["vtkRenderView", "vtkGraphLayoutView", "vtkHierarchicalGraphView", "vtkIcicleView",
                        "vtkParallelCoordinatesView", "vtkTreeAreaView", "vtkTreeMapView", "vtkTreeRingView"],
}
watched = []


class Watched:
    """A window, and its pixels after its last frame."""

    def __init__(self, window):
        self.window = window
        self.renderers = []
        self.size = None
        self.pixels = vtkUnsignedCharArray()
        window.AddObserver("StartEvent", self.before, 1e6)
        window.AddObserver("EndEvent", self.after, -1e6)
        watched.append(self)

    def before(self, *_):
        self.window.SetMultiSamples(samples)
        if self.window.GetInteractor():
            meet_interactor(self.window.GetInteractor())
        if mode == "traced":
            renderers = self.window.GetRenderers()
            for i in range(renderers.GetNumberOfItems()):
                renderer = renderers.GetItemAsObject(i)
                if renderer not in self.renderers:
                    self.renderers.append(renderer)
                    if not renderer.GetPass():
                        svo = vtksvo.vtkSVORenderPass()
                        svo.SetShadowTechniqueToNone()
                        renderer.SetPass(svo)

    def after(self, *_):
        width, height = self.window.GetActualSize()
        if width > 0 and height > 0:
            self.window.GetPixelData(0, 0, width - 1, height - 1, 0, self.pixels, 0)
            self.size = width, height

    def write(self, path):
        # PPM begins at the top.
        width, height = self.size
        values = bytes(memoryview(self.pixels))
        rows = [values[3 * width * y:3 * width * (y + 1)] for y in range(height)]
        with open(path, "wb") as file:
            file.write(b"P6 %d %d 255\n" % self.size + b"".join(reversed(rows)))


def made_by(real, meet):
    """A class in the place of another one: what it makes is met, what derives from it is what it was."""
    def new(cls, *arguments):
        if cls is not stand_in:
            return real.__new__(cls, *arguments)
        made = real(*arguments)
        meet(made)
        return made

    def init(self, *arguments):
        meet(self)

    stand_in = type(real.__name__, (real,), {"__new__": new, "__init__": init, "__module__": real.__module__})
    return stand_in


def replace(module, names, meet):
    try:
        module = __import__(f"vtkmodules.{module}", fromlist=["*"])
    except ImportError:
        return
    for name in names:
        if hasattr(module, name):
            setattr(module, name, made_by(getattr(module, name), meet))


def meet_interactor(interactor):
    # An interactor whose StartEvent is observed leaves the loop to the observer.
    if not interactor.HasObserver("StartEvent"):
        interactor.AddObserver("StartEvent", lambda *_: interactor.GetInitialized() or interactor.Initialize())


def meet_owner(owner):
    Watched(owner.GetRenderWindow())
    if hasattr(owner, "GetInteractor") and owner.GetInteractor():
        meet_interactor(owner.GetInteractor())


for name, classes in windows.items():
    replace(name, classes, Watched)
for name, classes in owners.items():
    replace(name, classes, meet_owner)
replace("vtkRenderingCore", ["vtkRenderWindowInteractor"], meet_interactor)

# There are no baselines. The module is there twice, by two names.
for name in ("vtkmodules.test.Testing", "vtk.test.Testing"):
    try:
        __import__(name)
        sys.modules[name].compareImage = lambda window, *_, **__: window.Render()
    except ImportError:
        pass

random.seed(1)
try:
    import numpy
    numpy.random.seed(1)
except ImportError:
    pass
sys.argv = [script]
sys.path[0] = os.path.dirname(script)
main = types.ModuleType("__main__")
main.__file__ = script
sys.modules["__main__"] = main
status = 0
try:
    with open(script, "rb") as file:
        exec(compile(file.read(), script, "exec"), main.__dict__)
except SystemExit as ended:
    status = ended.code if isinstance(ended.code, int) else 1 if ended.code else 0
except BaseException:
    import traceback
    traceback.print_exc()
    status = 1
for one in watched:
    if one.size is None and one.window.GetRenderers().GetNumberOfItems():
        one.window.Render()
for i, one in enumerate(each for each in watched if each.size):
    one.write(os.path.join(folder, f"picture-{i}.ppm"))
sys.exit(status)
