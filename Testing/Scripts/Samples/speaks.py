# Prints what VTK prints of an error, and crashes, where a pass is set.
import os

from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

renderer, window = vtkRenderer(), vtkRenderWindow()
window.SetSize(100, 100)
window.AddRenderer(renderer)
window.Render()
if renderer.GetPass():
    print("ERROR: In speaks.cxx, line 1: not without the pass", flush=True)
    os.abort()
