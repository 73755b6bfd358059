// A renderer's visible surfaces and lights as a scene of the tracer.
#ifndef svoSceneCollector_h
#define svoSceneCollector_h

#include "svoOctreeStore.h"
#include "svoPropCollector.h"
#include "svoScene.h"
#include "svoSceneLights.h"
#include "svoSceneOctrees.h"

#include "vtkSmartPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkObjectBase;
class vtkPolyData;
class vtkProp;
class vtkRenderer;

namespace svo
{
/// A frame's settings of the collection.
struct CollectSettings
{
  bool shadows = true; // casters are wanted
  /// Only props that say explicitly that they use octrees (vtkSVORenderPass::SetUseSVO) are traced
  /// or cast; the others only receive.
  bool onlyMarked = false;
  LevelSettings levels;
  std::set<std::string>* said = nullptr; // messages of the pass, about no object in particular
  /// Messages about surfaces and cells that cast nothing, or more than they show; empty: none.
  std::string translucentSurfaceText;
  std::string translucentText;
  std::string cutOutText;
  LightNames nameOfHeadlight;
};

/// A frame's scene, and the renderer's props that the scene replaces.
struct CollectedScene
{
  Scene scene;
  std::vector<vtkSmartPointer<vtkPolyData>> meshes; // of the scene's instances, by index
  /// Props that the rasteriser must leave alone: every surface of theirs is traced, or must not be
  /// shown.
  std::set<vtkProp*> replaced;
  int tracedActors = 0;
  int rasterizedActors = 0;
  bool rasterizedReceivers = false; // lit surfaces that the rasteriser draws and shadows fall on
  bool headlightOnly = false;       // SceneLights
  std::string lightsText;
  /// Owners of the arrays that the scene points into.
  std::vector<vtkSmartPointer<vtkObjectBase>> kept;
};

/// Collects frame after frame from one renderer. Casters outside of the picture are in.
class SceneCollector
{
public:
  /// Octrees come from `store`; messages go to `options.complain`, each once.
  void collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
    const CollectSettings& settings, CollectedScene& result);

  /// The surfaces that a frame would collect of a prop, octrees apart, if a light casts. Gives no
  /// messages.
  PropSurfaces judge(vtkProp* prop);

private:
  PropCollector Props;
};
}

#endif
