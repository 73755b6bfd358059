"""The installed paraview-vtksvo, for pvpython and pvbatch: ParaView lists the plugin without loading it, loads
it by its name, and the representation SVO casts a shadow.

usage: check_paraview.py folder for pictures
"""

import os
import sys

import paraview.simple as pv
from paraview import servermanager

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from judge import check_shadow

listed = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
plugins = {listed.GetPluginName(i): i for i in range(listed.GetNumberOfPlugins())}
ours = plugins["SparseVoxelOctree"]
print("ParaView", pv.GetParaViewVersion(), "lists", len(plugins), "plugins, ours in",
      listed.GetPluginFileName(ours))
assert len(plugins) > 10, "its own plugins are lost"
assert not listed.GetPluginLoaded(ours), "loaded without being asked"
pv.LoadDistributedPlugin("SparseVoxelOctree", remote=False, ns=globals())

view = pv.CreateView("RenderView")
view.ViewSize = [400, 300]
view.OrientationAxesVisibility = 0
view.UseLight = 0
view.CameraPosition = [0, -6, 6]
view.CameraFocalPoint = [0, 0, 0.5]
view.CameraViewUp = [0, 0, 1]
light = pv.AddLight(view=view)
light.Coords = "Scene"
light.Type = "Directional"
light.Position = [3, -2, 5]
light.FocalPoint = [0, 0, 0]
for source in (pv.Sphere(Center=[0, 0, 1]), pv.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0])):
    pv.Show(source, view).Representation = "SVO"


def write(name):
    file = os.path.join(sys.argv[1], name)
    pv.SaveScreenshot(file, view, ImageResolution=[400, 300])
    return file


shadowed = write("paraview-shadowed.png")
view.SVOShadowTechnique = "None"
plain = write("paraview-plain.png")
check_shadow(shadowed, plain)
