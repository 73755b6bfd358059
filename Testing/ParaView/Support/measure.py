"""Figures for the documentation, not a test: first and second loop of an animated mesh, and a camera
orbit beside the representation Surface. Runs in pvbatch.

usage: measure.py [mesh.md2]     without a mesh only the orbit
"""

import math
import resource
import sys
import time

import paraview.simple as pv
import scene
import series

ORBIT = 12


def loop(view, animation, steps):
    start = time.perf_counter()
    for step in range(steps):
        animation.AnimationTime = step
        pv.Render(view)
    return 1000 * (time.perf_counter() - start) / steps


def animate(poses, level):
    view = scene.make_view((1920, 1080))
    view.UseFXAA = 0
    scene.add_sun(view)
    scene.show(scene.make_ground(), view)
    reader = pv.PVDReader(FileName=poses)
    animation = pv.GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    steps = len(reader.TimestepValues)
    surface = scene.show(reader, view, "Surface")
    pv.Render(view)
    loop(view, animation, steps)
    print(f"Surface: {loop(view, animation, steps):.0f} ms a time step", flush=True)
    surface.Representation = "SVO"
    surface.SVOMaximumLevel = level
    first, second = (loop(view, animation, steps) for _ in range(2))
    print(f"SVO, level {level}, {steps} poses: first loop {first:.0f} ms a time step, second {second:.0f}; "
          f"{scene.statistic(surface, 'SVONumberOfBuilds')} octrees of "
          f"{scene.statistic(surface, 'SVOCacheMemorySize') / 1024:.0f} MiB", flush=True)
    pv.ResetSession()


def orbit(kind, kit, still):
    view = scene.make_view((1920, 1080))
    view.UseFXAA = 0
    view.UseLight = int(kit)
    if not kit:
        scene.add_sun(view)
    for source in scene.make_ball(), scene.make_ground():
        scene.show(source, view, kind)
    pv.Render(view)
    seconds = []
    for i in range(ORBIT):
        view.CameraPosition = [8 * math.sin(0.05 * i), -8 * math.cos(0.05 * i), 4.0]
        start = time.perf_counter()
        (view.SMProxy.StillRender if still else view.SMProxy.InteractiveRender)()
        seconds.append(time.perf_counter() - start)
    pv.ResetSession()
    return 1 / sorted(seconds)[ORBIT // 2]


scene.load_plugin()
for kit in (False, True):
    for still in (True, False):
        print(f"orbit, {'light kit' if kit else 'one light'}, {'still' if still else 'interactive'}: " +
              ", ".join(f"{kind} {orbit(kind, kit, still):.1f}" for kind in ("Surface", "SVO")) +
              " frames a second", flush=True)
if len(sys.argv) > 1:
    path = series.write(scene.output("poses"), series.md2(sys.argv[1]))
    for level in (8, 10):
        animate(path, level)
print(f"peak memory of the process: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB")
