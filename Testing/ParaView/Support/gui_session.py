"""What TestGui.py has ParaView's client do: it makes a scene, and while the events of gui_events.py are played,
their checks are the functions here. Each leaves a line in the file that VTKSVO_DONE names."""

import os
import shutil
import subprocess
import traceback

import paraview.simple as pv
import scene

checks = {}
pictures = {}
ids_hovered = {}
states = []  # of what is watched, in the pictures since
watching = []


def check(function):
    checks[function.__name__] = function
    return function


def run(name, *arguments):
    """For the console of ParaView's Python shell."""
    try:
        checks[name](*arguments)
        result = "passed"
    except Exception:
        result = traceback.format_exc().replace("\n", " | ")
    with open(os.environ["VTKSVO_DONE"], "a") as done:
        done.write(f"{name}{arguments}: {result}\n")


def same(actual, expected):
    if actual != expected:
        raise AssertionError(f"{actual}, not {expected}")


def view():
    return pv.GetActiveView()


@check
def make_scene():
    render_view = pv.GetActiveViewOrCreate("RenderView")
    ball = pv.Sphere(registrationName="Ball", Center=[0, 0, 0.8], ThetaResolution=64,
                     PhiResolution=64)
    octrees = pv.PolyDataToSVO(registrationName="Octrees", Input=ball)
    ground = pv.Plane(registrationName="Ground", Origin=[-2, -2, 0], Point1=[2, -2, 0],
                      Point2=[-2, 2, 0])
    colored = pv.Elevation(registrationName="Colored", Input=octrees, LowPoint=[0, 0, 0.3],
                           HighPoint=[0, 0, 1.3])
    for source in ground, colored:
        pv.Show(source, render_view).SetRepresentationType("SVO")
    pv.ColorBy(pv.GetDisplayProperties(colored, render_view), ("POINTS", "Elevation"))
    pv.SetActiveSource(ground)
    render_view.CameraPosition = [5, -6, 4]
    render_view.CameraFocalPoint = [0, 0, 0.8]  # the ball in the middle
    render_view.CameraViewUp = [0, 0, 1]
    pv.Render(render_view)


@check
def make_sources():
    """Surfaces that are no meshes, as a user adds them: with the settings that they come with."""
    render_view = pv.GetActiveViewOrCreate("RenderView")
    wavelet = pv.Wavelet(registrationName="Wavelet")
    wavelet.UpdatePipeline()
    isosurface = pv.ImageToSVO(registrationName="Isosurface", Input=wavelet)
    ball = pv.ImplicitFunctionToSVO(registrationName="Function")
    for source in isosurface, ball:
        pv.Show(source, render_view)
    render_view.ResetCamera()
    pv.SetActiveSource(isosurface)
    pv.Render(render_view)


@check
def select(name):
    pv.SetActiveSource(pv.FindSource(name))


@check
def change(source, name, value):
    """A property of a source, as a script would."""
    setattr(pv.FindSource(source), name, value)
    pv.Render()


@check
def traced(number):
    """So many surfaces were traced in the last picture."""
    same(scene.statistic(view(), "SVONumberOfTracedActors"), number)


@check
def display_has(source, name, value):
    same(pv.GetDisplayProperties(pv.FindSource(source), view()).GetPropertyValue(name), value)


@check
def view_has(name, value):
    same(view().GetPropertyValue(name), value)


@check
def view_lacks(name):
    same(view().GetProperty(name), None)


@check
def remember(name):
    pictures[name] = scene.picture(view(), name)


@check
def looks_like(name, share=0):
    """At most that share of the pixels differs from the remembered picture."""
    difference = scene.differing(pictures[name], scene.picture(view(), name + "-again"), 2)
    if difference > share:
        raise AssertionError(f"{difference} of the pixels differ from {name}")


@check
def differs_from(name, share):
    """At least that share of the pixels differs from the remembered picture."""
    difference = scene.differing(pictures[name], scene.picture(view(), name + "-other"), 2)
    if difference < share:
        raise AssertionError(f"only {difference} of the pixels differ from {name}")


@check
def builds(source, number):
    same(scene.statistic(pv.GetDisplayProperties(pv.FindSource(source), view()),
                         "SVONumberOfBuilds"), number)


@check
def hovered(kind):
    """The mouse is over one cell or point of the ball; each time over the same one."""
    selection = view().GetClientSideObject().GetLastSelection()
    same(selection.GetNumberOfNodes(), 1)
    node = selection.GetNode(0)
    ids = node.GetSelectionList()
    same(ids.GetNumberOfTuples(), 1)
    same(node.GetFieldType(), {"cell": 0, "point": 1}[kind])
    same(ids.GetValue(0), ids_hovered.setdefault(kind, ids.GetValue(0)))


@check
def casting(number):
    """So many lights cast, in the panel's words."""
    lines = view().GetPropertyValue("SVOCastingLights").splitlines()
    same(sum("casts shadows" in line for line in lines), number)


@check
def watch(source, name):
    """From here on keeps after each picture a surface's property and the number of traced surfaces. The
    Python shell clears ParaView's list of what can be undone, so a change and its undoing must not have
    a check between them."""
    display = pv.GetDisplayProperties(pv.FindSource(source), view()).SMProxy
    states.clear()

    def rendered(*_):
        state = (display.GetProperty(name).GetElement(0),
                 scene.statistic(view(), "SVONumberOfTracedActors"))
        if state not in states[-1:]:
            states.append(state)

    while watching:
        view().SMProxy.RemoveObserver(watching.pop())
    watching.append(view().SMProxy.AddObserver("EndEvent", rendered))
    pv.Render()


@check
def watched(*expected):
    """The values that the pictures had, and how many surfaces were traced in them."""
    same(states, list(expected))


@check
def window(name):
    """A picture of the window to look at, where ffmpeg is there."""
    if shutil.which("ffmpeg"):
        subprocess.run(
            ["ffmpeg", "-y", "-loglevel", "error", "-nostdin", "-f", "x11grab",
             "-video_size", "1500x1050", "-i", os.environ["DISPLAY"], "-frames:v", "1",
             scene.output(name + ".png")], check=True)


