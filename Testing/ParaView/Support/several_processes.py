"""Pictures of one scene, for TestParallel.py to compare. Runs in pvbatch on any number of processes, or in
pvpython as the client of a server.

usage: several_processes.py prefix [port of a server on this machine]
"""

import sys

import paraview.simple as pv
import scene

prefix = sys.argv[1]
served = len(sys.argv) > 2
view = scene.make_parallel_view(int(sys.argv[2]) if served else None)
ball, ground = scene.make_ball(), scene.make_ground()
displays = [scene.show(source, view) for source in (ball, ground)]
# ParaView 5.12 renamed the filter and its array.
ids = getattr(pv, "ProcessIds" if hasattr(pv, "ProcessIds") else "ProcessIdScalars")(Input=ball)
ids.UpdatePipeline()
array, = [name for name in ids.PointData.keys() if "ProcessId" in name]
print("processes with data:", int(ids.PointData[array].GetRange()[1]) + 1)


def picture(name):
    return scene.picture(view, f"{prefix}-{name}")


# Triangles smaller than pixels, so that rays stop at coarse nodes.
smooth = ball.ThetaResolution, ball.PhiResolution
ball.ThetaResolution = ball.PhiResolution = 700
picture("level-of-detail")
view.SVOPixelError = 2
picture("coarse")
view.SVOPixelError = 0
picture("full-depth")
view.SVOPixelError = 1
# What changes right before interactive frames: those do not wait for octrees, the still picture does.
builds = scene.statistic(displays[0], "SVONumberOfBuilds")
displays[0].SVOMaximumLevel = 8
view.SMProxy.InteractiveRender()
print("octrees built before a level changed:", builds, "and by the next interactive frame:",
      scene.statistic(displays[0], "SVONumberOfBuilds") - builds)
ball.ThetaResolution, ball.PhiResolution = smooth
for _ in range(3):
    view.SMProxy.InteractiveRender()
displays[0].SVOMaximumLevel = 10
view.SMProxy.InteractiveRender()
picture("shadow")
print("traced:", int(scene.statistic(view, "SVONumberOfTracedActors")),
      "instances:", int(scene.statistic(view, "SVONumberOfInstances")),
      "sample distance:", scene.statistic(view, "SVOImageSampleDistance"),
      "time:", "known" if scene.statistic(view, "SVOTraceTime") > 0 else "unknown")
# Servers reduce interactive images, by a factor that the largest distance of rays must not be multiplied with.
view.ImageReductionFactor = 4
view.SVOMaximumImageSampleDistance = 2  # a pixel of theirs is more
view.SMProxy.InteractiveRender()
print("sample distance where images are reduced:", scene.statistic(view, "SVOImageSampleDistance"))
view.ImageReductionFactor = 2
view.SVOMaximumImageSampleDistance = 8
# Levels of detail, which for these surfaces are the surfaces, on the processes that draw: with a server, the
# client's and then the server's.
pv.GetSettingsProxy("RenderViewSettings").LODThreshold = 0.0
for threshold, name in (1e6, "drawn-by-the-client"), (0.0, "drawn-by-the-server"):
    view.RemoteRenderThreshold = threshold
    pv.Render(view)
    view.SMProxy.InteractiveRender()
    displays[0].SVOMaximumLevel = 9
    view.SMProxy.InteractiveRender()
    displays[0].SVOMaximumLevel = 10
    view.SMProxy.InteractiveRender()
    picture(name)
pv.GetSettingsProxy("RenderViewSettings").LODThreshold = 20.0
scene.move(displays[0], [0.3, -0.2, 0.1])
displays[0].Scale = [1.0, 1.2, 0.9]
picture("moved")
view.CameraPosition = [4.0, 5.0, 3.0]
picture("turned")
view.SVOShadowTechnique = "Shadow Rays"
picture("rays")
view.SVOShadowTechnique = "Automatic"
picture("automatic")
view.SVOShadowTechnique = "Shadow Buffer"
# Each process has a context of its own, and so have a server and its client.
view.SVOBackend = "OpenGL"
picture("buffer-opengl")
view.SVOShadowTechnique = "Shadow Rays"
picture("rays-opengl")
print("backend:", int(scene.statistic(view, "SVOActiveBackend")))
view.SVOBackend = "Auto"
# Each process has the pixels of its pieces: what the filter takes from around them ends with these. Where lights are
# sampled several processes take rays to all of them.
view.SVOShadowTechnique = "Shadow Rays"
view.SVOFilterLightSamples = 0
light = view.AdditionalLights[0]
light.SVOSize = 12.0
picture("soft-light")
light.SVOSize = 0.0
view.SVOAmbientOcclusion = 1
picture("occlusion")
view.SVOAmbientOcclusion = 0
view.SVOSkyLight = 1
picture("sky")
view.SVOFilterLightSamples = 1
picture("sky-filtered")
view.SVOSkyLight = 0
view.SVOShadowTechnique = "Shadow Buffer"
displays[1].Representation = "Surface"
picture("ordinary-ground")
displays[0].Representation = "Surface"
view.SVOShadowsForEverything = 1
picture("everything")
print("casts nothing:", scene.statistic(view, "SVOReasons").strip() or "nobody")
# ParaView orders translucent surfaces by sending parts of them as XML with appended data.
orders = scene.reads_appended_data()
if orders:
    displays[0].Opacity = 0.5
    view.SVOTranslucentShadows = 0
    pv.Render(view)
    print("casts nothing:", scene.statistic(view, "SVOReasons").strip())
    view.SVOTranslucentShadows = 1
    displays[0].Opacity = 1.0
pv.Hide(ground, view)
view.SVOShadowCatcher = "Below Z"
picture("shadow-ground")
view.SVOShadowCatcher = "None"
pv.Show(ground, view)
view.SVOShadowsForEverything = 0
displays[0].Representation = displays[1].Representation = "SVO"
view.UseLight = 1
pv.RemoveLight(view.AdditionalLights[0])
picture("light-kit")
if orders:
    displays[0].SVOCastShadows = 0  # as nothing does that is shown as Surface
    displays[0].Opacity = 0.5
    picture("translucent")
    for display in displays:
        display.Representation = "Surface"
    picture("translucent-surface")
if served:
    pv.Disconnect()
