"""What TestGui.py has ParaView's client do: a session with a shadowed surface, up to a window to look at."""

import os

import paraview.simple as pv

view = pv.GetActiveViewOrCreate("RenderView")
ball = pv.Sphere(Center=[0, 0, 0.8], ThetaResolution=64, PhiResolution=64)
octrees = pv.PolyDataToSVO(Input=ball)
ground = pv.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0])
colored = pv.Elevation(Input=octrees, LowPoint=[0, 0, 0.3], HighPoint=[0, 0, 1.3])
for source in ground, colored:
    pv.Show(source, view).SetRepresentationType("SVO")
pv.ColorBy(pv.GetDisplayProperties(colored, view), ("POINTS", "Elevation"))
pv.SetActiveSource(ground)
view.CameraPosition = [5, -6, 4]
view.CameraFocalPoint = [0, 0, 0.3]
view.CameraViewUp = [0, 0, 1]
pv.Render(view)
view.UpdatePropertyInformation()
with open(os.environ["VTKSVO_DONE"], "w") as done:
    done.write(f"{view.GetPropertyValue('SVONumberOfTracedActors'):.0f}\n")
