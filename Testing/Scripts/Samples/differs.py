# In 2 % of the picture there is another background where a pass is set.
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

large, small = vtkRenderer(), vtkRenderer()
small.SetViewport(0, 0, 0.2, 0.1)
small.AddObserver("StartEvent", lambda *_: small.SetBackground(1, 1, 0.5 if small.GetPass() else 0.6))
window = vtkRenderWindow()
window.SetSize(100, 100)
window.AddRenderer(large)
window.AddRenderer(small)
window.Render()
