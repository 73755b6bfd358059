"""Copies of glyphs, balls of splats and light shadows, for TestParallelCopies.py to compare. Runs in pvbatch on any
number of processes, or in pvpython as the client of a server.

usage: copies_in_parallel.py prefix [port of a server on this machine]
"""

import sys

import paraview.simple as pv
import scene

prefix = sys.argv[1]
view = scene.make_parallel_view(int(sys.argv[2]) if len(sys.argv) > 2 else None)
view.SVOShadowsForEverything = 1
scene.show(scene.make_ground(), view, "Surface")  # splats have ParaView cut what it orders among processes
points = pv.Sphere(Center=[0, 0, 1.1], Radius=0.7, ThetaResolution=15, PhiResolution=12)


def picture(name):
    scene.picture(view, f"{prefix}-{name}")


glyphs = scene.show(points, view, "3D Glyphs")
glyphs.Orient = 1
glyphs.SelectOrientationVectors = "Normals"
glyphs.Scaling = 1
glyphs.ScaleFactor = 0.3
picture("glyphs")
for step in range(1, 4):  # an animation
    glyphs.ScaleFactor = 0.3 + 0.1 * step
    view.SMProxy.InteractiveRender()
picture("larger")
view.CameraPosition = [4.0, 5.0, 3.0]
picture("turned")
splats = scene.show(points, view, "Point Gaussian")
splats.ShaderPreset = "Sphere"
splats.GaussianRadius = 0.1
picture("splats")
print("instances of this process:", int(scene.statistic(view, "SVONumberOfInstances")))
