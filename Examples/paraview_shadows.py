"""A macro for ParaView: switches SVO Shadows For Everything of the active view on, or off if it is on.

Macros > Import new macro... takes this file once; its name is a button of the toolbar Macros from then on.
"""

from paraview.simple import GetActiveView, Render

view = GetActiveView()
if view is None or "SVOShadowsForEverything" not in view.ListProperties():
    raise RuntimeError("The active view has no SVO settings: load the plugin SparseVoxelOctree, then make a view.")
view.SVOShadowsForEverything = 0 if view.SVOShadowsForEverything else 1
Render(view)
