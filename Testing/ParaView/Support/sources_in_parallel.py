"""Surfaces that are no meshes, for TestParallelSources.py to compare. Runs in pvbatch on any number of processes, or
in pvpython as the client of a server.

usage: sources_in_parallel.py prefix [port of a server on this machine]
"""

import os
import sys

import paraview.simple as pv
import scene

prefix = sys.argv[1]
served = len(sys.argv) > 2
view = scene.make_parallel_view(int(sys.argv[2]) if served else None)
view.CameraPosition = [100.0, -125.0, 105.0]
view.CameraFocalPoint = [0.0, 0.0, 0.0]


def picture(source, name, kind="SVO"):
    display = scene.show(source, view, kind)
    scene.picture(view, f"{prefix}-{name}")
    pv.Hide(source, view)
    return display


wavelet = pv.Wavelet(WholeExtent=[-24, 24, -24, 24, -24, 24], XFreq=20, YFreq=10, ZFreq=13)
image = pv.ImageToSVO(Input=wavelet, Value=140.0)  # not executed before: the active array
picture(image, "image")
image.MaximumLevel = 6
picture(image, "coarse-image")
image.Value = 240.0  # in the middle only
image.MaximumLevel = 8
picture(image, "small-image")
function = pv.ImplicitFunctionToSVO()
function.ImplicitFunction = "Sphere"
function.ImplicitFunction.Radius = 30.0
function.ModelBounds = [-31.0, 31.0] * 3
picture(function, "function")

# Written by all processes, read by all.
image.Value = 140.0
path = scene.output(prefix + ".vdb")
pv.SaveData(path, proxy=image)
reader = pv.SVOVDBReader(FileNames=[path])
reader.UpdatePipeline()
print("leaves:", reader.GetDataInformation().GetNumberOfCells(), "grids:",
      ", ".join(reader.GetProperty("GridName").GetAvailable()), "voxels:",
      scene.statistic(reader, "NumberOfVoxels"))
picture(reader, "vdb")
path = scene.output(prefix + "-function.vdb")
pv.SaveData(path, proxy=function, WriteLevelSet=1)
print("function's", os.path.exists(path), ", ".join(pv.SVOVDBReader(FileNames=[path]).GetProperty("GridName").GetAvailable()))

# Structure, of what may be on several processes.
picture(pv.SVOToPolyData(Input=image, Level=5), "cells", "Surface")
shadows = pv.ShadowsAsData(Input=pv.Sphere(ThetaResolution=30, PhiResolution=30, Radius=30))
shadows.UpdatePipeline()
print("exposure: %.3f to %.3f" % shadows.CellData["Exposure"].GetRange())
if served:
    pv.Disconnect()
